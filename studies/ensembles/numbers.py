"""Numbers of studies/ensembles/README.md."""

from docs.numbers import fixed, percent, rows


def numbers(tables):
    """Return the text for each name on the page."""
    peaks, claims, cost = tables["peak_bands"], tables["claim_draws"], tables["cost"]
    width = (peaks["amplitude_high"] - peaks["amplitude_low"]) / 2 / peaks["amplitude"]
    error, seconds = peaks["amplitude_error"] / peaks["amplitude"], cost["wall_s"].sum()
    return {
        "widest_band": percent(width.max(), 2),
        "same_verdicts": fixed((claims["share_of_draws"] == 1).sum()),
        "parts": fixed(len(claims)),
        "cost": fixed(seconds / (seconds - rows(cost, rule="ensemble")["wall_s"].sum()), 2),
        "verdicts_kept": fixed((claims["holds"] == claims["holds_refined"]).sum()),
        "peaks": fixed(error.notna().sum()),
        "peaks_moved": fixed((peaks["f_peak_error"] > 0).sum()),
        "peak_error_median": percent(error.median(), 3),
        "peaks_beyond": fixed((error > 0.01).sum()),
    }
