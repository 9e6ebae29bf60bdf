"""Quantities of a study in the units of an engineer: filters of the template."""

import math

import numpy as np

from bladerub.settings.study import Config
from bladerub.settings.units import pressure_in_words
from bladerub.study.grid import CoatingCase, modulus_unit, run_spec

NONE = "–"  # a quantity that is not known
_FINEST = 1e-4  # mm


def mm(length: float, digits: int = 3) -> str:
    """Write a length (m) in mm."""
    text = f"{1e3 * length:.{digits}g}"
    return NONE if math.isnan(length) else f"below {_FINEST}" if 0 < 1e3 * length < _FINEST else text


def rpm(speed: float) -> str:
    """Write a speed in rpm, whole."""
    return NONE if math.isnan(speed) else f"{speed:,.0f}"


def percent(share: float) -> str:
    """Write a share in percent."""
    return f"{100 * share:.2g}" if share < 0.995 else "100"


def band(low: float, high: float) -> str:
    """Write the ends of a band (m) in mm, to four digits: most bands are narrow."""
    return NONE if math.isnan(low + high) else f"{mm(low, 4)} to {mm(high, 4)}"


def properties(config: Config, case: CoatingCase) -> dict[str, str]:
    """Write casing, moduli and direction of the force of a coating, each with its unit."""
    modulus = {
        key: "rigid" if case.is_rigid else pressure_in_words(modulus_unit(config) * getattr(case, key))
        for key in ("E", "K")
    }
    force = f"θ = {math.degrees(case.theta):.3g}°" if case.law == "theta" else f"μ = {case.friction:.3g}"
    return {"casing": case.casing, **modulus, "theta": force}


def title(config: Config, case: CoatingCase) -> str:
    """Name a coating by its properties, and by what it has of its own."""
    about, spec = properties(config, case), run_spec(config, case, 0.0)
    layer = "rigid" if case.is_rigid else f"E = {about['E']}, K = {about['K']}"
    own = {
        "damping_ratio": f"damping ratio {percent(spec.damping_ratio)} %",
        "layer_thickness": f"layer {mm(spec.coating.thickness)} mm",
        "interference": f"interference {mm(spec.casing.interference)} mm",
    }
    return ", ".join([f"casing {case.casing}", layer, about["theta"], *(own[key] for key in case.own)])


def ranges(mask: np.ndarray, speeds: np.ndarray, most: int = 3) -> str:
    """Write the ranges of ascending `speeds` (n,), rpm, with a true `mask` (n,): the widest, and the ends."""
    steps = np.diff(np.concatenate([[0], np.asarray(mask, dtype=int), [0]]))
    starts, ends = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1) - 1
    parts = list(zip(speeds[starts].tolist(), speeds[ends].tolist(), strict=True))
    widest = sorted(sorted(parts, key=lambda part: part[0] - part[1])[:most])
    text = ", ".join(_range(*part) for part in widest)
    if len(parts) > most:
        text += f" and {len(parts) - most} more within {_range(parts[0][0], parts[-1][1])}"
    return text or NONE


def _range(low: float, high: float) -> str:
    return rpm(low) if low == high else f"{rpm(low)} to {rpm(high)}"
