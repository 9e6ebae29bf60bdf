"""Growth of one run: whether its vibration keeps growing with time, and how surely.

The paper calls a run divergent when its amplitude "continuously grows with time". Here that is:

1. The amplitude A_i is half the range of the radial displacement of node 1 in revolution i. The mean
   deflection in contact, which changes as the coating wears, is no part of it.
2. The growth rate is the slope s of ln A_i over the last ``revolutions``, by least squares; of an unbounded
   run, over the last whole ones. Growth per revolution is ``exp(s) - 1``.
3. Its confidence interval is ``exp(s ± t e) - 1``: e is the standard error of the slope from the scatter of
   ln A_i about the line, t the two-sided quantile of Student's distribution at ``confidence`` with n − 2
   degrees of freedom. The scatter counts as `RESOLUTION` at least, and revolutions as independent of each
   other.
4. A run grows when the lower end of that interval is above ``growth``, and the greatest amplitude of those
   revolutions exceeds the greatest before them by more than so much growth would make in that time: a beat
   that returns is no growth.
5. A growing run levels off when a parabola through the same ln A_i is surely bent downwards (the interval
   of its curvature is below 0) and its slope at the last revolution is no longer surely above ``growth``
   (the lower end of its interval is not); both with t at n − 3 degrees of freedom.
6. A completed run that grows, levelling off or not, goes on to ``confirmation_revolutions``, and the
   last ``revolutions`` of the longer run are judged in the same manner.
7. A run is saturating when it grows but levels off, or when it grew and the longer run no longer does (it
   may also have turned to decay).
8. A run is divergent when it is unbounded, or grows and does not level off.

``tests/unit/study/test_growth.py`` shows what that finds in 20 and in 60 revolutions, and what it does not.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import scipy

from bladerub.contact.spec import RunSpec
from bladerub.io.sources import digest_of
from bladerub.settings.analysis import Divergence

RESOLUTION = 1e-3
"""Relative scatter below which amplitudes show nothing: the accuracy of a run is not better."""


class Growth(NamedTuple):
    """Growth of an amplitude over its last revolutions, see the definitions 2 to 5 of this module."""

    per_revolution: float  # 0.03 is 3 %; 0 for a blade that never moved, NaN from fewer than two revolutions
    low: float  # confidence interval; NaN from fewer than three revolutions
    high: float
    grows: bool = False
    levels_off: bool = False  # only of a run that grows


class Verdict(NamedTuple):
    """The verdict on one run, never both saturating and divergent; see the definitions 6 to 8 of this module.

    Growth, length and status are of the longest run there is; an unbounded one ended in its last revolution.
    """

    growth: Growth
    saturating: bool
    divergent: bool
    revolutions: int
    status: str


def growth(amplitude: np.ndarray, settings: Divergence) -> Growth:
    """Measure the growth at the end of one run.

    `amplitude` (n,) is that in each revolution, m; NaN after an early end. `settings` are
    ``config.analysis.divergence``.
    """
    record = amplitude[np.isfinite(amplitude)]
    window = record[-settings.revolutions :]
    if window.size and not window.any():
        return Growth(0.0, 0.0, 0.0)
    number = np.flatnonzero(window > 0)
    points = number - float(window.size - 1), np.log(window[number])  # time and amplitude
    line = _parameters(1, *points, settings.confidence)
    low, slope, high = (float(np.expm1(coefficients[1])) for coefficients in line)
    threshold, before = settings.growth, record[: -settings.revolutions].max(initial=0.0)
    outgrown = window.max(initial=0.0) > before * (1 + threshold) ** settings.revolutions
    if not (low > threshold and outgrown):
        return Growth(slope, low, high)
    lowest, _, highest = _parameters(2, *points, settings.confidence)
    is_bent = highest[2] < 0
    levels_off = bool(is_bent and np.expm1(lowest[1]) <= threshold)
    return Growth(slope, low, high, True, levels_off)


def _parameters(
    degree: int, time: np.ndarray, log_amplitude: np.ndarray, confidence: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Fit a polynomial in `time`: coefficients from the constant up, between lower and upper bounds.

    Returns lower bounds, coefficients and upper bounds. Time is 0 at the last revolution, so the second
    coefficient is the slope there. The bounds are those of the interval of `confidence`, NaN where no
    revolution is left to show the scatter; with fewer revolutions than coefficients, all is NaN.
    """
    missing = np.full(degree + 1, np.nan)
    freedom = time.size - degree - 1
    if freedom < 0:
        return missing, missing, missing
    design = np.vander(time, degree + 1, increasing=True)  # from coefficients to values
    inverse = np.linalg.pinv(design)
    coefficients = inverse @ log_amplitude
    if freedom == 0:
        return missing, coefficients, missing
    residual = log_amplitude - design @ coefficients
    scatter = max(float(np.sqrt(residual @ residual / freedom)), RESOLUTION)
    error = scatter * np.linalg.norm(inverse, axis=1)
    margin = scipy.special.stdtrit(freedom, (1 + confidence) / 2) * error
    return coefficients - margin, coefficients, coefficients + margin


def needs_confirmation(amplitude: np.ndarray, status: str, settings: Divergence) -> bool:
    """Return whether a run of this amplitude and status is to go on for more revolutions."""
    is_shorter = amplitude.size < settings.confirmation_revolutions  # which is 0 where none goes on
    return is_shorter and status == "completed" and growth(amplitude, settings).grows


def judge(
    amplitude: np.ndarray, status: str, settings: Divergence, confirmation: np.ndarray | None = None
) -> Verdict:
    """Judge one run.

    `amplitude` (n,) is that in each revolution, m; NaN after an early end. `status` is ``completed`` or
    ``unbounded``, `settings` are ``config.analysis.divergence``. `confirmation` (m,) is the amplitude
    of the longer run: none, or NaN throughout, if there is no such run.
    """
    confirmed = confirmation is not None and bool(np.isfinite(confirmation).any())
    longest = confirmation if confirmed else amplitude
    if confirmed:
        status = "completed" if np.isfinite(confirmation).all() else "unbounded"
    trend = growth(longest, settings)
    divergent = status == "unbounded" or (trend.grows and not trend.levels_off)
    return Verdict(
        growth=trend,
        saturating=(confirmed or trend.grows) and not divergent,
        divergent=divergent,
        revolutions=int(np.isfinite(longest).sum()) + (status == "unbounded"),
        status=status,
    )


def confirmation_spec(spec: RunSpec, settings: Divergence) -> RunSpec:
    """Describe the longer run of `spec`: the same from rest with the same step, for more revolutions."""
    return replace(spec, revolutions=settings.confirmation_revolutions)


def growth_digest() -> str:
    """Digest the source of what decides whether a run grows."""
    return digest_of("study/growth.py")
