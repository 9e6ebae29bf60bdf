"""Numbers of docs/how-to/how_sure.md."""

from docs.numbers import fixed, percent, rows


def numbers(tables):
    """Return the text for each name on the page."""
    peaks, findings, cost = tables["peaks"], tables["findings"], tables["cost"]
    width = (peaks["amplitude_high"] - peaks["amplitude_low"]) / 2 / peaks["amplitude"]
    seconds = cost["wall_s"].sum()
    return {
        "widest_band": percent(width.max(), 2),
        "same_verdicts": fixed((findings["share_of_draws"] == 1).sum()),
        "parts": fixed(len(findings)),
        "cost": fixed(seconds / (seconds - rows(cost, stage="ensembles")["wall_s"].sum()), 2),
    }
