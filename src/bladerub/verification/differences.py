"""How much two outcomes of the same run differ."""

import math
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

from bladerub.contact.result import RunResult
from bladerub.study.spectra import order_spectrum
from bladerub.study.summary import spectral_peak


class Differences(NamedTuple):
    """Relative differences of one outcome from a reference, 0.01 being 1 %."""

    wear_l2: float  # L2 norm of the difference of the wear profiles (8, n) over the norm of the reference
    peak: float  # of the largest spectral amplitude from order 0.5 up
    revolution_peak: float  # largest of a revolution's peak, over the largest peak of all revolutions


UNBOUNDED = Differences(math.inf, math.inf, math.inf)
"""The differences where one of two outcomes is unbounded."""


def differences(outcome: RunResult, reference: RunResult, analysis: Mapping[str, Any]) -> Differences:
    """Compare two outcomes of the same run; ``config["analysis"]`` decides on the spectrum.

    A difference is 0 where both are zero, infinite where only the reference is; all are infinite if either
    run is unbounded.
    """
    if "unbounded" in (outcome.status, reference.status):
        return UNBOUNDED
    peak, reference_peak = (_peak(result, analysis) for result in (outcome, reference))
    revolutions = np.abs(outcome.revolution_peak - reference.revolution_peak)
    return Differences(
        wear_l2=_ratio(np.linalg.norm(outcome.wear - reference.wear), np.linalg.norm(reference.wear)),
        peak=_ratio(abs(peak - reference_peak), reference_peak),
        revolution_peak=_ratio(revolutions.max(), reference.revolution_peak.max()),
    )


def largest(several: Iterable[Differences]) -> Differences:
    """Take the largest of each difference."""
    return Differences(*map(max, zip(*several, strict=True)))


def _peak(result: RunResult, analysis: Mapping[str, Any]) -> float:
    order, amplitude = order_spectrum(
        result.radial_displacement,
        result.revolution_peak.size,
        analysis["spectrum_revolutions"],
        analysis["max_order"],
    )
    return spectral_peak(order, amplitude)[1]


def _ratio(part: float, whole: float) -> float:
    if part == 0:
        return 0.0
    return float(part / whole) if whole > 0 else math.inf
