"""Numbers of studies/ensembles/README.md."""

from docs.numbers import fixed, headings, percent, rows, table


def numbers(tables):
    """Return the text for each name on the page."""
    peaks, claims, cost = tables["peak_bands"], tables["claim_draws"], tables["cost"]
    runs = tables["run_bands"]
    wear = (runs["max_wear_high"] - runs["max_wear_low"]) / 2 / runs["max_wear_median"]
    undecided = runs[runs["divergent_draws"].between(0, 1, "neither")]
    of_fig_6 = rows(runs[wear > 0.05], casing="2nd5nd")
    width = (peaks["amplitude_high"] - peaks["amplitude_low"]) / 2 / peaks["amplitude"]
    error, seconds = peaks["amplitude_error"] / peaks["amplitude"], cost["wall_s"].sum()
    return {
        "runs": fixed(len(runs)),
        "repetitions": fixed((runs["draws"] - 1).sum()),
        "wear_beyond_1": fixed((wear > 0.01).sum()),
        "wear_beyond_5": fixed((wear > 0.05).sum()),
        "widest_wear": percent(wear.max()),
        "of_fig_6": fixed(len(of_fig_6)),
        "of_fig_6_slow": fixed((of_fig_6["f_omega"] < 0.12).sum()),
        "undecided": fixed(len(undecided)),
        "undecided_runs": table(
            undecided,
            headings("casing", "E", "K", "theta", "f_omega")
            | {"divergent_draws": ("draws that diverge, %", percent)},
        ),
        "other_lobes": fixed((runs["lobes_lowest"] != runs["lobes_highest"]).sum()),
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
