"""How far the choices of the analysis decide the verdicts: the claims, judged again on parts of the study.

Nothing is simulated. Each variation drops speeds, Young moduli or plastic moduli of the study, or reads the
peaks through another window; then every claim is judged as in the study.
"""

import logging
from collections.abc import Iterable
from dataclasses import replace
from operator import attrgetter
from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.io.errors import BadInput
from bladerub.settings.study import Config
from bladerub.study import divergence, findings, peaks
from bladerub.study.findings.evidence import Evidence, read_rom_accuracy
from bladerub.study.grid import SAME_SPEED, SPEED_DECIMALS, speeds
from bladerub.study.maps import DATASETS, CoatingMap, read_map
from bladerub.study.wear import lobes

STUDY = "study"
"""Name of the variation that changes nothing."""

SETTINGS = {
    "window 0.90 to 1.20": ("peaks.speed_window", [0.9, 1.2]),
    "window 0.75 to 1.50": ("peaks.speed_window", [0.75, 1.5]),
    "window from the crossing": ("peaks.speed_window", [1.0, 1.35]),  # contact can but stiffen
    "line of the order alone": ("peaks.order_halfwidth", 0.0),
    "half an order each side": ("peaks.order_halfwidth", 0.5),
    "growth above 2 %": ("divergence.growth", 0.02),
}
"""Other values in ``config.analysis``: where a peak is looked for, how wide an order is, what grows."""

PROMINENCES = (0.05, 0.2)
"""Other values of ``analysis.lobe_prominence``: what counts as a lobe."""

_IN_FIGURES = {"E": {0.11, 1.1, 2.0, 11.0, 20.0, np.inf}, "K": {0.5, np.inf}}  # moduli that are never dropped
_log = logging.getLogger(__name__)


def variations(config: Config, maps: Iterable[CoatingMap]) -> dict[str, tuple[Config, list[CoatingMap]]]:
    """List the variations of the study of these `maps` by name, `STUDY` first.

    Each is the config with another window or threshold, or the maps with fewer coatings or speeds.
    """
    maps = [coating for coating in maps if not coating.case.variant]
    varied = {STUDY: (config, maps)}
    if _even_speeds(config, 1).size < len(speeds(config)):
        varied["even speeds only"] = config, _at(maps, _even_speeds(config, 1))
    for every in (2, 4):
        step = every * config.speeds.step
        varied[f"speed step {step:g}"] = config, _at(maps, _even_speeds(config, every))
    for name, (key, value) in SETTINGS.items():
        study_value = attrgetter(key)(config.analysis)
        # below the study's threshold of growth there are no longer runs to judge by
        if value != study_value and (key != "divergence.growth" or value > study_value):
            varied[name] = config.replaced(f"analysis.{key}", value), maps
    for prominence in PROMINENCES:
        if prominence != config.analysis.lobe_prominence:
            counted = [_with_lobes(coating, prominence) for coating in maps]
            varied[f"lobes above {100 * prominence:g} %"] = config, counted
    for modulus in ("E", "K"):
        values = {getattr(coating.case, modulus) for coating in maps}
        dropped = sorted(values - _IN_FIGURES[modulus])[::2]
        coatings = [coating for coating in maps if getattr(coating.case, modulus) not in dropped]
        if dropped and coatings:
            without = ", ".join(f"{value:g}" for value in dropped)
            varied[f"without {modulus} = {without}"] = config, coatings
    return varied


def _even_speeds(config: Config, every: int) -> np.ndarray:
    """Return each `every`-th of the even speeds, and those whose displacement is kept: claims name them."""
    even = speeds(config.replaced("speeds.extra", []))[::every]
    history_speeds = [round(entry.f_omega, SPEED_DECIMALS) for entry in config.analysis.histories]
    return np.union1d(even, history_speeds)


def _at(maps: Iterable[CoatingMap], f_omega: np.ndarray) -> list[CoatingMap]:
    """Return `maps` at those of their speeds that are in `f_omega`."""
    over_speed = [name for name, (dims, *_) in DATASETS.items() if dims[0] == "f_omega"]
    selected = []
    for coating in maps:
        mask = np.abs(coating.f_omega[:, None] - f_omega).min(axis=1) < SAME_SPEED
        values = {name: getattr(coating, name) for name in over_speed if getattr(coating, name) is not None}
        selected.append(replace(coating, **{name: array[mask] for name, array in values.items()}))
    return selected


def _with_lobes(coating: CoatingMap, prominence: float) -> CoatingMap:
    """Return `coating` with its lobes counted again."""
    counted = np.array([lobes(coating.angle, wear, prominence) for wear in coating.wear])
    return replace(coating, lobes=counted)


def table(config: Config, map_paths: Iterable[str | Path], rom_accuracy_path: str | Path) -> pd.DataFrame:
    """Judge every claim in every variation of the study with these files: a row each, as of findings.

    A claim that cannot be judged has no row; the log says so. Raises `BadInput` if all coatings have values
    of their own.
    """
    rom_accuracy, judged = read_rom_accuracy(rom_accuracy_path), []
    varied = variations(config, map(read_map, map_paths))
    if not varied[STUDY][1]:
        raise BadInput("coatings: margins need one without values of its own, as the claims do")
    for name, (settings, maps) in varied.items():
        _log.warning("%s:", name)  # a heading for what `findings` leaves out
        tables = {"peaks": peaks.table(settings, maps), "divergence": divergence.table(settings, maps)}
        tables["rom_accuracy"] = rom_accuracy
        judged.append(findings.judge(Evidence(settings, tables, maps)).assign(variation=name))
    return pd.concat(judged, ignore_index=True)[["variation", *findings.COLUMNS]]
