"""How far the choices of the analysis decide the answers: the claims, put again to parts of the study.

Nothing is simulated. Each variation drops speeds, Young moduli or plastic moduli of the study, or reads the
peaks through another window; then every claim is judged as in the study.
"""

from __future__ import annotations

import copy
import logging
from collections.abc import Iterable, Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from bladerub.study import divergence, findings, peaks
from bladerub.study.findings.evidence import SAME_SPEED, Evidence, read_rom_accuracy
from bladerub.study.grid import SPEED_DECIMALS, speeds
from bladerub.study.maps import CoatingMap, read_map

COLUMNS = ["variation", "id", "claim", "paper", "measured", "unit", "holds", "margin"]
"""Columns of ``margins.csv``: those of ``findings.csv`` for each variation."""

STUDY = "study"
"""Name of the variation that changes nothing."""

SETTINGS = {
    "window 0.90 to 1.20": ("peaks", "speed_window", [0.9, 1.2]),
    "window 0.75 to 1.50": ("peaks", "speed_window", [0.75, 1.5]),
    "window from the crossing": ("peaks", "speed_window", [1.0, 1.35]),  # contact can but stiffen
    "line of the order alone": ("peaks", "order_halfwidth", 0.0),
    "half an order each side": ("peaks", "order_halfwidth", 0.5),
    "growth above 2 %": ("divergence", "growth", 0.02),
}
"""Other values in ``config["analysis"]``: where a peak is looked for, how wide an order is, what grows."""


_log = logging.getLogger(__name__)

_OF_FIGURES = {"E": {0.11, 1.1, 2.0, 11.0, 20.0, np.inf}, "K": {0.5, np.inf}}


class Variation(NamedTuple):
    """One way to look at the study.

    Parameters
    ----------
    config : dict
        With other windows or thresholds.
    maps : list of CoatingMap
        With fewer coatings or speeds.
    """

    config: dict[str, Any]
    maps: list[CoatingMap]


def variations(config: Mapping[str, Any], maps: Iterable[CoatingMap]) -> dict[str, Variation]:
    """List the variations by name, `STUDY` first.

    Parameters
    ----------
    config : mapping
        The study.
    maps : iterable of CoatingMap
        Its coatings.
    """
    maps, config = list(maps), dict(config)
    varied = {STUDY: Variation(config, maps)}
    if _even_speeds(config, 1).size < len(speeds(config)):
        varied["even speeds only"] = Variation(config, _at(maps, _even_speeds(config, 1)))
    for every in (2, 4):
        step = every * config["speeds"]["step"]
        varied[f"speed step {step:g}"] = Variation(config, _at(maps, _even_speeds(config, every)))
    for name, (part, key, value) in SETTINGS.items():
        own = config["analysis"][part][key]
        # below the study's threshold of growth there are no longer runs to judge by
        if value != own and (key != "growth" or value > own):
            varied[name] = Variation(_with(config, part, key, value), maps)
    for modulus in ("E", "K"):
        dropped = _every_second(maps, modulus)
        kept = [coating for coating in maps if getattr(coating.case, modulus) not in dropped]
        if dropped and kept:
            without = ", ".join(f"{value:g}" for value in sorted(dropped))
            varied[f"without {modulus} = {without}"] = Variation(config, kept)
    return varied


def _even_speeds(config: Mapping[str, Any], every: int) -> np.ndarray:
    """Return each `every`-th of the even speeds, and those whose displacement is kept: claims name them."""
    grid = config["speeds"]
    even = speeds({**config, "speeds": {**grid, "extra": []}})[::every]
    named = [round(float(entry["f_omega"]), SPEED_DECIMALS) for entry in config["analysis"]["histories"]]
    return np.union1d(even, named)


def _at(maps: Iterable[CoatingMap], f_omega: np.ndarray) -> list[CoatingMap]:
    return [
        _select(coating, np.abs(coating.f_omega[:, None] - f_omega).min(axis=1) < SAME_SPEED)
        for coating in maps
    ]


_NOT_OVER_SPEED = {"case", "angle", "spectrum_order"}


def _select(coating: CoatingMap, chosen: np.ndarray) -> CoatingMap:
    over_speed = {
        field.name: getattr(coating, field.name)
        for field in fields(CoatingMap)
        if field.name not in _NOT_OVER_SPEED
    }
    return replace(
        coating, **{name: values[chosen] for name, values in over_speed.items() if values is not None}
    )


def _with(config: Mapping[str, Any], part: str, key: str, value: Any) -> dict[str, Any]:
    varied = copy.deepcopy(dict(config))
    varied["analysis"][part][key] = value
    return varied


def _every_second(maps: Iterable[CoatingMap], modulus: str) -> set[float]:
    """Return every second of the values that no figure stands on (those are `_OF_FIGURES`)."""
    values = {getattr(coating.case, modulus) for coating in maps}
    return set(sorted(values - _OF_FIGURES[modulus])[::2])


def table(
    config: Mapping[str, Any], map_paths: Iterable[str | Path], rom_accuracy_path: str | Path
) -> pd.DataFrame:
    """Judge every claim in every variation.

    Parameters
    ----------
    config : mapping
        The study.
    map_paths : iterable of path-like
        Files of `bladerub.study.maps.build_map`.
    rom_accuracy_path : path-like
        The table of the same study.

    Returns
    -------
    DataFrame
        A row for each claim in each variation, with `COLUMNS`; a claim that a variation cannot tell has none.
        A variation that leaves no speed to look for a peak at is left out; the log says so.

    Raises
    ------
    ValueError
        As `bladerub.study.peaks.of_maps`, of the study itself.
    """
    rom_accuracy = read_rom_accuracy(rom_accuracy_path)
    judged = []
    for name, (settings, maps) in variations(config, map(read_map, map_paths)).items():
        _log.warning("%s:", name)  # a heading for what `findings` leaves out
        try:
            found = peaks.of_maps(settings, maps)
        except ValueError as error:
            if name == STUDY:
                raise
            _log.warning("left out: all of it (%s)", error)
            continue
        tables = {
            "peaks": found,
            "divergence": divergence.of_maps(settings, maps),
            "rom_accuracy": rom_accuracy,
        }
        judged.append(findings.judge(Evidence(settings, tables, maps)).assign(variation=name))
    return pd.concat(judged, ignore_index=True)[COLUMNS]
