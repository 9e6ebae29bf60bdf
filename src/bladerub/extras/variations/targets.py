"""What is matched: quantities that vary smoothly with the inputs, with what the paper prints of them.

A verdict jumps, and its borders are ours. A target is the number behind it, with the errors of
reading it from the paper's text and of another blade than the paper's. The claims C6, C9 and C12 have no
target here: they are kept to see what a match predicts.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
import pandas as pd

from bladerub.study.findings.claim import NotMeasurable, claim_of
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import SAME_SPEED, CoatingCase, between
from bladerub.study.growth import growth
from bladerub.study.maps import CoatingMap
from bladerub.study.paper import (
    CASING,
    CRITICAL,
    FIVE_LOBES,
    FOUR_LOBES,
    HARDLY,
    NEAR,
    SIGNIFICANT,
    SOFT,
    SOFT_HARDENING,
    SOFTEST,
    STIFFENING_FROM,
    STRAIGHT,
    STRAIGHT_SPEED,
    TEN_LOBES,
    THETA,
    TILTED,
    TILTED_SPEED,
    WORN,
)
from bladerub.study.peaks import amplitude_in_window, order_amplitude

EQUAL, AT_LEAST, AT_MOST = "equal", "at least", "at most"

_READING = 0.005  # half a unit of the second digit of the speeds that the paper prints
_OTHER_BLADE = NEAR / 2  # a speed of a blade with another C1: `NEAR`, which a claim allows, is two of these
_SHIFT = 0.002  # of one speed against another of the same blade: the step of the study
_RATIO = 0.05  # of amplitudes: what a claim counts as partly below its border
_SHARE = 0.1  # of shares of the worn depth in a harmonic
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
    measure: Callable[[Evidence], float]

    def excess(self, values: np.ndarray) -> np.ndarray:
        """Return how far values (n,) miss the target, never negative; NaN stays NaN."""
        difference = np.asarray(values, dtype=float) - self.value
        if self.relation == AT_LEAST:
            return np.maximum(-difference, 0.0)
        return np.maximum(difference, 0.0) if self.relation == AT_MOST else np.abs(difference)


def measure(evidence: Evidence, claims: Iterable[str]) -> dict[str, float]:
    """Measure the targets of some claims, ``C2`` standing for all its parts; NaN where a study lacks it."""
    selection, values = set(claims), {}
    for name, target in TARGETS.items():
        if claim_of(target.claim) in selection:
            try:
                values[name] = float(target.measure(evidence))
            except (NotMeasurable, ValueError):  # as of `amplitude_in_window`
                values[name] = float("nan")
    return values


def _refined_maximum(f_omega: np.ndarray, values: np.ndarray) -> tuple[float, float]:
    """Return place and height of the maximum, by a parabola through its neighbours in ln(value)."""
    if not np.isfinite(values).any() or np.nanmax(values) <= 0:
        raise NotMeasurable("nothing to find a maximum in")
    best = int(np.nanargmax(values))
    window = slice(max(best - 1, 0), best + 2)
    f, height = f_omega[window], values[window]
    if f.size < 3 or not np.all(height > 0):
        return float(f_omega[best]), float(values[best])
    curve = np.polynomial.Polynomial.fit(f - f[1], np.log(height), 2).convert().coef
    if curve.size < 3 or curve[2] >= 0:
        return float(f_omega[best]), float(values[best])
    offset = float(np.clip(-curve[1] / (2 * curve[2]), f[0] - f[1], f[2] - f[1]))
    return float(f[1] + offset), float(np.exp(curve[0] + curve[1] * offset + curve[2] * offset**2))


def _peak(evidence: Evidence, case: CoatingCase, order: int) -> tuple[float, float]:
    """Return speed and amplitude (m) of the peak of an order, both between the speeds of the grid."""
    coating = evidence.map(case)
    amplitude = amplitude_in_window(coating, order, evidence.config.analysis.peaks)
    return _refined_maximum(coating.f_omega, amplitude)


def _dominance(evidence: Evidence, case: CoatingCase, inside: np.ndarray, harmonic: int) -> np.ndarray:
    """By how much the share of a harmonic in the wear exceeds that of the strongest other, at some speeds.

    The nodal diameters of the casing do not compete: they are in every pattern, and are no lobes of their
    own.
    """
    if not inside.any():
        raise NotMeasurable(f"{case.name} has no run at these speeds")
    power = np.abs(np.fft.rfft(evidence.map(case).wear[inside])[:, 1:]) ** 2
    share = power / np.maximum(power.sum(axis=1, keepdims=True), np.finfo(float).tiny)
    aside = {harmonic, *evidence.config.casings[case.casing].nodal_diameters}
    others = np.delete(share, [number - 1 for number in aside], axis=1)
    return share[:, harmonic - 1] - others.max(axis=1)


def _dominance_between(
    evidence: Evidence, low: float, high: float, harmonic: int, reduce: Callable[[np.ndarray], float]
) -> float:
    inside = between(evidence.map(WORN).f_omega, low, high)
    return float(reduce(_dominance(evidence, WORN, inside, harmonic)))


def _dominance_at(evidence: Evidence, case: CoatingCase, speed: float | CoatingCase, harmonic: int) -> float:
    coating, index = _run(evidence, case, speed)
    return float(_dominance(evidence, case, np.arange(coating.f_omega.size) == index, harmonic)[0])


def _maximum_near(coating: CoatingMap, speed: float, values: np.ndarray) -> float:
    window = between(coating.f_omega, speed - 2 * NEAR, speed + 2 * NEAR)
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
    """Speed and amplitude of the peak of order 4 at every E and K, columns ``E``, ``K``, ``f4``, ``Y4``."""
    table = evidence.moduli(CASING, THETA, 4, "f_peak").stack().dropna()
    peaks = [(E, K, *_peak(evidence, CoatingCase(CASING, E, K, THETA), 4)) for K, E in table.index]
    return pd.DataFrame(peaks, columns=["E", "K", "f4", "Y4"])


def _over_hardening(evidence: Evidence, reduce: Callable[[np.ndarray], float]) -> float:
    """Find the smallest over E of `reduce` of f4 over ascending K, of each E that contact stiffens."""
    peaks = _modulus_peaks(evidence).sort_values("K")
    peaks = peaks[peaks.E > STIFFENING_FROM]
    values = [reduce(group.f4.to_numpy()) for _, group in peaks.groupby("E") if len(group) >= 2]
    return float(min(values, default=np.nan))


def _over_modulus(evidence: Evidence, column: str, reduce: Callable[[np.ndarray], float]) -> float:
    """Find the greatest over the low K of `reduce` of f4 or Y4 over E."""
    peaks = _modulus_peaks(evidence)
    peaks = peaks[(peaks.K <= SOFT_HARDENING) & (peaks.E >= SOFTEST)]
    values = [reduce(group[column].to_numpy()) for _, group in peaks.groupby("K") if len(group) >= 2]
    return float(max(values, default=np.nan))


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


def _speeds() -> Iterator[Target]:
    read = float(np.hypot(_READING, _OTHER_BLADE))
    for name, part, case, order, paper in (
        ("f6_soft", "C4a", SOFT, 6, 0.21),
        ("f4_soft", "C4b", SOFT, 4, 0.31),
        ("f6_tilted", "C11a", TILTED, 6, TILTED_SPEED),
        ("f6_straight", "C11b", STRAIGHT, 6, STRAIGHT_SPEED),
    ):
        yield Target(name, part, EQUAL, paper, read, partial(_peak_speed, case=case, order=order))
    for name, part, speed in (("wear_0.26", "C3a", 0.26), ("wear_0.38", "C3b", 0.38)):
        yield Target(name, part, EQUAL, speed, read, partial(_wear_maximum, speed=speed))
    for name, part, order, speed in (("offset_0.26", "C3c", 5, 0.26), ("offset_0.38", "C3d", 4, 0.38)):
        offset = partial(_vibration_offset, order=order, speed=speed)
        yield Target(name, part, EQUAL, 0.0, _OTHER_BLADE, offset)


def _worn_lobes() -> Iterator[Target]:
    for part, (low, high) in zip(("C2a", "C2b"), FIVE_LOBES, strict=True):
        dominance = partial(_dominance_between, low=low, high=high, harmonic=5, reduce=np.mean)
        yield Target(f"five_{low:g}_{high:g}", part, AT_LEAST, 0.0, _SHARE, dominance)
    for part, count, speed in (("C2c", 10, TEN_LOBES), ("C2d", 4, FOUR_LOBES)):
        near = {"low": speed - NEAR, "high": speed + NEAR}
        dominance = partial(_dominance_between, **near, harmonic=count, reduce=np.max)
        yield Target(f"harmonic_{count}_{speed:g}", part, AT_LEAST, 0.0, _SHARE, dominance)


def _heights() -> Iterator[Target]:
    low = float(np.log(SIGNIFICANT))
    yield Target("odd_over_even", "C4c", AT_MOST, low, 0.2, _odd_over_even)
    yield Target("weakest_crossing", "C5c", AT_LEAST, low, 0.2, _weakest_crossing)
    tilt = {"one": TILTED, "other": STRAIGHT}
    for order, critical, tilted in ((4, "C5a", "C10a"), (6, "C5b", "C10b")):
        softer = partial(_log_ratio, one=CRITICAL, other=SOFT, order=order)
        yield Target(f"Y{order}_critical", critical, AT_LEAST, 0.0, _RATIO, softer)
        straighter = partial(_log_ratio, **tilt, order=order)
        yield Target(f"Y{order}_tilted", tilted, AT_MOST, 0.0, _RATIO, straighter)
    yield Target("f4_shift", "C10c", AT_MOST, 0.0, _SHIFT, partial(_shift, **tilt, order=4))
    shift = TILTED_SPEED - STRAIGHT_SPEED
    yield Target("f6_shift", "C10d", EQUAL, shift, _SHIFT, partial(_shift, **tilt, order=6))


def _moduli() -> Iterator[Target]:
    rise = partial(_over_hardening, reduce=lambda f: f[-1] - f[0])
    yield Target("f4_rise", "C7a", AT_LEAST, 0.0, _SHIFT, rise)
    step = partial(_over_hardening, reduce=lambda f: np.diff(f).min())
    yield Target("f4_step", "C7b", AT_LEAST, 0.0, _SHIFT, step)
    spread = partial(_over_modulus, column="Y4", reduce=lambda height: np.ptp(height) / height.mean())
    yield Target("Y4_spread", "C8a", AT_MOST, HARDLY["amplitude"], _RATIO, spread)
    spread = partial(_over_modulus, column="f4", reduce=np.ptp)
    yield Target("f4_spread", "C8b", AT_MOST, HARDLY["f_peak"], _SHIFT, spread)


def _divergence() -> Iterator[Target]:
    own = ((TILTED, TILTED_SPEED), (STRAIGHT, STRAIGHT_SPEED), (TILTED, TILTED), (STRAIGHT, STRAIGHT))
    others = ((STRAIGHT, TILTED_SPEED), (TILTED, STRAIGHT_SPEED), (STRAIGHT, TILTED), (TILTED, STRAIGHT))
    six = partial(_dominance_at, harmonic=6)
    for name, letters, runs, relation, error, measure_at in (
        ("growth", "abgh", own, AT_LEAST, _GROWTH, _growth_at),
        ("growth", "cdij", others, AT_MOST, _GROWTH, _growth_at),
        ("six", "efkl", own, AT_LEAST, _SHARE, six),
    ):
        for letter, (case, speed) in zip(letters, runs, strict=True):
            part, measure_run = f"C11{letter}", partial(measure_at, case=case, speed=speed)
            yield Target(f"{name}_{part}", part, relation, 0.0, error, measure_run)


TARGETS = {
    target.name: target for target in (*_worn_lobes(), *_speeds(), *_heights(), *_moduli(), *_divergence())
}
"""What is matched by name, in the order of the tables."""
