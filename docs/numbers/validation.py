"""Numbers of docs/explanation/validation.md."""

import pandas as pd

from docs.numbers import fixed, mm, percent, row, rows, table

_LIMIT = 0.01
"""Difference from a finer step, in any of three measures, from which on a run is looked at again."""
_MEASURES = ["wear_l2", "peak", "revolution_peak"]


def numbers(tables):
    """Return the text for each name on the page."""
    return (
        _blade(
            tables["rom_accuracy"],
            tables["campbell"].set_index(["f_omega", "mode"])["f_fe"],
            tables["findings"],
        )
        | _runs(tables["divergence"], tables["finer_bars"])
        | _accuracy(tables["accuracy"])
        | _rigid(tables["rigid_convergence"])
    )


def _blade(accuracy, frequencies, findings):
    error = row(accuracy, f_omega=0.35, mode=2)
    return {
        "speed_law": percent(abs(error["f_fe_eq2"] / error["f_fe"] - 1), 3),
        "modes_1_to_6": fixed(row(findings, id="C1a")["measured"], 2),
        "mode_7": fixed(row(findings, id="C1b")["measured"], 2),
        "f1": fixed(frequencies[0, 1], 2),
        "stiffening": fixed(frequencies[0.4, 1] / frequencies[0, 1], 4),
    }


def _runs(divergence, bars):
    repeated = divergence[divergence["revolutions"] > 20]["runs"].sum()
    soft = bars[(bars["status"] == "completed") & (bars["E"] < 20)]
    first = rows(soft, elements=4000)
    grows = (first["E"] == 2) & (first["order"] == 6) & (first["theta"] == 0)  # left out with 8,000 elements
    finest = rows(soft, elements=8000)
    return {
        "runs": fixed(divergence["runs"].sum() + repeated),
        "repeated": fixed(repeated),
        "peaks_by_elements": fixed(len(rows(bars, elements=8000))),
        "Y_by_elements": percent(finest["amplitude_change"].abs().max(), 1),
        "wear_by_elements": percent(finest["wear_difference"].max(), 1),
        "wear_by_first_halving": percent(first[~grows]["wear_difference"].max(), 1),
    }


def _accuracy(accuracy):
    drawn, important = rows(accuracy, drawn_from="all"), rows(accuracy, drawn_from="important")
    errors, starts = (
        accuracy[[f"{of}_{measure}" for measure in _MEASURES]].max(axis=1) > _LIMIT
        for of in ("error", "start")
    )
    by_modulus = accuracy.assign(beyond=errors, chaotic=starts).groupby("E")[["beyond", "chaotic"]]
    unexplained = accuracy[errors & ~starts & (accuracy["status"] == "completed")]
    return {
        "drawn": fixed(len(drawn)),
        "accurate": fixed(_accurate(drawn)),
        "wear_error": f"{drawn['error_wear_l2'].median():.0e}",
        "peak_error": f"{drawn['error_peak'].median():.0e}",
        "sensitive": fixed(len(rows(drawn, sensitive=True))),
        "speedup": fixed(rows(drawn, sensitive=False)["speedup_at_equal_error"].median()),
        "important": fixed(len(important)),
        "accurate_important": fixed(_accurate(important)),
        "by_modulus": table(
            by_modulus.sum().assign(runs=by_modulus.size()).reset_index(),
            {"E": "E", "runs": "runs", "beyond": "beyond 1 %", "chaotic": "of these chaotic"},
        ),
        "drawn_unbounded": fixed(len(rows(accuracy, status="unbounded"))),
        "unexplained": table(
            unexplained,
            {
                "casing": "casing",
                "E": "E",
                "K": "K",
                "theta": "θ",
                "f_omega": "f_Ω",
                "error_wear_l2": ("wear, %", lambda error: percent(error, 2)),
                "error_peak": ("spectral peak, %", lambda error: percent(error, 2)),
                "error_revolution_peak": ("revolution peak, %", lambda error: percent(error, 2)),
            },
        ),
    }


def _accurate(runs):
    return ((runs["error_wear_l2"] <= _LIMIT) & (runs["error_peak"] <= _LIMIT)).sum()


def _rigid(impact):
    lines = []
    for f_omega, order in ((0.25, 4), (0.388, 4), (0.232, 6)):
        runs = rows(impact, f_omega=f_omega)
        study = rows(runs, treatment="exponential").iloc[0]
        complete = rows(runs, complete=True)
        change = {
            "complete": complete["amplitude_change"],
            "truncated": rows(runs, complete=False, treatment="moreau_jean_0")["amplitude_change"],
            "springs": runs[runs["treatment"].str.startswith("penalty")]["amplitude_change"],
            "largest revolution, complete": complete["largest_revolution"] / study["largest_revolution"] - 1,
        }
        lines.append(
            {"f_Ω": f_omega, "order": order, "study, mm": mm(study["amplitude"], 3)}
            | {alternative: _range(values) for alternative, values in change.items()}
        )
    return {
        "impact": table(pd.DataFrame(lines)),
        "impact_near_peaks": _range(rows(impact, complete=True)["amplitude_change"]),
    }


def _range(changes):
    return f"{100 * changes.min():+.1f} to {100 * changes.max():+.1f}"
