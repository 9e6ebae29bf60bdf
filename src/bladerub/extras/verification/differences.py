"""Spectrum and amplitude of the outcome of a run, and how much two outcomes of the same run differ."""

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from bladerub.contact.result import RunResult
from bladerub.extras.verification.impact import Motion
from bladerub.settings.analysis import Analysis
from bladerub.study.spectra import order_spectrum
from bladerub.study.summary import spectral_peak


class Differences(NamedTuple):
    """Relative differences of one outcome from a reference, 0.01 being 1 %."""

    wear_l2: float  # L2 norm of the difference of the wear profiles (8, n) over the norm of the reference
    peak: float  # of the largest spectral amplitude from order 0.5 up
    revolution_peak: float  # largest of a revolution's peak, over the largest peak of all revolutions


UNBOUNDED = Differences(math.inf, math.inf, math.inf)  # where one of two outcomes is unbounded


def spectrum(run: RunResult | Motion, analysis: Analysis) -> tuple[np.ndarray, np.ndarray]:
    """Return engine orders and amplitudes (m) of a run, as the study has them."""
    lengths = run.revolution_peak.size, analysis.spectrum_revolutions
    return order_spectrum(run.radial_displacement, *lengths, analysis.max_order)


def amplitude_on(order: float, run: RunResult | Motion, analysis: Analysis) -> float:
    """Return the amplitude of a run on an engine order, m, as in `bladerub.study.peaks`."""
    orders, amplitude = spectrum(run, analysis)
    window = np.abs(orders - order) <= analysis.peaks.order_halfwidth + 1e-9
    return float(amplitude[window].max())


def differences(
    outcome: Sequence[RunResult], reference: Sequence[RunResult], analysis: Analysis
) -> Differences:
    """Compare two outcomes of the same run, of each blade of a row.

    A difference is 0 where both are zero, infinite where only the reference is, or a run is unbounded. The
    largest of a peak's differences over the blades is related to the largest of their peaks.
    """
    if any(result.status == "unbounded" for result in (*outcome, *reference)):
        return UNBOUNDED

    def over_blades(measure: Callable[[RunResult], Any]) -> float:
        values, reference_values = (
            np.array([measure(blade) for blade in blades]) for blades in (outcome, reference)
        )
        return _ratio(np.abs(values - reference_values).max(), reference_values.max())

    wear, reference_wear = outcome[0].wear, reference[0].wear  # shared by all blades
    return Differences(
        wear_l2=_ratio(np.linalg.norm(wear - reference_wear), np.linalg.norm(reference_wear)),
        peak=over_blades(lambda blade: spectral_peak(*spectrum(blade, analysis))[1]),
        revolution_peak=over_blades(lambda blade: blade.revolution_peak),
    )


def largest(several: Iterable[Differences]) -> Differences:
    """Take the largest of each difference."""
    return Differences(*map(max, zip(*several, strict=True)))


def _ratio(difference: float, reference: float) -> float:
    if difference == 0:
        return 0.0
    return float(difference / reference) if reference > 0 else math.inf
