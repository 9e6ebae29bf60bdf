"""One sample of one part: a small study with the values of the sample, and the claims put to it."""

from __future__ import annotations

import itertools
import logging
import tempfile
import time
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd

from bladerub.config import read as configuration
from bladerub.extensions.small_study import make_maps
from bladerub.study import divergence, findings, peaks
from bladerub.study.findings.evidence import Evidence, read_rom_accuracy
from bladerub.study.maps import CoatingMap, read_map
from bladerub.study.store import read_manifest

COLUMNS = ["sample", "id", "holds", "margin"]
"""Columns of what the samples of a job say."""

COST = ["part", "sample", "runs", "cpu_s"]
"""Columns of what they cost."""

_log = logging.getLogger(__name__)


class Answer(NamedTuple):
    """What a sample says.

    Parameters
    ----------
    findings : DataFrame
        As `bladerub.study.findings.judge`, of the claims asked for.
    runs : int
        Simulated for it, longer ones for confirmation included.
    cpu_s : float
        Processor time of it all, s.
    """

    findings: pd.DataFrame
    runs: int
    cpu_s: float


def answer(
    config: Mapping[str, Any], claims: tuple[str, ...], model: str | Path, rom_accuracy: str | Path
) -> Answer:
    """Make the study of one sample in a folder for the time being, and put `claims` to it.

    Parameters
    ----------
    config : mapping
        Of the sample, from `bladerub.extensions.robustness.design.sample_configs`.
    claims : tuple of str
        ``C2`` stands for all its parts.
    model, rom_accuracy : path-like
        Reduced model of the sample's blade and the table of its accuracy.

    Raises
    ------
    ConfigError
        If the values of the sample make no study together.
    """
    start = time.process_time()
    configuration.validate(dict(config))
    with tempfile.TemporaryDirectory() as folder:
        paths = make_maps(config, model, folder)
        maps = [read_map(path) for path in paths]
        rows = [row for path in Path(folder).rglob("manifest.tsv") for row in read_manifest(path)]
    tables = {
        "peaks": _peaks(config, maps),
        "divergence": divergence.of_maps(config, maps),
        "rom_accuracy": read_rom_accuracy(rom_accuracy),
    }
    found = findings.judge(Evidence(config, tables, maps), findings.of_claims(claims))
    runs = len(rows) + sum(bool(row.confirmation_key) for row in rows)
    return Answer(found, runs, time.process_time() - start)


def _peaks(config: Mapping[str, Any], maps: Iterable[CoatingMap]) -> pd.DataFrame:
    """Find the peaks that there are: without a bounded run near its crossing an order has no row."""
    found = [pd.DataFrame(columns=peaks.COLUMNS)]
    for coating, order in itertools.product(maps, config["analysis"]["peaks"]["orders"]):
        analysis = {**config["analysis"], "peaks": {**config["analysis"]["peaks"], "orders": [order]}}
        try:
            found.append(peaks.of_maps({**config, "analysis": analysis}, [coating]))
        except ValueError as error:
            _log.warning("%s: no peak of engine order %g (%s)", coating.case.name, order, error)
    return pd.concat(found[1:] or found, ignore_index=True)
