"""How implausible a set is: how far its targets miss what the paper prints, in standard deviations.

For one target that is the excess over the square root of the variances of reading, of another blade and of
the prediction (Craig, Goldstein, Seheult, Smith 1997; Vernon, Goldstein, Bower 2010, Bayesian Analysis 5).
A set is left as long as the implausibility of no target exceeds `CUTOFF`, save of so many as are given up.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from bladerub.extras.variations.targets import TARGETS, Target

if TYPE_CHECKING:
    from bladerub.extras.variations.emulator import Emulator

CUTOFF = 3.0
"""Implausibility above which a set is ruled out: at most 5 % of any unimodal distribution lies beyond."""


def wide(quantities: pd.DataFrame) -> pd.DataFrame:
    """Return the measured targets (columns, in their order) of each set (rows)."""
    table = quantities.pivot(index="set", columns="target", values="value")
    return table[[name for name in TARGETS if name in table]]


def of_simulated(measured: pd.DataFrame) -> pd.DataFrame:
    """Return the implausibility of simulated sets, of the shape of `measured` from `wide`; NaN as there."""
    return measured.apply(lambda values: TARGETS[values.name].excess(values) / TARGETS[values.name].error)


def predicted(emulated: Mapping[str, "Emulator"], positions: np.ndarray) -> pd.DataFrame:
    """Predict the implausibility of each emulated target (columns) at `positions` (m, d)."""
    return pd.DataFrame(
        {name: _of_prediction(TARGETS[name], emulator, positions) for name, emulator in emulated.items()},
        index=range(len(positions)),  # also where nothing is emulated
    )


def without(implausibility: pd.DataFrame, given_up: int) -> np.ndarray:
    """Return the greatest implausibility of each set (n,), that of so many worse targets left out."""
    values = np.sort(np.nan_to_num(implausibility.to_numpy(), nan=np.inf), axis=1)
    return values[:, -1 - given_up] if given_up < values.shape[1] else np.zeros(len(values))


def _of_prediction(target: Target, emulator: "Emulator", positions: np.ndarray) -> np.ndarray:
    mean, deviation = emulator.predict(positions)
    return target.excess(mean) / np.hypot(target.error, deviation)
