"""Numbers of studies/convergence/README.md."""

import math
from functools import partial

from docs.numbers import fixed, headings, mm, percent, rows, span, table
from docs.numbers.refinement import cost, greatest_changes, refinement

_LIMIT = 0.01
"""Difference from a finer step, in any of three measures, from which on a run is looked at again."""
_MEASURES = {"wear_l2": "wear", "peak": "spectral peak", "revolution_peak": "revolution peak"}


def numbers(tables):
    """Return the text for each name on the page."""
    bars, nodes = tables["finer_bars"], tables["more_nodes"]
    return (
        _steps(tables["steps"])
        | _accuracy(tables["accuracy"])
        | {"finer_elements": refinement(bars, "elements")}
        | _greatest(rows(bars, elements=8000), "elements")
        | {"more_nodes": refinement(nodes, "interface_nodes")}
        | _greatest(rows(nodes, interface_nodes=24), "nodes")
        | {f"cost_{n}": cost(nodes, n) for n in (16, 24)}
        | _impact(tables["rigid_convergence"])
    )


def _steps(steps):
    study = rows(steps, tolerance=0.01)
    regular = study[~study["sensitive"]].groupby("E")
    errors = regular["error"].agg(["median", ("most", lambda error: error.quantile(0.9)), ("worst", "max")])
    thousand, chaotic = regular["steps_per_revolution"].median(), study.groupby("E")["sensitive"].sum()

    def share(error):
        return percent(error, 3 if error < 1e-3 else 2)

    return {
        "errors": table(
            errors.assign(thousand=thousand, chaotic=chaotic).reset_index(),
            {"E": ("E", lambda E: f"{E:g}" if math.isfinite(E) else "rigid")}
            | {"thousand": ("steps in a revolution, thousand", lambda steps: fixed(steps / 1e3))}
            | {"median": ("median error, %", share), "most": ("nine runs in ten, %", share)}
            | {"worst": ("worst, %", share), "chaotic": "chaotic runs, not counted"},
        ),
        "sample": fixed(study.groupby("E").size().max()),
    }


def _accuracy(accuracy):
    drawn, important = rows(accuracy, drawn_from="all"), rows(accuracy, drawn_from="important")
    beyond = accuracy[[f"error_{measure}" for measure in _MEASURES]].max(axis=1) > _LIMIT
    by_modulus = accuracy.assign(beyond=beyond).groupby("E")[["beyond", "sensitive"]]
    unexplained = accuracy[beyond & ~accuracy["sensitive"] & (accuracy["status"] == "completed")]
    by_start = unexplained[[f"start_{measure}" for measure in _MEASURES]].max(axis=1)
    share = partial(percent, digits=2)
    return {
        "drawn": fixed(len(drawn)),
        "important": fixed(len(important)),
        "accurate_important": fixed((important[["error_wear_l2", "error_peak"]] <= _LIMIT).all(axis=1).sum()),
        "by_modulus": table(
            by_modulus.sum().assign(runs=by_modulus.size()).reset_index(),
            {"E": "E", "runs": "runs", "beyond": "beyond 1 %", "sensitive": "of these chaotic"},
        ),
        "drawn_unbounded": fixed(len(rows(accuracy, status="unbounded"))),
        "unexplained": table(
            unexplained.assign(by_start=by_start),
            headings("casing", "E", "K", "theta", "f_omega")
            | {f"error_{measure}": (f"{words}, %", share) for measure, words in _MEASURES.items()}
            | {"by_start": ("most by another start, %", share)},
        ),
    }


def _greatest(finest, by):
    """Write the greatest changes of soft coatings whose runs end within the limit of displacement."""
    soft = greatest_changes(rows(finest[finest["E"] < 20], status="completed"))
    return {f"{name}_by_{by}": percent(change, 1) for name, change in soft.items()}


def _impact(impact):
    lines = []
    whole = rows(impact, treatment="moreau_jean_0.5")  # of the speeds with all alternatives
    for f_omega, order in zip(whole["f_omega"], whole["order"], strict=True):
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
            | {alternative: span(100 * values, "{:+.1f}".format) for alternative, values in change.items()}
        )
    return {
        "impact": table(lines),
        "impact_near_peaks": span(100 * rows(impact, complete=True)["amplitude_change"], "{:+.1f}".format),
    }
