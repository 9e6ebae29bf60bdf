"""What decides: first-order and total Sobol indices of each factor, from a sparse polynomial chaos expansion.

The samples are those of one design, so that the indices take no further run; the expansion is OpenTURNS's
(Sudret 2008, Reliability Engineering & System Safety 93; Blatman and Sudret 2011, Journal of Computational
Physics 230). An expansion explains a part of the output only: the share of the variance that expansions made
without a fifth of the samples predict for that fifth. The indices are shares of what is explained; multiplied
by that share they become shares of the whole variance.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bladerub.extras.variations.emulator import Predicted, compared, from_others
from bladerub.extras.variations.settings import FEWEST
from bladerub.io.errors import package

openturns = package("openturns", "uq")

DEGREE = 4
"""Highest degree of a polynomial in one factor."""

SPARSITY = 0.5
"""Norm of the degrees in several factors that `DEGREE` bounds: the lower, the fewer interactions."""


class Indices(NamedTuple):
    """Sobol indices of one output for d factors: shares of its variance, as far as it is predicted."""

    first: np.ndarray  # (d,), by each factor alone
    total: np.ndarray  # (d,), by each factor with all its interactions
    predicted: float  # share predicted for samples left out; 0 if that is worse than their mean


def indices(positions: np.ndarray, output: np.ndarray) -> Indices:
    """Estimate the indices of `output` (n,) at `positions` (n, d), each factor evenly between 0 and 1.

    They are NaN if all of `output` is the same, and of fewer samples than `FEWEST`.
    """
    factors = range(positions.shape[1])
    if output.size < FEWEST or np.ptp(output) == 0:
        return Indices(*np.full((2, len(factors)), np.nan), np.nan)
    sobol = openturns.FunctionalChaosSobolIndices(_expansion(positions, output))
    predicted = max(compared(output, from_others(positions, output, _fit)).explained, 0.0)
    first = predicted * np.array([sobol.getSobolIndex(factor) for factor in factors])
    total = predicted * np.array([sobol.getSobolTotalIndex(factor) for factor in factors])
    return Indices(first, total, predicted)


def _fit(positions: np.ndarray, output: np.ndarray) -> Callable[[np.ndarray], Predicted]:
    if np.ptp(output) == 0:
        return lambda others: Predicted(output[0], 0.0)
    model = _expansion(positions, output).getMetaModel()
    return lambda others: Predicted(np.array(model(others)).ravel(), 0.0)


def _expansion(positions: np.ndarray, output: np.ndarray) -> openturns.FunctionalChaosResult:
    n_factors = positions.shape[1]
    uniform = openturns.Uniform(0.0, 1.0)
    counting = openturns.HyperbolicAnisotropicEnumerateFunction(n_factors, SPARSITY)
    polynomials = [openturns.StandardDistributionPolynomialFactory(uniform)] * n_factors
    basis = openturns.OrthogonalProductPolynomialFactory(polynomials, counting)
    expansion = openturns.FunctionalChaosAlgorithm(
        openturns.Sample(positions),
        openturns.Sample(output[:, None].astype(float)),
        openturns.JointDistribution([uniform] * n_factors),
        openturns.FixedStrategy(basis, counting.getMaximumDegreeCardinal(DEGREE)),
        openturns.LeastSquaresStrategy(
            openturns.LeastSquaresMetaModelSelectionFactory(
                openturns.LARS(), openturns.CorrectedLeaveOneOut()
            )
        ),
    )
    expansion.run()
    return expansion.getResult()
