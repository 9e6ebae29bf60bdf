"""Claims C4 and C5: response spectra on the soft and on the critical coating, two nodal diameters."""

import contextlib

import numpy as np

from bladerub.study.findings.claim import Finding, NotMeasurable, above, below, claim
from bladerub.study.findings.evidence import Evidence
from bladerub.study.findings.paper import CRITICAL, NEAR, SIGNIFICANT, SOFT
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import order_amplitude, peak

_HIGHEST_ORDER = 12  # where eo(k) leaves the paper's spectra
_SECTION = 'section "Young modulus sensitivity"'


@claim("C4a", f"at E = 0.11, eo(6) peaks at 0.21 ({_SECTION}, Fig. 8)", 6, 0.21)
@claim("C4b", f"at E = 0.11, eo(4) peaks at 0.31 ({_SECTION}, Fig. 8; see C4a)", 4, 0.31)
def soft_peak(evidence: Evidence, order: int, paper: float) -> Finding:
    """Speed of the peak.

    The paper's sentence has 0.21 with eo(4) and 0.31 with eo(6); they are swapped, since 6 × 0.21 = 1.26 and
    4 × 0.31 = 1.24 both lie on C1.
    """
    measured = evidence.peak(SOFT, order, "f_peak")
    text = f"E = 0.11: eo({order}) peaks near f_omega = {paper:g} (Fig. 8)"
    return Finding(text, paper, measured, "1", *below(abs(measured - paper), NEAR, 2 * NEAR))


@claim("C4c", f"at E = 0.11, no significant amplitude on odd engine orders ({_SECTION})")
def soft_even_orders(evidence: Evidence) -> Finding:
    """Strongest odd over strongest even order, on the lines themselves, one bin wide, over all speeds."""
    coating = evidence.map(SOFT)
    strongest = [float(np.nanmax(order_amplitude(coating, order, 0.0))) for order in _orders(coating)]
    ratio = max(strongest[1::2]) / max(strongest[0::2])  # orders 2, 3, 4 … : the odd ones are at odd places
    text = "E = 0.11: even engine orders only: strongest odd over strongest even order (Fig. 8)"
    return Finding(text, 0, ratio, "1", *below(ratio, SIGNIFICANT, 3 * SIGNIFICANT))


@claim("C5a", f"Y4 is higher at E = 1.1 than at E = 0.11 ({_SECTION}, Fig. 9)", 4)
@claim("C5b", f"Y6 is higher at E = 1.1 than at E = 0.11 ({_SECTION}, Fig. 9)", 6)
def critical_is_higher(evidence: Evidence, order: int) -> Finding:
    """Ratio of the heights of the peaks."""
    ratio = evidence.peak(CRITICAL, order, "amplitude") / evidence.peak(SOFT, order, "amplitude")
    text = f"Y{order} at E = 1.1 is higher than at E = 0.11: ratio (Figs. 8 and 9)"
    return Finding(text, "above 1", ratio, "1", *above(ratio, 1.0, 0.95))


@claim("C5c", "at E = 1.1, significant amplitudes where each eo(k) crosses C1 (same section, Fig. 9)")
def critical_all_orders(evidence: Evidence) -> Finding:
    """Share of the orders crossing C1 within the study whose peak there is a tenth of the highest."""
    coating, settings = evidence.map(CRITICAL), evidence.config["analysis"]["peaks"]
    amplitudes = []
    for order in _orders(coating):
        with contextlib.suppress(ValueError):  # the order crosses C1 outside the speeds of the study
            amplitudes.append(peak(coating, order, settings).amplitude)
    if len(amplitudes) < 2:
        raise NotMeasurable(f"{CRITICAL.name}: fewer than two engine orders cross C1 within its speeds")
    share = 100 * float(np.mean(np.array(amplitudes) >= SIGNIFICANT * max(amplitudes)))
    text = (
        "E = 1.1: significant amplitude where each engine order crosses C1: "
        f"share of {len(amplitudes)} orders (Fig. 9)"
    )
    return Finding(text, 100, share, "%", *above(share, 90, 60))


def _orders(coating: CoatingMap) -> range:
    # from order 2: order 1 is next to the slow change of the mean
    return range(2, min(_HIGHEST_ORDER, int(coating.spectrum_order[-1])) + 1)
