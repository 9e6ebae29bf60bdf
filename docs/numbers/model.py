"""Numbers of docs/explanation/model.md."""

from docs.numbers import fixed, peak, percent, row, rows


def numbers(tables):
    """Return the text for each name on the page."""
    peaks, divergence = tables["peaks"], tables["divergence"]
    hard, soft = rows(divergence, K=[5, 10]), rows(divergence, E=0.11)
    frequencies = tables["campbell"].set_index(["f_omega", "mode"])["f_fe"]
    error = row(tables["rom_accuracy"], f_omega=0.35, mode=2)
    return {
        "f1": fixed(frequencies[0, 1], 1),
        "stiffening": fixed(frequencies[0.4, 1] / frequencies[0, 1], 3),
        "modes_1_to_6": fixed(row(tables["findings"], id="C1a")["measured"], 2),
        "mode_7": fixed(row(tables["findings"], id="C1b")["measured"], 1),
        "speed_law": percent(abs(error["f_fe_eq2"] / error["f_fe"] - 1), 1),
        "divergent_hard": fixed(rows(hard, divergent=True)["runs"].sum()),
        "runs_hard": fixed(hard["runs"].sum()),
        "divergent_soft": fixed(rows(soft, divergent=True)["runs"].sum()),
        "runs_soft": fixed(soft["runs"].sum()),
        "worse_than_rigid": fixed(
            peak(peaks, 1.1, 1)["amplitude"] / row(peaks, law="coulomb", order=4)["amplitude"], 1
        ),
    }
