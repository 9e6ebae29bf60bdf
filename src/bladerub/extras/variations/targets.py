"""What is matched: quantities that vary smoothly with the inputs, with what the paper prints of them.

A verdict jumps, and its borders are ours. A target is the number behind it, with the errors of
reading it from the paper's text and of another blade than the paper's. The claims C6, C9 and C12 have no
target here: they are kept to see what a match predicts.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
import pandas as pd

from bladerub.extras.study_runs import LOBES
from bladerub.study import paper
from bladerub.study.findings.claim import NotMeasurable, claim_of
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import SAME_SPEED, CoatingCase, between
from bladerub.study.growth import growth
from bladerub.study.maps import CoatingMap
from bladerub.study.paper import CRITICAL, SOFT, STRAIGHT, STRAIGHT_SPEED, TILTED, TILTED_SPEED, WORN
from bladerub.study.peaks import amplitude_in_window, order_amplitude

EQUAL, AT_LEAST, AT_MOST = "equal", "at least", "at most"

_READING = 0.005  # half a unit of the second digit of the speeds that the paper prints
_OTHER_BLADE = paper.NEAR / 2  # a speed of a blade with another C1: claims allow two of these, `NEAR`
_SHIFT = 0.002  # of one speed against another of the same blade: the step of the study
_SPEED = float(np.hypot(_READING, _OTHER_BLADE))
_RATIO = 0.05  # of amplitudes: what a claim counts as partly below its border
_SHARE = 0.1  # of shares of the worn depth in a harmonic
_SIGNIFICANT = float(np.log(paper.SIGNIFICANT))
_GROWTH = 0.005  # per revolution: half of what counts as growth
_GREATEST_GROWTH = 0.1  # per revolution; an unbounded run and one that doubles are both far above the border


@dataclass(frozen=True)
class Target:
    """A quantity, what the paper says of it, and the standard deviation of that."""

    name: str
    claim: str  # the part of a claim that it stands for
    relation: str  # of the quantity to `value`: EQUAL, AT_LEAST or AT_MOST
    value: float
    error: float
    measure: Callable[..., float]  # of `Evidence` and the `arguments`
    arguments: tuple = ()

    def excess(self, values: np.ndarray) -> np.ndarray:
        """Return how far values (n,) miss the target, never negative; NaN stays NaN."""
        difference = np.asarray(values, dtype=float) - self.value
        beyond = difference if self.relation == AT_MOST else -difference
        return np.abs(difference) if self.relation == EQUAL else np.maximum(beyond, 0.0)


def measure(evidence: Evidence, claims: Iterable[str]) -> dict[str, float]:
    """Measure the targets of some claims, ``C2`` standing for all its parts; NaN where a study lacks it."""
    selection, values = set(claims), {}
    for name, target in TARGETS.items():
        if claim_of(target.claim) in selection:
            try:
                values[name] = float(target.measure(evidence, *target.arguments))
            except (NotMeasurable, ValueError):  # as of `amplitude_in_window`
                values[name] = float("nan")
    return values


def _refined_maximum(f_omega: np.ndarray, values: np.ndarray) -> tuple[float, float]:
    """Return place and height of the maximum, by a parabola through its neighbours in ln(value)."""
    if not np.isfinite(values).any() or np.nanmax(values) <= 0:
        raise NotMeasurable("nothing to find a maximum in")
    best = int(np.nanargmax(values))
    highest, window = (float(f_omega[best]), float(values[best])), slice(max(best - 1, 0), best + 2)
    f, height = f_omega[window], values[window]
    if f.size < 3 or not np.all(height > 0):
        return highest
    curve = np.polynomial.Polynomial.fit(f - f[1], np.log(height), 2).convert().coef
    if curve.size < 3 or curve[2] >= 0:
        return highest
    offset = float(np.clip(-curve[1] / (2 * curve[2]), f[0] - f[1], f[2] - f[1]))
    return float(f[1] + offset), float(np.exp(curve[0] + curve[1] * offset + curve[2] * offset**2))


def _peak(evidence: Evidence, case: CoatingCase, order: int) -> tuple[float, float]:
    """Return speed and amplitude (m) of the peak of an order, both between the speeds of the grid."""
    coating = evidence.map(case)
    amplitude = amplitude_in_window(coating, order, evidence.config.analysis.peaks)
    return _refined_maximum(coating.f_omega, amplitude)


def _dominance(evidence: Evidence, case: CoatingCase, inside: np.ndarray, harmonic: int) -> np.ndarray:
    """By how much the share of a harmonic in the wear exceeds the strongest other's, at some speeds (n,)."""
    if not inside.any():
        raise NotMeasurable(f"{case.name} has no run at these speeds")
    power = np.abs(np.fft.rfft(evidence.map(case).wear[inside])[:, 1:]) ** 2
    share = power / np.maximum(power.sum(axis=1, keepdims=True), np.finfo(float).tiny)
    # nodal diameters of the casing do not compete: they are in every pattern, and no lobes of their own
    aside = {harmonic, *evidence.config.casings[case.casing].nodal_diameters}
    others = np.delete(share, [number - 1 for number in aside], axis=1)
    return share[:, harmonic - 1] - others.max(axis=1)


def _dominance_between(
    evidence: Evidence, harmonic: int, reduce: Callable[[np.ndarray], float], low: float, high: float
) -> float:
    inside = between(evidence.map(WORN).f_omega, low, high)
    return float(reduce(_dominance(evidence, WORN, inside, harmonic)))


def _dominance_at(evidence: Evidence, case: CoatingCase, speed: float | CoatingCase, harmonic: int) -> float:
    coating, index = _run(evidence, case, speed)
    return float(_dominance(evidence, case, np.arange(coating.f_omega.size) == index, harmonic)[0])


def _maximum_near(coating: CoatingMap, speed: float, values: np.ndarray) -> float:
    window = between(coating.f_omega, speed - 2 * paper.NEAR, speed + 2 * paper.NEAR)
    return _refined_maximum(coating.f_omega[window], values[window])[0]


def _wear_maximum(evidence: Evidence, speed: float) -> float:
    coating = evidence.map(WORN)
    return _maximum_near(coating, speed, coating.max_wear)


def _vibration_offset(evidence: Evidence, order: int, speed: float) -> float:
    coating = evidence.map(WORN)
    amplitude = order_amplitude(coating, order, evidence.config.analysis.peaks.order_halfwidth)
    return _maximum_near(coating, speed, amplitude) - _wear_maximum(evidence, speed)


def _odd_over_even(evidence: Evidence) -> float:
    coating = evidence.map(SOFT)
    strongest = [np.nanmax(order_amplitude(coating, order, 0.0)) for order in range(2, 13)]
    return float(np.log(max(strongest[1::2]) / max(strongest[0::2])))


def _weakest_crossing(evidence: Evidence) -> float:
    heights = []
    for order in range(2, 13):
        try:
            heights.append(_peak(evidence, CRITICAL, order)[1])
        except (NotMeasurable, ValueError):  # crosses C1 outside the speeds
            continue
    if len(heights) < 2:
        raise NotMeasurable("fewer than two engine orders cross C1")
    weakest = np.quantile(heights, 0.1, method="lower")  # the claim asks for nine orders of ten
    return float(np.log(weakest / max(heights)))


def _log_ratio(evidence: Evidence, one: CoatingCase, other: CoatingCase, order: int) -> float:
    return float(np.log(_peak(evidence, one, order)[1] / _peak(evidence, other, order)[1]))


def _peak_speed(evidence: Evidence, case: CoatingCase, order: int) -> float:
    return _peak(evidence, case, order)[0]


def _shift(evidence: Evidence, one: CoatingCase, other: CoatingCase, order: int) -> float:
    return _peak_speed(evidence, one, order) - _peak_speed(evidence, other, order)


def _modulus_peaks(evidence: Evidence) -> pd.DataFrame:
    """Speed and amplitude of the peak of order 4 over K and the paper's range of E."""
    table = (
        evidence.moduli(paper.CASING, paper.THETA, 4, "f_peak")
        .loc[:, paper.SOFTEST : paper.STIFFEST]
        .stack()
        .dropna()
    )
    peaks = [
        (E, K, *_peak(evidence, CoatingCase(paper.CASING, E, K, paper.THETA), 4)) for K, E in table.index
    ]
    return pd.DataFrame(peaks, columns=["E", "K", "f4", "Y4"])


def _over_hardening(evidence: Evidence, reduce: Callable[[np.ndarray], float]) -> float:
    """Find the smallest over E of `reduce` of f4 over ascending K, of each E that contact stiffens."""
    peaks = _modulus_peaks(evidence).sort_values("K")
    peaks = peaks[peaks.E > paper.STIFFENING_FROM]
    values = [reduce(group.f4.to_numpy()) for _, group in peaks.groupby("E") if len(group) >= 2]
    return float(min(values, default=np.nan))


def _over_modulus(evidence: Evidence, column: str, reduce: Callable[[np.ndarray], float]) -> float:
    """Find the greatest over the low K of `reduce` of f4 or Y4 over E."""
    peaks = _modulus_peaks(evidence)
    peaks = peaks[peaks.K <= paper.SOFT_HARDENING]
    values = [reduce(group[column].to_numpy()) for _, group in peaks.groupby("K") if len(group) >= 2]
    return float(max(values, default=np.nan))


def _relative_range(values: np.ndarray) -> float:
    return np.ptp(values) / values.mean()


def _growth_at(evidence: Evidence, case: CoatingCase, speed: float | CoatingCase) -> float:
    coating, index = _run(evidence, case, speed)
    if coating.status[index] == "unbounded":
        return _GREATEST_GROWTH
    settings = evidence.config.analysis.divergence
    excess = growth(coating.revolution_amplitude[index], settings).per_revolution - settings.growth
    return float(np.clip(excess, -_GREATEST_GROWTH, _GREATEST_GROWTH))


def _run(evidence: Evidence, case: CoatingCase, speed: float | CoatingCase) -> tuple[CoatingMap, int]:
    """Return the map of `case` and the number of its run at a speed, or at f6 of another coating."""
    coating = evidence.map(case)
    f_omega = evidence.peak(speed, 6, "f_peak") if isinstance(speed, CoatingCase) else speed
    matches = np.flatnonzero(np.abs(coating.f_omega - f_omega) < SAME_SPEED)
    if matches.size == 0:
        raise NotMeasurable(f"coating {case.name} has no run at f_omega = {f_omega:g}")
    return coating, int(matches[0])


_TARGETS = (
    ("five_0_0.08", "C2a", AT_LEAST, 0.0, _SHARE, _dominance_between, (5, np.mean, *LOBES[0])),
    ("five_0.24_0.34", "C2b", AT_LEAST, 0.0, _SHARE, _dominance_between, (5, np.mean, *LOBES[1])),
    ("harmonic_10_0.1", "C2c", AT_LEAST, 0.0, _SHARE, _dominance_between, (10, np.max, *LOBES[2])),
    ("harmonic_4_0.38", "C2d", AT_LEAST, 0.0, _SHARE, _dominance_between, (4, np.max, *LOBES[3])),
    ("f6_soft", "C4a", EQUAL, 0.21, _SPEED, _peak_speed, (SOFT, 6)),
    ("f4_soft", "C4b", EQUAL, 0.31, _SPEED, _peak_speed, (SOFT, 4)),
    ("f6_tilted", "C11a", EQUAL, TILTED_SPEED, _SPEED, _peak_speed, (TILTED, 6)),
    ("f6_straight", "C11b", EQUAL, STRAIGHT_SPEED, _SPEED, _peak_speed, (STRAIGHT, 6)),
    ("wear_0.26", "C3a", EQUAL, 0.26, _SPEED, _wear_maximum, (0.26,)),
    ("wear_0.38", "C3b", EQUAL, 0.38, _SPEED, _wear_maximum, (0.38,)),
    ("offset_0.26", "C3c", EQUAL, 0.0, _OTHER_BLADE, _vibration_offset, (5, 0.26)),
    ("offset_0.38", "C3d", EQUAL, 0.0, _OTHER_BLADE, _vibration_offset, (4, 0.38)),
    ("odd_over_even", "C4c", AT_MOST, _SIGNIFICANT, 0.2, _odd_over_even, ()),
    ("weakest_crossing", "C5c", AT_LEAST, _SIGNIFICANT, 0.2, _weakest_crossing, ()),
    ("Y4_critical", "C5a", AT_LEAST, 0.0, _RATIO, _log_ratio, (CRITICAL, SOFT, 4)),
    ("Y4_tilted", "C10a", AT_MOST, 0.0, _RATIO, _log_ratio, (TILTED, STRAIGHT, 4)),
    ("Y6_critical", "C5b", AT_LEAST, 0.0, _RATIO, _log_ratio, (CRITICAL, SOFT, 6)),
    ("Y6_tilted", "C10b", AT_MOST, 0.0, _RATIO, _log_ratio, (TILTED, STRAIGHT, 6)),
    ("f4_shift", "C10c", AT_MOST, 0.0, _SHIFT, _shift, (TILTED, STRAIGHT, 4)),
    ("f6_shift", "C10d", EQUAL, TILTED_SPEED - STRAIGHT_SPEED, _SHIFT, _shift, (TILTED, STRAIGHT, 6)),
    ("f4_rise", "C7a", AT_LEAST, 0.0, _SHIFT, _over_hardening, (lambda f: f[-1] - f[0],)),
    ("f4_step", "C7b", AT_LEAST, 0.0, _SHIFT, _over_hardening, (lambda f: np.diff(f).min(),)),
    ("Y4_spread", "C8a", AT_MOST, paper.HARDLY["amplitude"], _RATIO, _over_modulus, ("Y4", _relative_range)),
    ("f4_spread", "C8b", AT_MOST, paper.HARDLY["f_peak"], _SHIFT, _over_modulus, ("f4", np.ptp)),
    ("growth_C11a", "C11a", AT_LEAST, 0.0, _GROWTH, _growth_at, (TILTED, TILTED_SPEED)),
    ("growth_C11b", "C11b", AT_LEAST, 0.0, _GROWTH, _growth_at, (STRAIGHT, STRAIGHT_SPEED)),
    ("growth_C11g", "C11g", AT_LEAST, 0.0, _GROWTH, _growth_at, (TILTED, TILTED)),
    ("growth_C11h", "C11h", AT_LEAST, 0.0, _GROWTH, _growth_at, (STRAIGHT, STRAIGHT)),
    ("growth_C11c", "C11c", AT_MOST, 0.0, _GROWTH, _growth_at, (STRAIGHT, TILTED_SPEED)),
    ("growth_C11d", "C11d", AT_MOST, 0.0, _GROWTH, _growth_at, (TILTED, STRAIGHT_SPEED)),
    ("growth_C11i", "C11i", AT_MOST, 0.0, _GROWTH, _growth_at, (STRAIGHT, TILTED)),
    ("growth_C11j", "C11j", AT_MOST, 0.0, _GROWTH, _growth_at, (TILTED, STRAIGHT)),
    ("six_C11e", "C11e", AT_LEAST, 0.0, _SHARE, _dominance_at, (TILTED, TILTED_SPEED, 6)),
    ("six_C11f", "C11f", AT_LEAST, 0.0, _SHARE, _dominance_at, (STRAIGHT, STRAIGHT_SPEED, 6)),
    ("six_C11k", "C11k", AT_LEAST, 0.0, _SHARE, _dominance_at, (TILTED, TILTED, 6)),
    ("six_C11l", "C11l", AT_LEAST, 0.0, _SHARE, _dominance_at, (STRAIGHT, STRAIGHT, 6)),
)
TARGETS = {row[0]: Target(*row) for row in _TARGETS}
"""What is matched by name, in the order of the tables."""
