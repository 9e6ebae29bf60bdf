"""Claims C1 to C5 (Figs. 2 and 6 to 9): frequencies, and over the speed worn lobes, wear and spectra."""

from collections.abc import Sequence

import numpy as np

from bladerub.study.findings.claim import NO, Finding, NotMeasurable, above, below, claim, ratio
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import between
from bladerub.study.maps import CoatingMap
from bladerub.study.paper import CRITICAL, FIVE_LOBES, FOUR_LOBES, NEAR, SIGNIFICANT, SOFT, TEN_LOBES, WORN
from bladerub.study.peaks import order_amplitude, peak

_FIRST_SIX = 'modes 1 to 6 agree (section "Reduced-order model and component mode synthesis", Fig. 2)'
_SEVENTH = "so does mode 7, the last the paper vouches for (Fig. 2): within two percent"
_SECTION = 'section "Case study"'
_YOUNG = 'section "Young modulus sensitivity"'
_HIGHEST_ORDER = 12  # where eo(k) leaves the paper's spectra


@claim("C1a", _FIRST_SIX, range(1, 7), 0.5)  # half a percent is the width of a line in the figure
@claim("C1b", _SEVENTH, [7], 2.0)
def worst_error(evidence: Evidence, modes: Sequence[int], percent: float) -> Finding:
    """Largest relative error of the frequencies of `modes` at all speeds."""
    table = evidence.rom_accuracy[evidence.rom_accuracy["mode"].isin(modes)]
    if table["mode"].nunique() < len(modes):
        raise NotMeasurable(f"rom_accuracy has not all of the modes {min(modes)} to {max(modes)}")
    worst = 100 * float(table.relative_error.abs().max())
    which = "mode 7" if len(modes) == 1 else f"modes {min(modes)} to {max(modes)}"
    text = f"reduced model predicts {which} at all speeds: largest error (Fig. 2)"
    return Finding(text, f"below {percent:g}", worst, "%", *below(worst, percent, 4 * percent))


@claim("C2a", f"five worn lobes for f_Ω in [0, 0.08] ({_SECTION}, Fig. 6)", *FIVE_LOBES[0])
@claim("C2b", f"five worn lobes for f_Ω in [0.24, 0.34] ({_SECTION}, Fig. 6)", *FIVE_LOBES[1])
def five_lobes(evidence: Evidence, low: float, high: float) -> Finding:
    """Share of the runs from speed `low` to `high` with five lobes, or with the fifth harmonic."""
    coating = evidence.map(WORN)
    inside = between(coating.f_omega, low, high)
    if not inside.any():
        raise NotMeasurable(f"{WORN.name} has no run between {low:g} and {high:g}")
    text = f"five worn lobes for f_omega in [{low:g}, {high:g}]: share of the runs (Fig. 6)"

    def finding(counts: np.ndarray) -> Finding:
        share = 100 * float(np.mean(counts[inside] == 5))
        return Finding(text, 100, share, "%", *above(share, 75, 25))  # the paper says "usually"

    return finding(coating.lobes).beside(finding(coating.wear_harmonic))


@claim("C2c", f"ten lobes at f_Ω ≃ 0.1 ({_SECTION}, Fig. 6)", 10, TEN_LOBES)
@claim("C2d", f"four lobes at f_Ω ≃ 0.38 ({_SECTION}, Figs. 6 and 7)", 4, FOUR_LOBES)
def lobes_near(evidence: Evidence, count: int, paper: float) -> Finding:
    """Speed nearest to the paper's with so many lobes, or with that harmonic."""
    coating = _map_near(evidence, paper)
    text = f"{count} worn lobes near f_omega = {paper:g}: nearest speed with them (Fig. 6)"
    by_lobes, by_harmonic = (
        _nearest(text, paper, coating.f_omega[counts == count])
        for counts in (coating.lobes, coating.wear_harmonic)
    )
    return by_lobes.beside(by_harmonic)


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
    amplitude = order_amplitude(coating, order, evidence.config.analysis.peaks.order_halfwidth)
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
    from scipy import signal  # takes longer to import than all else here

    # the ends of the range count: values that grow up to the last speed have a maximum there
    padded = np.pad(values, 1, constant_values=values.min())
    peaks, _ = signal.find_peaks(padded, prominence=SIGNIFICANT * values.max())
    return coating.f_omega[peaks - 1]


def _nearest(text: str, paper: float, maxima: np.ndarray) -> Finding:
    if maxima.size == 0:
        return Finding(text, paper, "none", "1", NO, float("nan"))
    nearest = float(maxima[np.argmin(np.abs(maxima - paper))])
    return Finding(text, paper, nearest, "1", *below(abs(nearest - paper), NEAR, 2 * NEAR))


@claim("C4a", f"at E = 0.11, eo(6) peaks at 0.21 ({_YOUNG}, Fig. 8)", 6, 0.21)
@claim("C4b", f"at E = 0.11, eo(4) peaks at 0.31 ({_YOUNG}, Fig. 8; see C4a)", 4, 0.31)
def soft_peak(evidence: Evidence, order: int, paper: float) -> Finding:
    """Speed of the peak.

    The paper has 0.21 with eo(4) and 0.31 with eo(6), swapped: 6 × 0.21 = 1.26 and 4 × 0.31 = 1.24 are on C1.
    """
    measured = evidence.peak(SOFT, order, "f_peak")
    text = f"E = 0.11: eo({order}) peaks near f_omega = {paper:g} (Fig. 8)"
    return Finding(text, paper, measured, "1", *below(abs(measured - paper), NEAR, 2 * NEAR))


@claim("C4c", f"at E = 0.11, no significant amplitude on odd engine orders ({_YOUNG})")
def soft_even_orders(evidence: Evidence) -> Finding:
    """Strongest odd over strongest even order, on the lines themselves, one bin wide, over all speeds."""
    coating = evidence.map(SOFT)
    strongest = [np.fmax.reduce(order_amplitude(coating, order, 0.0)) for order in _orders(coating)]
    # orders 2, 3, 4 … : the odd ones are at odd places
    odd, even = (float(np.fmax.reduce(strongest[first::2], initial=np.nan)) for first in (1, 0))
    share = ratio(odd, even, SOFT.name)
    text = "E = 0.11: even engine orders only: strongest odd over strongest even order (Fig. 8)"
    return Finding(text, 0, share, "1", *below(share, SIGNIFICANT, 3 * SIGNIFICANT))


@claim("C5a", f"Y4 is higher at E = 1.1 than at E = 0.11 ({_YOUNG}, Fig. 9)", 4)
@claim("C5b", f"Y6 is higher at E = 1.1 than at E = 0.11 ({_YOUNG}, Fig. 9)", 6)
def critical_is_higher(evidence: Evidence, order: int) -> Finding:
    """Ratio of the heights of the peaks."""
    critical, soft = (evidence.peak(case, order, "amplitude") for case in (CRITICAL, SOFT))
    raised = ratio(critical, soft, SOFT.name)
    text = f"Y{order} at E = 1.1 is higher than at E = 0.11: ratio (Figs. 8 and 9)"
    return Finding(text, "above 1", raised, "1", *above(raised, 1.0, 0.95))


@claim("C5c", "at E = 1.1, significant amplitudes where each eo(k) crosses C1 (same section, Fig. 9)")
def critical_all_orders(evidence: Evidence) -> Finding:
    """Share of the orders crossing C1 within the study whose peak there is a tenth of the highest."""
    coating, settings = evidence.map(CRITICAL), evidence.config.analysis.peaks
    amplitudes = np.array([peak(coating, order, settings).amplitude for order in _orders(coating)])
    amplitudes = amplitudes[np.isfinite(amplitudes)]
    if amplitudes.size < 2:
        raise NotMeasurable(f"{CRITICAL.name}: fewer than two engine orders have a peak within its speeds")
    share = 100 * float(np.mean(ratio(amplitudes, amplitudes.max(), CRITICAL.name) >= SIGNIFICANT))
    crossings = f"each engine order crosses C1: share of {amplitudes.size} orders"
    text = f"E = 1.1: significant amplitude where {crossings} (Fig. 9)"
    return Finding(text, 100, share, "%", *above(share, 90, 60))


def _orders(coating: CoatingMap) -> range:
    # from order 2: order 1 is next to the slow change of the mean
    return range(2, min(_HIGHEST_ORDER, int(coating.spectrum_order[-1])) + 1)
