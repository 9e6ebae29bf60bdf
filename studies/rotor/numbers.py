"""Numbers of studies/rotor/README.md."""

import math

import pandas as pd

from docs.numbers import fixed, headings, mm, percent, row, rows, table

_SCATTER = {"length_scatter": 5e-5, "frequency_scatter": 0.005, "coupling": 0}
_CRITICAL = {"E": 1.1, "K": 0.5, "theta": 0, "f_omega": 0.346} | _SCATTER
"""The paper's critical coating at its f4, with blades that scatter by 50 µm and 0.5 %."""
_WINDOWS = {"f4": (0.3, 0.38), "f6": (0.18, 0.22)}
"""Speeds of the sweeps around a peak."""


def numbers(tables):
    """Return the text for each name on the page."""
    rotor, half, drift = tables["rotor"], tables["rotor_half"], tables["rotor_drift"]
    critical = rows(rotor, **_CRITICAL)
    others = {
        "10 µm, equal frequencies": {"length_scatter": 1e-5, "frequency_scatter": 0},
        "10 µm, 0.5 %": {"length_scatter": 1e-5},
        "10 µm, 2 %": {"length_scatter": 1e-5, "frequency_scatter": 0.02},
        "100 µm, equal frequencies": {"length_scatter": 1e-4, "frequency_scatter": 0},
        "off resonance, 0.280": {"f_omega": 0.28},
        "E = 0.11 at its f4": {"E": 0.11, "f_omega": 0.31},
        "E = 0.11 at its f6": {"E": 0.11, "f_omega": 0.186},
        "E = 20 at its f6": {"E": 20, "f_omega": 0.2},
        "twelve blades on a coupled disk": {"blades": 12, "coupling": 0.01},
    }
    by_blades = {str(blades): {"blades": blades} for blades in sorted(critical["blades"])}
    others = {name: {"blades": 4} | change for name, change in others.items()}
    lobes = critical[["lobes_lowest", "lobes_highest"]].to_numpy(int)
    patterns = {
        "blades": critical["blades"],
        "strongest harmonic of the wear": critical["wear_harmonic"].map(fixed),
        "rows that have it, %": (critical["wear_harmonic_rows"] / critical["rows"]).map(percent),
        "its share of the variance, %": critical["wear_harmonic_share_median"].map(percent),
        "lobes": [f"{low} to {high}" for low, high in lobes],
    }
    drifts = {"median": "median, degrees a revolution", "p05": "5 %", "p95": "95 %"}
    drifts = {f"pattern_drift_{name}": (heading, _degrees) for name, heading in drifts.items()}
    turning = rows(drift, f_omega=[0.346, 0.31], length_scatter=5e-5)
    return {
        "by_blades": _combinations(rotor, half, "blades", by_blades),
        "by_combination": _combinations(rotor, half, "four blades", others),
        "energy_residual": fixed(1e6 * rotor["energy_residual"].max()),
        "patterns": table(patterns),
        "drift": table(turning, headings("E", "f_omega", "blades") | drifts),
        "drift_draws": fixed(row(drift, **_CRITICAL, blades=4)["rows"]),
        "sweeps": _sweeps(rotor),
        "growth": _growth(rotor),
    }


def _combinations(rotor, half, heading, combinations):
    """Write rows of blades by combination, each with the results of the first half of its draws."""
    lines = []
    for name, changes in combinations.items():
        values, first = (row(rows_of, **(_CRITICAL | changes)) for rows_of in (rotor, half))
        leave, first_leave = (percent(part["unbounded_rows"] / part["rows"]) for part in (values, first))
        blades, line = values["blades"], {heading: name, "draws": fixed(values["rows"])}
        lines.append(
            line
            | {"leave the limit, %": leave, "of the first half": first_leave}
            | {"amplitude": _interval(values), "amplitude of the first half": _interval(first)}
            | {"wear of the longest": _share(blades, values["longest_share_median"])}
            | {"wear of the most worn": _share(blades, values["largest_share_median"])}
        )
    return table(lines)


def _interval(values):
    low, high = values["amplification_low"], values["amplification_high"]
    return f"{values['amplification_median']:.2f} ({low:.2f} to {high:.2f})"


def _share(blades, share):
    return "" if blades == 1 or pd.isna(share) else fixed(blades * share, 2)


def _degrees(angle):
    return fixed(math.degrees(angle), 1)


def _sweeps(rotor):
    lines = []
    coatings = [("f4", E, 0) for E in (0.5, 1.1, 2, 5, 20)]
    for peak, E, theta in (*coatings, ("f4", 2, 0.15), ("f6", 2, 0), ("f6", 2, 0.15)):
        sweep = rows(rotor, E=E, K=0.5, theta=theta, blades=4, **_SCATTER)
        sweep = sweep[sweep["f_omega"].between(*_WINDOWS[peak])]
        highest = sweep.loc[sweep["row_amplitude_median"].idxmax()]
        unbounded = (sweep["unbounded_rows"] / sweep["rows"]).max()
        lines.append(
            {"around": peak, "E": E, "θ": theta}
            | {"greatest median amplitude, mm": mm(highest["row_amplitude_median"])}
            | {"at f_Ω": fixed(highest["f_omega"], 3)}
            | {"leave the limit at the worst speed, %": percent(unbounded)}
        )
    return table(lines)


def _growth(rotor):
    diverge = rows(rotor, E=2, K=0.5, f_omega=[0.19, 0.197, 0.206], blades=4, **_SCATTER)
    shares = diverge.assign(share=(diverge["divergent_rows"] / diverge["rows"]).map(percent))
    shares = shares.pivot(index="f_omega", columns="theta", values="share").rename_axis("f_Ω").reset_index()
    headed = {theta: f"θ = {theta:g}: rows that diverge, %" for theta in shares.columns[1:]}
    return table(shares, {"f_Ω": "f_Ω"} | headed)
