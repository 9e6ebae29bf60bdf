"""Numbers of docs/explanation/validation.md."""

from docs.numbers import fixed, percent, row, rows

_LIMIT = 0.01  # difference from a finer step within which a run counts as accurate


def numbers(tables):
    """Return the text for each name on the page."""
    blade = _blade(tables["rom_accuracy"], tables["campbell"], tables["findings"])
    return blade | _runs(tables["divergence"]) | _accuracy(tables["accuracy"])


def _blade(accuracy, campbell, findings):
    frequencies = campbell.set_index(["f_omega", "mode"])["f_fe"]
    error = row(accuracy, f_omega=0.35, mode=2)
    return {
        "speed_law": percent(abs(error["f_fe_eq2"] / error["f_fe"] - 1), 3),
        "modes_1_to_6": fixed(row(findings, id="C1a")["measured"], 2),
        "mode_7": fixed(row(findings, id="C1b")["measured"], 2),
        "f1": fixed(frequencies[0, 1], 2),
        "stiffening": fixed(frequencies[0.4, 1] / frequencies[0, 1], 4),
    }


def _runs(divergence):
    repeated = divergence[divergence["revolutions"] > 20]["runs"].sum()
    return {"runs": fixed(divergence["runs"].sum() + repeated), "repeated": fixed(repeated)}


def _accuracy(accuracy):
    drawn = rows(accuracy, drawn_from="all")
    within = (drawn["error_wear_l2"] <= _LIMIT) & (drawn["error_peak"] <= _LIMIT)
    return {
        "calm": fixed((~drawn["sensitive"]).sum()),
        "accurate_calm": fixed((within & ~drawn["sensitive"]).sum()),
        "drawn": fixed(len(drawn)),
        "accurate": fixed(within.sum()),
        "wear_error": f"{drawn['error_wear_l2'].median():.0e}",
        "peak_error": f"{drawn['error_peak'].median():.0e}",
        "sensitive": fixed(len(rows(drawn, sensitive=True))),
        "speedup": fixed(rows(drawn, sensitive=False)["speedup_at_equal_error"].median()),
    }
