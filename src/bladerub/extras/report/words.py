"""Quantities of a study in the units of an engineer."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from bladerub.config.units import pressure_in_words
from bladerub.study.grid import CoatingCase, modulus_unit, run_spec

NONE = "–"
"""What stands for a quantity that is not known."""

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
    return f"{100 * share:.3g}"


def band(low: float, high: float) -> str:
    """Write the ends of a band (m) in mm, to four digits: most bands are narrow."""
    return NONE if math.isnan(low + high) else f"{mm(low, 4)} to {mm(high, 4)}"


def growth(divergent: float, saturating: float) -> str:
    """Say whether the vibration of a run keeps growing; neither is known of a missing run (NaN)."""
    return "diverges" if divergent == 1 else "levels off" if saturating == 1 else "none"


def properties(config: Mapping[str, Any], case: CoatingCase) -> dict[str, str]:
    """Write casing, moduli and direction of the force of a coating, each with its unit."""
    modulus = {
        key: "rigid" if case.is_rigid else pressure_in_words(modulus_unit(config) * getattr(case, key))
        for key in ("E", "K")
    }
    force = f"θ = {math.degrees(case.theta):.3g}°" if case.law == "theta" else f"μ = {case.friction:.3g}"
    return {"casing": case.casing, **modulus, "theta": force}


def title(config: Mapping[str, Any], case: CoatingCase) -> str:
    """Name a coating by its properties, and by what it has of its own."""
    about, spec = properties(config, case), run_spec(config, case, 0.0)
    layer = "rigid" if case.is_rigid else f"E = {about['E']}, K = {about['K']}"
    variants = {
        "damping_ratio": f"damping ratio {percent(spec.damping_ratio)} %",
        "layer_thickness": f"layer {mm(spec.coating.thickness)} mm",
        "interference": f"interference {mm(spec.casing.interference)} mm",
    }
    return ", ".join([f"casing {case.casing}", layer, about["theta"], *(variants[key] for key in case.own)])


def ranges(mask: np.ndarray, speeds: np.ndarray) -> list[tuple[float, float]]:
    """Find the first and last of the ascending `speeds` (n,) of each run of true values in `mask` (n,)."""
    steps = np.diff(np.concatenate([[0], np.asarray(mask, dtype=int), [0]]))
    starts, ends = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1) - 1
    return list(zip(speeds[starts].tolist(), speeds[ends].tolist(), strict=True))


def ranges_in_words(parts: Sequence[tuple[float, float]], most: int = 3) -> str:
    """Write ranges of speeds in rpm; of more than `most` the widest, and the ends of all."""
    widest = sorted(sorted(parts, key=lambda part: part[0] - part[1])[:most])
    text = ", ".join(rpm(low) if low == high else f"{rpm(low)} to {rpm(high)}" for low, high in widest)
    if len(parts) > most:
        text += f" and {len(parts) - most} narrower within {rpm(parts[0][0])} to {rpm(parts[-1][1])}"
    return f"{text} rpm" if parts else NONE
