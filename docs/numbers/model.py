"""Numbers of docs/explanation/model.md."""

from docs.numbers import fixed, peak, row, rows


def numbers(tables):
    """Return the text for each name on the page."""
    peaks, divergence = tables["peaks"], tables["divergence"]
    hard, soft = rows(divergence, K=[5, 10]), rows(divergence, E=0.11)
    return {
        "divergent_hard": fixed(rows(hard, divergent=True)["runs"].sum()),
        "runs_hard": fixed(hard["runs"].sum()),
        "divergent_soft": fixed(rows(soft, divergent=True)["runs"].sum()),
        "runs_soft": fixed(soft["runs"].sum()),
        "worse_than_rigid": fixed(
            peak(peaks, 1.1, 1)["amplitude"] / row(peaks, law="coulomb", order=4)["amplitude"], 1
        ),
    }
