"""What is matched: quantities that vary smoothly with the inputs, with what the paper prints of them.

A verdict jumps, and its borders are ours. A target is the number behind it, with the errors of
reading it from the paper's text and of another blade than the paper's. The claims C6, C9 and C12 have no
target here: they are kept to see what a match predicts.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

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
    for target in TARGETS:
        if claim_of(target.claim) in selection:
            try:
                values[target.name] = float(target.measure(evidence))
            except (NotMeasurable, ValueError):  # as of `amplitude_in_window`
                values[target.name] = float("nan")
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


def _between(
    low: float, high: float, harmonic: int, reduce: Callable[[np.ndarray], float]
) -> Callable[[Evidence], float]:
    def dominance(evidence: Evidence) -> float:
        inside = between(evidence.map(WORN).f_omega, low, high)
        return float(reduce(_dominance(evidence, WORN, inside, harmonic)))

    return dominance


def _wear_maximum(evidence: Evidence, speed: float) -> float:
    coating = evidence.map(WORN)
    window = between(coating.f_omega, speed - 2 * NEAR, speed + 2 * NEAR)
    return _refined_maximum(coating.f_omega[window], coating.max_wear[window])[0]


def _vibration_offset(order: int, speed: float) -> Callable[[Evidence], float]:
    def offset(evidence: Evidence) -> float:
        coating = evidence.map(WORN)
        window = between(coating.f_omega, speed - 2 * NEAR, speed + 2 * NEAR)
        halfwidth = evidence.config.analysis.peaks.order_halfwidth
        amplitude = order_amplitude(coating, order, halfwidth)
        vibration = _refined_maximum(coating.f_omega[window], amplitude[window])[0]
        return vibration - _wear_maximum(evidence, speed)

    return offset


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


def _log_ratio(one: CoatingCase, other: CoatingCase, order: int) -> Callable[[Evidence], float]:
    def ratio(evidence: Evidence) -> float:
        return float(np.log(_peak(evidence, one, order)[1] / _peak(evidence, other, order)[1]))

    return ratio


def _shift(one: CoatingCase, other: CoatingCase, order: int) -> Callable[[Evidence], float]:
    return lambda evidence: _peak(evidence, one, order)[0] - _peak(evidence, other, order)[0]


def _modulus_peaks(evidence: Evidence) -> pd.DataFrame:
    """Speed and amplitude of the peak of order 4 at every E and K, columns ``E``, ``K``, ``f4``, ``Y4``."""
    table = evidence.moduli(CASING, THETA, 4, "f_peak").stack().dropna()
    peaks = [(E, K, *_peak(evidence, CoatingCase(CASING, E, K, THETA), 4)) for K, E in table.index]
    return pd.DataFrame(peaks, columns=["E", "K", "f4", "Y4"])


def _over_hardening(reduce: Callable[[np.ndarray], float]) -> Callable[[Evidence], float]:
    """Find the smallest over E of `reduce` of f4 over ascending K, of each E that contact stiffens."""

    def smallest(evidence: Evidence) -> float:
        peaks = _modulus_peaks(evidence).sort_values("K")
        peaks = peaks[peaks.E > STIFFENING_FROM]
        values = [reduce(group.f4.to_numpy()) for _, group in peaks.groupby("E") if len(group) >= 2]
        if not values:
            raise NotMeasurable(f"no E above {STIFFENING_FROM:g} with two K or more")
        return float(min(values))

    return smallest


def _over_modulus(column: str, reduce: Callable[[np.ndarray], float]) -> Callable[[Evidence], float]:
    """Find the greatest over the low K of `reduce` of f4 or Y4 over E."""

    def greatest(evidence: Evidence) -> float:
        peaks = _modulus_peaks(evidence)
        peaks = peaks[(peaks.K <= SOFT_HARDENING) & (peaks.E >= SOFTEST)]
        values = [reduce(group[column].to_numpy()) for _, group in peaks.groupby("K") if len(group) >= 2]
        if not values:
            raise NotMeasurable(f"no K up to {SOFT_HARDENING:g} with two E or more")
        return float(max(values))

    return greatest


def _growth_at(case: CoatingCase, speed: float | CoatingCase) -> Callable[[Evidence], float]:
    def beyond_limit(evidence: Evidence) -> float:
        coating, index = _run(evidence, case, speed)
        if coating.status[index] == "unbounded":
            return _GREATEST_GROWTH
        settings = evidence.config.analysis.divergence
        excess = growth(coating.revolution_amplitude[index], settings).per_revolution - settings.growth
        return float(np.clip(excess, -_GREATEST_GROWTH, _GREATEST_GROWTH))

    return beyond_limit


def _six_at(case: CoatingCase, speed: float | CoatingCase) -> Callable[[Evidence], float]:
    def dominance(evidence: Evidence) -> float:
        coating, index = _run(evidence, case, speed)
        return float(_dominance(evidence, case, np.arange(coating.f_omega.size) == index, 6)[0])

    return dominance


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
        yield Target(name, part, EQUAL, paper, read, lambda e, c=case, k=order: _peak(e, c, k)[0])
    for name, part, speed in (("wear_0.26", "C3a", 0.26), ("wear_0.38", "C3b", 0.38)):
        yield Target(name, part, EQUAL, speed, read, lambda e, f=speed: _wear_maximum(e, f))
    yield Target("offset_0.26", "C3c", EQUAL, 0.0, _OTHER_BLADE, _vibration_offset(5, 0.26))
    yield Target("offset_0.38", "C3d", EQUAL, 0.0, _OTHER_BLADE, _vibration_offset(4, 0.38))


def _worn_lobes() -> Iterator[Target]:
    for part, (low, high) in zip(("C2a", "C2b"), FIVE_LOBES, strict=True):
        yield Target(f"five_{low:g}_{high:g}", part, AT_LEAST, 0.0, _SHARE, _between(low, high, 5, np.mean))
    for part, count, speed in (("C2c", 10, TEN_LOBES), ("C2d", 4, FOUR_LOBES)):
        dominance = _between(speed - NEAR, speed + NEAR, count, np.max)
        yield Target(f"harmonic_{count}_{speed:g}", part, AT_LEAST, 0.0, _SHARE, dominance)


def _heights() -> Iterator[Target]:
    low = float(np.log(SIGNIFICANT))
    yield Target("odd_over_even", "C4c", AT_MOST, low, 0.2, _odd_over_even)
    yield Target("weakest_crossing", "C5c", AT_LEAST, low, 0.2, _weakest_crossing)
    for order, critical, tilted in ((4, "C5a", "C10a"), (6, "C5b", "C10b")):
        yield Target(f"Y{order}_critical", critical, AT_LEAST, 0.0, _RATIO, _log_ratio(CRITICAL, SOFT, order))
        yield Target(f"Y{order}_tilted", tilted, AT_MOST, 0.0, _RATIO, _log_ratio(TILTED, STRAIGHT, order))
    yield Target("f4_shift", "C10c", AT_MOST, 0.0, _SHIFT, _shift(TILTED, STRAIGHT, 4))
    shift = TILTED_SPEED - STRAIGHT_SPEED
    yield Target("f6_shift", "C10d", EQUAL, shift, _SHIFT, _shift(TILTED, STRAIGHT, 6))


def _moduli() -> Iterator[Target]:
    rise, step = _over_hardening(lambda f: f[-1] - f[0]), _over_hardening(lambda f: np.diff(f).min())
    yield Target("f4_rise", "C7a", AT_LEAST, 0.0, _SHIFT, rise)
    yield Target("f4_step", "C7b", AT_LEAST, 0.0, _SHIFT, step)
    relative = _over_modulus("Y4", lambda height: np.ptp(height) / height.mean())
    yield Target("Y4_spread", "C8a", AT_MOST, HARDLY["amplitude"], _RATIO, relative)
    yield Target("f4_spread", "C8b", AT_MOST, HARDLY["f_peak"], _SHIFT, _over_modulus("f4", np.ptp))


def _divergence() -> Iterator[Target]:
    own = ((TILTED, TILTED_SPEED), (STRAIGHT, STRAIGHT_SPEED), (TILTED, TILTED), (STRAIGHT, STRAIGHT))
    others = ((STRAIGHT, TILTED_SPEED), (TILTED, STRAIGHT_SPEED), (STRAIGHT, TILTED), (TILTED, STRAIGHT))
    for name, letters, runs, relation, error, measure_at in (
        ("growth", "abgh", own, AT_LEAST, _GROWTH, _growth_at),
        ("growth", "cdij", others, AT_MOST, _GROWTH, _growth_at),
        ("six", "efkl", own, AT_LEAST, _SHARE, _six_at),
    ):
        for letter, (case, speed) in zip(letters, runs, strict=True):
            part = f"C11{letter}"
            yield Target(f"{name}_{part}", part, relation, 0.0, error, measure_at(case, speed))


TARGETS = (*_worn_lobes(), *_speeds(), *_heights(), *_moduli(), *_divergence())
"""What is matched, in the order of the tables."""
