"""One point of the chart, a coating: its engine orders and speeds, what is kept of its runs, and its file."""

from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np

from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.io.hdf5 import Variable
from bladerub.io.provenance import provenance
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, speeds
from bladerub.study.manifest import ListedFile
from bladerub.study.peaks import peak_orders

MEASURES = {
    "peak": ("m", "greatest absolute radial displacement of node 1"),
    "worn_volume": ("m3", "volume worn off the coating"),
    "deepest_wear": ("m", "greatest worn depth under any node"),
    "lobes": ("1", "number of worn lobes"),
    "unbounded": ("1", "1 where the tip exceeded the displacement limit"),
    "divergent": ("1", "1 where the run diverges; judged at the uniform speeds alone"),
    "revolutions": ("1", "revolutions made, the longer run for confirmation not counted"),
    "energy_damping": ("J", "energy dissipated by modal damping"),
    "energy_wear": ("J", "energy dissipated by plastic shortening of the coating"),
    "energy_sliding": ("J", "energy dissipated by the tangential resistance of the coating"),
}
"""What is kept of each run, with unit and meaning; NaN at speeds that were not run."""

KEY = "cell_key"
"""Attribute of the file of a point: its key in the store (`bladerub.study.cache`)."""

RUNS_KEY = "runs_key"
"""Attribute of the file of a point: what determines its runs, but not the speeds of the search."""

POINTS = "cells"
"""Folder of the points, next to that of the manifests."""


def chart_orders(config: Config) -> list[int]:
    """Return the engine orders of the chart, those of its casing: 4 and 6 in the paper's Figs. 11 to 14."""
    return peak_orders(config, config.chart.casing)


class ChartSpeeds(NamedTuple):
    """Speeds at which a point may be run, and those at which every point is."""

    f_omega: np.ndarray  # (n,), all speeds of the study, normalised: a run of the chart is one of the study's
    uniform: np.ndarray  # (n,) of bool, at even steps, to which the shares of the chart refer
    coarse: np.ndarray  # (n,) of bool, these and denser ones at low speed: where the search for maxima begins


def nearest_speeds(config: Config, multiple: int = 1) -> ChartSpeeds:
    """Choose the speeds nearest to the even ones of ``chart.speeds``, `multiple` times as far apart."""
    f_omega, settings = np.array(speeds(config)), config.chart.speeds
    start, stop, dense_stop = settings.start, f_omega[-1], min(settings.dense_stop, f_omega[-1])
    uniform = _nearest(f_omega, np.arange(start, stop + 1e-9, multiple * settings.step))
    dense = _nearest(f_omega, np.arange(start, dense_stop + 1e-9, multiple * settings.dense_step))
    return ChartSpeeds(f_omega, uniform, uniform | dense)


def _nearest(f_omega: np.ndarray, even: np.ndarray) -> np.ndarray:
    mask = np.zeros(f_omega.size, dtype=bool)
    mask[np.abs(f_omega - even[:, None]).argmin(axis=1)] = True
    return mask


class PointRow(NamedTuple):
    """One point in the manifest of its column: its file in the folder `POINTS`, key, size and SHA-256."""

    file: str
    cell_key: str
    bytes: int
    checksum: str

    def files(self, folder: Path) -> list[ListedFile]:
        """List the file of the point; `folder` is that of the manifest."""
        return [ListedFile(folder.parent / POINTS / self.file, self.bytes, self.checksum)]


_OVER_SPEED = ("f_omega",)
_LARGEST = "largest amplitude of the radial displacement of node 1 on the engine order; NaN: not run"


@dataclass(frozen=True)
class ChartPoint:
    """What the chart keeps of one coating, over all n speeds of the study; NaN where not run."""

    case: CoatingCase
    f_omega: Annotated[np.ndarray, _OVER_SPEED, "1", "rotational frequency over the first frequency at rest"]
    C1: Annotated[np.ndarray, _OVER_SPEED, "1", "first eigenfrequency at speed over that at rest"]
    spectrum_order: Annotated[np.ndarray, ("spectrum_order",), "1", "engine order"]
    spectrum_amplitude: Annotated[np.ndarray, (*_OVER_SPEED, "spectrum_order"), "m", _LARGEST]
    uniform: Annotated[np.ndarray, _OVER_SPEED, "1", "1 at the speeds of which shares are"]  # here of bool
    measures: dict[str, np.ndarray]  # (n,), by `MEASURES`

    @property
    def known(self) -> np.ndarray:
        """Which speeds were run (n,)."""
        return np.isfinite(self.measures["revolutions"])


_ARRAYS = {field.name: field.type.__metadata__ for field in fields(ChartPoint)[1:-1]}
DATASETS = _ARRAYS | {
    name: (_OVER_SPEED, unit, f"{what}; NaN: not run") for name, (unit, what) in MEASURES.items()
}
"""Dimensions, unit and meaning of each dataset."""


def write(path: str | Path, point: ChartPoint, key: str, runs_key: str, config: Config) -> None:
    """Write `point` under its `key`, and that of its runs, whichever of their speeds the search chose."""
    values = vars(point) | point.measures | {"uniform": point.uniform.astype(np.int8)}
    variables = {name: Variable(dims, values[name], *about) for name, (dims, *about) in DATASETS.items()}
    attributes = asdict(point.case) | {KEY: key, RUNS_KEY: runs_key}
    hdf5.write(path, variables, attributes, provenance(config.plain()))


def read(path: str | Path) -> ChartPoint:
    """Read a point written by `write`; raises `OSError` if the file is missing, damaged or none."""
    data, attributes = hdf5.read(path)
    try:
        arrays = {name: data[name] for name in _ARRAYS} | {"uniform": data["uniform"].astype(bool)}
        measures = {name: data[name] for name in MEASURES}
        return ChartPoint(CoatingCase.described(attributes), **arrays, measures=measures)
    except KeyError as error:
        raise DamagedFile(f"{path}: not a point of the chart, {error} is missing") from error
