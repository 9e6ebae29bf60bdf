"""Claims C2 and C3: worn lobes and wear maxima of the casing with 2 and 5 nodal diameters."""

from __future__ import annotations

import numpy as np
from scipy import signal

from bladerub.study.findings.evidence import SAME_SPEED, Evidence
from bladerub.study.findings.finding import NO, Finding, NotMeasurable, above, below
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import order_amplitude

CASE = CoatingCase("2nd5nd", 11.0, 0.5, 0.0)
"""The coating of Figs. 6 and 7 (section "Case study")."""

LOW_SPEEDS, HIGH_SPEEDS = (0.0, 0.08), (0.24, 0.34)
"""Where the paper sees five lobes (Fig. 6)."""

NEAR = 0.025
"""How far "near" a speed reaches, normalised: about a line's width in the paper's maps, and the C1 of another
blade."""

_PROMINENT = 0.1  # of the greatest value over all speeds: what the eye takes for a maximum of a map


def five_lobes_low(evidence: Evidence) -> Finding:
    """C2a: five worn lobes for f_Ω in [0, 0.08] (section "Case study", Fig. 6)."""
    return _five_lobes(evidence, "C2a", LOW_SPEEDS)


def five_lobes_high(evidence: Evidence) -> Finding:
    """C2b: five worn lobes for f_Ω in [0.24, 0.34] (section "Case study", Fig. 6)."""
    return _five_lobes(evidence, "C2b", HIGH_SPEEDS)


def _five_lobes(evidence: Evidence, id_: str, interval: tuple[float, float]) -> Finding:
    coating = evidence.map(CASE)
    inside = (coating.f_omega >= interval[0] - SAME_SPEED) & (coating.f_omega <= interval[1] + SAME_SPEED)
    if not inside.any():
        raise NotMeasurable(f"{CASE.name} has no run between {interval[0]:g} and {interval[1]:g}")
    share = 100 * float(np.mean(coating.lobes[inside] == 5))
    holds, margin = above(share, 75, 25)  # the paper says "usually"
    claim = f"five worn lobes for f_omega in [{interval[0]:g}, {interval[1]:g}]: share of the runs (Fig. 6)"
    return Finding(id_, claim, 100, share, "%", holds, margin)


def ten_lobes(evidence: Evidence) -> Finding:
    """C2c: ten lobes at f_Ω ≃ 0.1 (section "Case study", Fig. 6)."""
    return _lobes_near(evidence, "C2c", 10, 0.1)


def four_lobes(evidence: Evidence) -> Finding:
    """C2d: four lobes at f_Ω ≃ 0.38 (section "Case study", Figs. 6 and 7)."""
    return _lobes_near(evidence, "C2d", 4, 0.38)


def _lobes_near(evidence: Evidence, id_: str, count: int, paper: float) -> Finding:
    coating = evidence.map(CASE)
    _require_speeds_near(coating, paper)
    claim = f"{count} worn lobes near f_omega = {paper:g}: nearest speed with them (Fig. 6)"
    return _nearest(id_, claim, paper, coating.f_omega[coating.lobes == count])


def wear_maximum_five(evidence: Evidence) -> Finding:
    """C3a: the wear has a maximum at f_Ω ≃ 0.26, five lobes (section "Case study", Figs. 6 and 7)."""
    return _wear_maximum(evidence, "C3a", 0.26)


def wear_maximum_four(evidence: Evidence) -> Finding:
    """C3b: the wear has a maximum at f_Ω ≃ 0.38, four lobes (section "Case study", Figs. 6 and 7)."""
    return _wear_maximum(evidence, "C3b", 0.38)


def _wear_maximum(evidence: Evidence, id_: str, paper: float) -> Finding:
    coating = evidence.map(CASE)
    _require_speeds_near(coating, paper)
    claim = f"wear maximum near f_omega = {paper:g}: nearest maximum (Fig. 6)"
    return _nearest(id_, claim, paper, _maxima(coating, coating.max_wear))


def vibration_maximum_five(evidence: Evidence) -> Finding:
    """C3c: at the wear maximum near 0.26 the vibration on eo(5) has its maximum on C1 (Fig. 7)."""
    return _wear_meets_vibration(evidence, "C3c", 5, 0.26)


def vibration_maximum_four(evidence: Evidence) -> Finding:
    """C3d: at the wear maximum near 0.38 the vibration on eo(4) has its maximum on C1 (Fig. 7)."""
    return _wear_meets_vibration(evidence, "C3d", 4, 0.38)


def _wear_meets_vibration(evidence: Evidence, id_: str, order: int, paper: float) -> Finding:
    coating = evidence.map(CASE)
    _require_speeds_near(coating, paper)
    claim = f"wear maximum near {paper:g} is a vibration maximum on eo({order}): offset of the two (Fig. 7)"
    amplitude = order_amplitude(coating, order, evidence.config["analysis"]["peaks"]["order_halfwidth"])
    worn = _maxima(coating, coating.max_wear)
    worn = worn[np.abs(worn - paper) <= 2 * NEAR]  # another maximum of the wear is not the paper's
    vibrating = _maxima(coating, np.nan_to_num(amplitude))
    if worn.size == 0:
        return _nearest(id_, claim, 0.0, worn)
    at_wear = worn[np.argmin(np.abs(worn - paper))]
    return _nearest(id_, claim, 0.0, vibrating - at_wear)


def _maxima(coating: CoatingMap, values: np.ndarray) -> np.ndarray:
    # the ends of the range count: a rise up to the last speed is a maximum of the map
    padded = np.pad(values, 1, constant_values=values.min())
    peaks, _ = signal.find_peaks(padded, prominence=_PROMINENT * values.max())
    return coating.f_omega[peaks - 1]


def _require_speeds_near(coating: CoatingMap, f_omega: float) -> None:
    if np.abs(coating.f_omega - f_omega).min() > NEAR:
        raise NotMeasurable(f"{coating.case.name} has no run near f_omega = {f_omega:g}")


def _nearest(id_: str, claim: str, paper: float, found: np.ndarray) -> Finding:
    if found.size == 0:
        return Finding(id_, claim, paper, "none", "1", NO, float("nan"))
    nearest = float(found[np.argmin(np.abs(found - paper))])
    holds, margin = below(abs(nearest - paper), NEAR, 2 * NEAR)
    return Finding(id_, claim, paper, nearest, "1", holds, margin)
