"""Least-squares fit of the coating's law to stress-strain curves.

The curves are those of `bladerub.contact.law`: slope E, then ``E K / (E + K)`` from the elastic limit on.
Where they are at several rates, the elastic limit of a curve is ``σ_Y + H r^m``: the overstress of Perzyna's
and Norton's laws in steady flow (Lemaitre and Chaboche, Mechanics of Solid Materials, 1990, ch. 6). The
plastic strain then grows at the rate ``r = E / (E + K)`` times that of the test. H is the overstress at 1/s,
and with m = 1 the viscosity in Pa s. The strain in which the overstress builds up after the elastic limit,
about ``H r^m / (E + K)``, is neglected.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import f as fisher
from scipy.stats import t as student

from bladerub.api.arguments import over
from bladerub.contact import law
from bladerub.contact.spec import Coating
from bladerub.extras.fit.curves import Curve
from bladerub.extras.fit.curves import read as read_curves
from bladerub.io.errors import BadInput
from bladerub.io.values import Comparable

# parameters by name, in the order of the fit, with their units
UNITS = {"E": "Pa", "K": "Pa", "yield_stress": "Pa", "overstress": "Pa", "exponent": "1"}
LEVEL = 0.95  # of confidence
CORRELATED = 0.3  # successive residuals: beyond, they are no independent errors
_STARTS = (0.1, 0.3, 0.6, 0.9)  # elastic limit over the largest stress
_YIELDING = 0.999  # level; the place of the bend is sought, so that noise alone gains more than one of F says
_PRECISELY = {"xtol": 1e-12, "ftol": 1e-15, "gtol": 1e-15}  # exact curves give the exact law
_TRIED = 3  # of the starting values, the nearest
_EXPONENT = (0.02, 2.0)
# depths are strains, and stresses multiples of the largest one measured
_UNIT = Coating(E=1.0, K=1.0, theta=0.0, yield_stress=0.0, modulus_unit=1.0, thickness=1.0, n_elements=1)


@dataclass(frozen=True)
class Parameter:
    """A parameter as fitted, in `unit`; what the data do not determine has no uncertainty.

    `low` and `high` bound the confidence interval of the level `LEVEL`.
    """

    name: str
    unit: str
    value: float
    standard_error: float | None
    low: float | None
    high: float | None
    determined: bool


@dataclass(frozen=True, eq=False)
class Fit(Comparable):
    """The law fitted to curves.

    Parameters
    ----------
    parameters : tuple of Parameter
        In the order of `covariance`.
    covariance : ndarray of shape (p, p)
        Of the parameters, each in its unit; NaN for those that are not determined.
    residual : float
        Standard deviation of the residuals, Pa.
    autocorrelation : float
        Of successive residuals of a curve.
    rates : tuple of float
        Of the curves, 1/s.
    n_points : int
        Points of all curves.
    """

    parameters: tuple[Parameter, ...]
    covariance: np.ndarray
    residual: float
    autocorrelation: float
    rates: tuple[float, ...]
    n_points: int

    def __getitem__(self, name: str) -> Parameter:
        return next(parameter for parameter in self.parameters if parameter.name == name)

    @property
    def has_correlated_residuals(self) -> bool:
        """Whether the law does not follow the curves: the intervals are then too narrow."""
        return self.autocorrelation > CORRELATED


def stress(parameters: Sequence[float], curve: Curve) -> np.ndarray:
    """Compute the stress (n,) of a curve by the law; parameters as in `UNITS`, in one unit of stress."""
    E, K, limit, *rate_part = parameters
    if rate_part:
        overstress, exponent = rate_part
        limit += overstress * (curve.rate * E / (E + K)) ** exponent
    coating = replace(_UNIT, E=E, K=K, yield_stress=limit)
    _, wear = law.load(coating, np.maximum.accumulate(curve.strain), np.zeros(1))  # of the largest depth
    return law.load(coating, curve.strain, wear)[0]


@over("path")
def fit_coating(path: str | Path, *, strain_unit: str | None = None, stress_unit: str | None = None) -> Fit:
    """Fit E, K, the elastic limit and, over several rates, the overstress to compressive curves.

    Parameters
    ----------
    path : path
        Table in CSV with the columns ``strain``, ``stress`` and, for several rates, ``rate`` (1/s), a unit in
        brackets behind each: ``stress (MPa)``. A column ``test`` tells tests of one rate apart.
        A list of paths gives a list of fits.
    strain_unit : str, optional
        ``"1"`` or ``"%"``, where the header has none. Default: 1.
    stress_unit : str, optional
        ``"Pa"``, ``"kPa"``, ``"MPa"`` or ``"GPa"``, where the header has none.

    Returns
    -------
    Fit
        Parameters in Pa, with standard errors, intervals of 95 % and covariance.

    Raises
    ------
    BadInput
        If the table cannot be used: the message names column, line and value. A `ValueError`.

    Examples
    --------
    >>> import bladerub as br
    >>> rows = [f"{e / 1000},{min(900 * e / 1000, 9 + 50 * (e / 1000 - 0.01))}" for e in range(1, 41)]
    >>> with open("curve.csv", "w") as stream:
    ...     print("strain,stress (MPa)", *rows, sep=chr(10), file=stream)
    >>> fit = br.fit_coating("curve.csv")
    >>> round(fit["E"].value / 1e6), round(fit["yield_stress"].value / 1e6, 3), fit["K"].determined
    (900, 9.0, True)
    """
    return fit(read_curves(path, {"strain": strain_unit or "", "stress": stress_unit or ""}))


def fit(curves: Sequence[Curve]) -> Fit:
    """Fit the law to all curves at once, every point with the same weight; `BadInput` for too few points."""
    rates = sorted({curve.rate for curve in curves})
    names = list(UNITS)[: 3 if len(rates) == 1 else 4 if len(rates) == 2 else 5]
    points = sum(curve.strain.size for curve in curves)
    if points <= len(names):
        raise BadInput(f"{points} points are too few for {len(names)} parameters")
    unit = max(np.abs(curve.stress).max() for curve in curves)
    measured = np.concatenate([curve.stress for curve in curves]) / unit
    fixed = [1.0] if len(names) == 4 else []  # the exponent m is fitted from three rates on, and 1 for two

    def residuals(x: np.ndarray) -> np.ndarray:
        return np.concatenate([stress([*x, *fixed], curve) for curve in curves]) - measured

    tiny = 1e-9  # the law divides by E
    bounds = np.array([(tiny, np.inf), (0, np.inf), (0, np.inf), (0, np.inf), _EXPONENT])[: len(names)].T
    starts = sorted(_starts(curves, unit, len(names)), key=lambda start: np.sum(residuals(start) ** 2))
    optima = [
        least_squares(residuals, start, bounds=bounds, x_scale=np.abs(start) + 1e-3, **_PRECISELY)
        for start in starts[:_TRIED]
    ]
    optimum = min(optima, key=lambda result: result.cost)
    freedom = points - len(names)
    variance = 2 * optimum.cost / freedom
    scale = np.array([1.0 if UNITS[name] == "1" else unit for name in names])
    covariance = _covariance(optimum.jac, optimum.x) * variance * np.outer(scale, scale)
    if not _yields(curves, measured, 2 * optimum.cost, len(names)):
        covariance[1:] = covariance[:, 1:] = np.nan
    half = student.ppf(0.5 + LEVEL / 2, freedom)
    columns = zip(names, scale * optimum.x, np.diag(covariance), optimum.active_mask, strict=True)
    parameters = tuple(_parameter(half, *column) for column in columns)
    correlation = _autocorrelation(optimum.fun, [curve.strain.size for curve in curves])
    return Fit(parameters, covariance, float(np.sqrt(variance) * unit), correlation, tuple(rates), points)


def _starts(curves: Sequence[Curve], unit: float, n: int) -> list[np.ndarray]:
    """Choose starting values: secant of the steepest points, for several elastic limits and exponents."""
    strain = np.concatenate([curve.strain for curve in curves])
    stresses = np.concatenate([curve.stress for curve in curves]) / unit
    E = max(np.quantile(stresses[strain > 0] / strain[strain > 0], 0.9), 1e-6)
    fastest = max(curve.rate for curve in curves)
    starts = []
    for limit, exponent in product(_STARTS, (0.1, 0.3, 1.0) if n == 5 else (1.0,)):
        overstress = 0.5 * limit / fastest**exponent if n > 3 else 0.0
        starts.append(np.array([E, 0.2 * E + 1e-6, limit, overstress, exponent])[:n])
    return starts


def _yields(curves: Sequence[Curve], measured: np.ndarray, squares: float, n: int) -> bool:
    """Whether the law fits better than a straight line, by more than noise (F test on `squares` left)."""
    strain = np.concatenate([curve.strain for curve in curves])
    line = strain * (strain @ measured) / (strain @ strain)
    freedom = measured.size - n
    gained = (np.sum((measured - line) ** 2) - squares) / (n - 1)
    return bool(gained > fisher.ppf(_YIELDING, n - 1, freedom) * squares / freedom)


def _covariance(jacobian: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Compute the covariance for residuals of variance 1; NaN for parameters that the curves do not show."""
    scale = np.abs(x) + 1e-12  # relative changes
    _, singular, directions = np.linalg.svd(jacobian * scale, full_matrices=False)
    visible = singular > 1e-8 * singular[0]
    hidden = (np.abs(directions[~visible]) > 1e-4).any(axis=0)
    inverse = directions[visible].T / singular[visible]
    covariance = inverse @ inverse.T * np.outer(scale, scale)
    covariance[hidden] = covariance[:, hidden] = np.nan
    return covariance


def _parameter(half: float, name: str, value: float, variance: float, at_bound: int) -> Parameter:
    """Say what is known of a parameter: one whose interval reaches 0 is not determined."""
    value = float(value)
    if np.isnan(variance) or at_bound:
        return Parameter(name, UNITS[name], value, None, None, None, False)
    error = float(np.sqrt(variance))
    low, high = float(value - half * error), float(value + half * error)
    return Parameter(name, UNITS[name], value, error, low, high, low > 0)


def _autocorrelation(residuals: np.ndarray, sizes: Sequence[int]) -> float:
    """Correlation of successive residuals within the curves."""
    parts = np.split(residuals, np.cumsum(sizes)[:-1])
    total = np.sum(residuals**2)
    return float(sum(part[1:] @ part[:-1] for part in parts) / total) if total > 0 else 0.0
