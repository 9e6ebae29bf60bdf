"""Claims C2 and C3: worn lobes and wear maxima of the casing with 2 and 5 nodal diameters."""

import numpy as np
from scipy import signal

from bladerub.study.findings.claim import NO, Finding, NotMeasurable, above, below, claim
from bladerub.study.findings.evidence import SAME_SPEED, Evidence
from bladerub.study.findings.paper import NEAR, SIGNIFICANT, WORN
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import order_amplitude

_SECTION = 'section "Case study"'


@claim("C2a", f"five worn lobes for f_Ω in [0, 0.08] ({_SECTION}, Fig. 6)", 0.0, 0.08)
@claim("C2b", f"five worn lobes for f_Ω in [0.24, 0.34] ({_SECTION}, Fig. 6)", 0.24, 0.34)
def five_lobes(evidence: Evidence, low: float, high: float) -> Finding:
    """Share of the runs from speed `low` to `high` with five lobes."""
    coating = evidence.map(WORN)
    inside = (coating.f_omega >= low - SAME_SPEED) & (coating.f_omega <= high + SAME_SPEED)
    if not inside.any():
        raise NotMeasurable(f"{WORN.name} has no run between {low:g} and {high:g}")
    share = 100 * float(np.mean(coating.lobes[inside] == 5))
    text = f"five worn lobes for f_omega in [{low:g}, {high:g}]: share of the runs (Fig. 6)"
    return Finding(text, 100, share, "%", *above(share, 75, 25))  # the paper says "usually"


@claim("C2c", f"ten lobes at f_Ω ≃ 0.1 ({_SECTION}, Fig. 6)", 10, 0.1)
@claim("C2d", f"four lobes at f_Ω ≃ 0.38 ({_SECTION}, Figs. 6 and 7)", 4, 0.38)
def lobes_near(evidence: Evidence, count: int, paper: float) -> Finding:
    """Speed nearest to the paper's with so many lobes."""
    coating = _map_near(evidence, paper)
    text = f"{count} worn lobes near f_omega = {paper:g}: nearest speed with them (Fig. 6)"
    return _nearest(text, paper, coating.f_omega[coating.lobes == count])


@claim("C3a", f"the wear has a maximum at f_Ω ≃ 0.26, five lobes ({_SECTION}, Figs. 6 and 7)", 0.26)
@claim("C3b", f"the wear has a maximum at f_Ω ≃ 0.38, four lobes ({_SECTION}, Figs. 6 and 7)", 0.38)
def wear_maximum(evidence: Evidence, paper: float) -> Finding:
    """Speed of the wear maximum nearest to the paper's."""
    coating = _map_near(evidence, paper)
    text = f"wear maximum near f_omega = {paper:g}: nearest maximum (Fig. 6)"
    return _nearest(text, paper, _maxima(coating, coating.max_wear))


@claim("C3c", "at the wear maximum near 0.26 the vibration on eo(5) has its maximum on C1 (Fig. 7)", 5, 0.26)
@claim("C3d", "at the wear maximum near 0.38 the vibration on eo(4) has its maximum on C1 (Fig. 7)", 4, 0.38)
def vibration_maximum(evidence: Evidence, order: int, paper: float) -> Finding:
    """Offset of the vibration maximum from the wear maximum nearest to the paper's."""
    coating = _map_near(evidence, paper)
    text = f"wear maximum near {paper:g} is a vibration maximum on eo({order}): offset of the two (Fig. 7)"
    amplitude = order_amplitude(coating, order, evidence.config["analysis"]["peaks"]["order_halfwidth"])
    worn = _maxima(coating, coating.max_wear)
    worn = worn[np.abs(worn - paper) <= 2 * NEAR]  # another maximum of the wear is not the paper's
    if worn.size == 0:
        return _nearest(text, 0.0, worn)
    at_wear = worn[np.argmin(np.abs(worn - paper))]
    return _nearest(text, 0.0, _maxima(coating, np.nan_to_num(amplitude)) - at_wear)


def _map_near(evidence: Evidence, f_omega: float) -> CoatingMap:
    coating = evidence.map(WORN)
    if np.abs(coating.f_omega - f_omega).min() > NEAR:
        raise NotMeasurable(f"{WORN.name} has no run near f_omega = {f_omega:g}")
    return coating


def _maxima(coating: CoatingMap, values: np.ndarray) -> np.ndarray:
    # the ends of the range count: values that grow up to the last speed have a maximum there
    padded = np.pad(values, 1, constant_values=values.min())
    peaks, _ = signal.find_peaks(padded, prominence=SIGNIFICANT * values.max())
    return coating.f_omega[peaks - 1]


def _nearest(text: str, paper: float, found: np.ndarray) -> Finding:
    if found.size == 0:
        return Finding(text, paper, "none", "1", NO, float("nan"))
    nearest = float(found[np.argmin(np.abs(found - paper))])
    return Finding(text, paper, nearest, "1", *below(abs(nearest - paper), NEAR, 2 * NEAR))
