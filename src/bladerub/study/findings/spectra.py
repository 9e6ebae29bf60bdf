"""Claims C4 and C5: response spectra on the soft and on the critical coating, two nodal diameters."""

from __future__ import annotations

import contextlib

import numpy as np

from bladerub.study.findings.evidence import Evidence
from bladerub.study.findings.finding import Finding, NotMeasurable, above, below
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import order_amplitude, peak

SOFT = CoatingCase("2nd", 0.11, 0.5, 0.0)
"""The coating of Figs. 8 and 10."""

CRITICAL = CoatingCase("2nd", 1.1, 0.5, 0.0)
"""The coating of Fig. 9."""

SPEED_TOLERANCE = 0.025
"""How far a peak may lie from the paper's speed, normalised: the blade is another one."""

_HIGHEST_ORDER = 12  # where eo(k) leaves the paper's spectra
_SIGNIFICANT = 0.1  # of the strongest: what still shows in a plot of spectra


def soft_peak_six(evidence: Evidence) -> Finding:
    """C4a: at E = 0.11, eo(6) peaks at 0.21 (section "Young modulus sensitivity", Fig. 8).

    The paper's sentence has 0.21 with eo(4) and 0.31 with eo(6); they are swapped, since 6 × 0.21 = 1.26 and
    4 × 0.31 = 1.24 both lie on C1.
    """
    return _soft_peak(evidence, "C4a", 6, 0.21)


def soft_peak_four(evidence: Evidence) -> Finding:
    """C4b: at E = 0.11, eo(4) peaks at 0.31 (section "Young modulus sensitivity", Fig. 8; see C4a)."""
    return _soft_peak(evidence, "C4b", 4, 0.31)


def _soft_peak(evidence: Evidence, id_: str, order: int, paper: float) -> Finding:
    measured = evidence.peak(SOFT, order, "f_peak")
    holds, margin = below(abs(measured - paper), SPEED_TOLERANCE, 2 * SPEED_TOLERANCE)
    claim = f"E = 0.11: eo({order}) peaks near f_omega = {paper:g} (Fig. 8)"
    return Finding(id_, claim, paper, measured, "1", holds, margin)


def soft_even_orders(evidence: Evidence) -> Finding:
    """C4c: at E = 0.11, no significant amplitude on odd engine orders (section "Young modulus sensitivity").

    Measured on the lines themselves, one bin wide, over all speeds: strongest odd over strongest even order.
    """
    strongest = _strongest_on_lines(evidence.map(SOFT))
    ratio = max(strongest[1::2]) / max(strongest[0::2])  # orders 2, 3, 4 … : the odd ones are at odd places
    holds, margin = below(ratio, _SIGNIFICANT, 3 * _SIGNIFICANT)
    claim = "E = 0.11: even engine orders only: strongest odd over strongest even order (Fig. 8)"
    return Finding("C4c", claim, 0, ratio, "1", holds, margin)


def _strongest_on_lines(coating: CoatingMap) -> list[float]:
    return [float(np.nanmax(order_amplitude(coating, order, 0.0))) for order in _orders(coating)]


def _orders(coating: CoatingMap) -> range:
    # from order 2: order 1 is next to the slow change of the mean
    return range(2, min(_HIGHEST_ORDER, int(coating.spectrum_order[-1])) + 1)


def critical_is_higher_four(evidence: Evidence) -> Finding:
    """C5a: Y4 is higher at E = 1.1 than at E = 0.11 (section "Young modulus sensitivity", Fig. 9)."""
    return _critical_is_higher(evidence, "C5a", 4)


def critical_is_higher_six(evidence: Evidence) -> Finding:
    """C5b: Y6 is higher at E = 1.1 than at E = 0.11 (section "Young modulus sensitivity", Fig. 9)."""
    return _critical_is_higher(evidence, "C5b", 6)


def _critical_is_higher(evidence: Evidence, id_: str, order: int) -> Finding:
    ratio = evidence.peak(CRITICAL, order, "amplitude") / evidence.peak(SOFT, order, "amplitude")
    holds, margin = above(ratio, 1.0, 0.95)
    claim = f"Y{order} at E = 1.1 is higher than at E = 0.11: ratio (Figs. 8 and 9)"
    return Finding(id_, claim, "above 1", ratio, "1", holds, margin)


def critical_all_orders(evidence: Evidence) -> Finding:
    """C5c: at E = 1.1, significant amplitudes where each eo(k) crosses C1 (same section, Fig. 9).

    Measured as the share of the orders crossing C1 within the speeds of the study whose peak there, in the
    windows of the config, is at least a tenth of the strongest.
    """
    coating, settings = evidence.map(CRITICAL), evidence.config["analysis"]["peaks"]
    amplitudes = []
    for order in _orders(coating):
        with contextlib.suppress(ValueError):  # the order crosses C1 outside the speeds of the study
            amplitudes.append(peak(coating, order, settings).amplitude)
    if len(amplitudes) < 2:
        raise NotMeasurable(f"{CRITICAL.name}: fewer than two engine orders cross C1 within its speeds")
    share = 100 * float(np.mean(np.array(amplitudes) >= _SIGNIFICANT * max(amplitudes)))
    holds, margin = above(share, 90, 60)
    claim = (
        "E = 1.1: significant amplitude where each engine order crosses C1: "
        f"share of {len(amplitudes)} orders (Fig. 9)"
    )
    return Finding("C5c", claim, 100, share, "%", holds, margin)
