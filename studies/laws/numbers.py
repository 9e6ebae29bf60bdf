"""Numbers of studies/laws/README.md."""

import pandas as pd

from docs.numbers import decimals, fixed, headings, mm, percent, row, rows, span, table

_STATEMENTS = ["range of Y6 over its mean, K ≤ 0.1 (C9d)", "Y6 with θ = 0.15 over that with θ = 0 (C10b)"]


def numbers(tables):
    """Return the text for each name on the page."""
    counts, verdicts = tables["laws_calibration_counts"], tables["laws_calibration"]
    heated, heat = tables["heat_calibration"], tables["heat_calibration_counts"].set_index("set")
    measured = verdicts.set_index(["set", "id"])["measured"]
    return {
        "commit": counts.attrs["commit"],
        "sets": table(
            counts,
            headings("set", "yes", "partly", "no")
            | {"better": "better than plastic", "worse": "worse than plastic"},
        ),
        "viscosity": table(
            {"": _STATEMENTS}
            | {
                heading: [fixed(measured[law, part], 2) for part in ("C9d", "C10b")]
                for heading, law in (("plastic", "plastic"), ("2e4 Pa s", "viscoplastic_2e4"))
            }
        ),
        "f6_over_sets": span(pd.to_numeric(rows(verdicts, id="C4a")["measured"]), decimals(3)),
        "f4_over_sets": span(pd.to_numeric(rows(verdicts, id="C4b")["measured"]), decimals(3)),
        "heat": table(
            tables["heat"],
            {
                "theta": "θ",
                "conductivity": "W/(m K)",
                "friction_share": "share of friction",
                "softening_rise": "T_m, K",
                "largest_amplitude": ("amplitude, mm", lambda amplitude: mm(amplitude, 2)),
                "max_wear": ("wear, mm", lambda wear: mm(wear, 2)),
                "max_temperature_rise": ("warmest, K", decimals(0)),
                "growth_per_revolution": ("growth, % a revolution", lambda growth: percent(growth, 1)),
                "revolutions": "revolutions",
            },
        ),
        "commit_heat": tables["heat_calibration_counts"].attrs["commit"],
        "hold_with_heat": fixed(heat.loc["thermal_1", "yes"]),
        "hold_without_heat": fixed(heat.loc["plastic", "yes"]),
        "ratios_with_heat": _ratios(heated, "thermal_1"),
        "ratios_without_heat": _ratios(heated, "plastic"),
    }


def _ratios(verdicts, law):
    return " and ".join(fixed(row(verdicts, set=law, id=part)["measured"], 3) for part in ("C10a", "C10b"))
