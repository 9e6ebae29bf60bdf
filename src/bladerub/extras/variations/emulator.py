"""Prediction of a target between the simulated sets: a Gaussian process with a linear trend.

The process is OpenTURNS's, with a Matérn covariance (5/2) and a length for each factor. Its nugget is the
scatter that no smooth function explains: chaotic runs, and maxima between the speeds of the grid.
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
import pandas as pd

from bladerub.extras.variations.settings import FEWEST
from bladerub.io.errors import package

openturns = package("openturns", "uq")

FOLDS = 5
"""Number of parts that the sets are split into, each predicted from the others."""

_SMOOTHNESS = 2.5
_LENGTH, _LENGTHS = 2.0, (0.1, 10.0)  # first and bounds, in ranges of a factor: the longest effect is linear
_NUGGET, _NUGGETS = 0.1, (1e-6, 10.0)  # likewise, of the variance of the smooth part


class Predicted(NamedTuple):
    """Mean and standard deviation of a target at m points, each (m,); the scatter counts as deviation."""

    mean: np.ndarray
    deviation: np.ndarray


class HeldOut(NamedTuple):
    """How well sets are predicted that the emulator was not made from."""

    explained: float  # share of their variance; below 0 if their mean is a better prediction
    within_two: float  # share of them within two predicted standard deviations


class Emulator:
    """Gaussian process through `values` (n,) at `positions` (n, d), its `covariance` fitted unless given."""

    def __init__(
        self, positions: np.ndarray, values: np.ndarray, covariance: openturns.CovarianceModel | None = None
    ):
        self.positions, self.values, self.covariance = positions, values, covariance
        self._mean, self._scale = float(values.mean()), float(values.std())
        self._regression = None
        if self._scale > 1e-12 * max(1.0, abs(self._mean)):
            fitted = _fit(positions, (values - self._mean) / self._scale, covariance)
            self.covariance = fitted.getCovarianceModel()
            algorithm = openturns.GaussianProcessRegression(fitted)
            algorithm.run()
            self._regression = algorithm.getResult()

    def predict(self, positions: np.ndarray) -> Predicted:
        """Predict the target at `positions` (m, d)."""
        if self._regression is None:
            return Predicted(np.full(len(positions), self._mean), np.zeros(len(positions)))
        points = openturns.Sample(positions)
        mean = np.array(self._regression.getMetaModel()(points)).ravel()
        conditional = openturns.GaussianProcessConditionalCovariance(self._regression)
        variance = np.array(conditional.getConditionalMarginalVariance(points)).ravel()
        scatter = self.covariance.getNuggetFactor() * self.covariance.getAmplitude()[0] ** 2
        deviation = np.sqrt(np.maximum(variance, 0.0) + scatter)
        return Predicted(self._mean + self._scale * mean, self._scale * deviation)


def emulators(positions: np.ndarray, measured: pd.DataFrame) -> dict[str, Emulator]:
    """Fit an emulator to each target that enough sets have, at the `positions` (n, d) of these sets."""
    masks = {name: values.notna().to_numpy() for name, values in measured.items()}
    return {
        name: Emulator(positions[mask], measured[name][mask].to_numpy())
        for name, mask in masks.items()
        if mask.sum() >= FEWEST
    }


def held_out(emulator: Emulator) -> HeldOut:
    """Predict each of `FOLDS` parts of the sets of `emulator` from the others, with its covariance."""
    positions, values = emulator.positions, emulator.values
    fit = partial(Emulator, covariance=emulator.covariance)
    return compared(values, from_others(positions, values, lambda *others: fit(*others).predict))


def from_others(
    positions: np.ndarray, values: np.ndarray, fit: Callable[..., Callable[[np.ndarray], Predicted]]
) -> Predicted:
    """Predict each of `FOLDS` parts of the sets by what `fit` makes of positions and values of the others."""
    mean, deviation = np.empty((2, values.size))
    for part in range(FOLDS):
        outside = np.arange(values.size) % FOLDS == part
        predict = fit(positions[~outside], values[~outside])
        mean[outside], deviation[outside] = predict(positions[outside])
    return Predicted(mean, deviation)


def compared(values: np.ndarray, predicted: Predicted) -> HeldOut:
    """Compare simulated `values` (m,) with their prediction; NaN without any."""
    if values.size == 0:
        return HeldOut(np.nan, np.nan)
    missed, variance = values - predicted.mean, float(np.var(values))
    explained = 1 - np.mean(missed**2) / variance if variance > 0 else np.nan
    return HeldOut(float(explained), float(np.mean(np.abs(missed) <= 2 * predicted.deviation)))


def _fit(
    positions: np.ndarray, values: np.ndarray, covariance: openturns.CovarianceModel | None
) -> openturns.GaussianProcessFitterResult:
    n_factors, optimise = positions.shape[1], covariance is None
    if optimise:
        covariance = openturns.MaternModel([_LENGTH] * n_factors, [1.0], _SMOOTHNESS)
        covariance.setNuggetFactor(_NUGGET)
        covariance.activateNuggetFactor(True)
    points, outputs = openturns.Sample(positions), openturns.Sample(values[:, None])
    basis = openturns.LinearBasisFactory(n_factors).build()
    algorithm = openturns.GaussianProcessFitter(points, outputs, covariance, basis)
    algorithm.setOptimizeParameters(optimise)
    if optimise:
        # the default algorithm stops far from the maximum when there is scatter; the last point of a search
        # that ends early is as good
        search = openturns.TNC()
        search.setCheckStatus(False)
        algorithm.setOptimizationAlgorithm(search)
        low, high = ([length] * n_factors + [n] for length, n in zip(_LENGTHS, _NUGGETS, strict=True))
        algorithm.setOptimizationBounds(openturns.Interval(low, high))
    algorithm.run()
    return algorithm.getResult()
