"""The paper's claims, each measured by a function of its own on the tables and maps of the study.

The claims C1 to C12 are numbered in the order of the paper; a letter stands for a separately testable
part. A part that speaks of coatings or speeds outside the study has no row: the log names it and what is
missing.
"""

import logging
from collections.abc import Iterable
from dataclasses import asdict, fields
from pathlib import Path

import pandas as pd

from bladerub.io.tables import read as read_table
from bladerub.settings.study import Config
from bladerub.study import divergence, peaks
from bladerub.study.findings import moduli, tangential, wear_and_spectra
from bladerub.study.findings.claim import Claim, Finding, NotMeasurable, in_order
from bladerub.study.findings.evidence import Evidence
from bladerub.study.maps import CoatingMap

_REGISTERING = (moduli, tangential, wear_and_spectra)  # by their import

CLAIMS: tuple[Claim, ...] = in_order()
"""Every measurable part of every claim, in the order of the table."""

COLUMNS = ["id", *(field.name for field in fields(Finding))]
"""Columns of `table`, see `Finding`."""

_log = logging.getLogger(__name__)


def table(
    config: Config,
    maps: Iterable[CoatingMap],
    peaks_path: str | Path,
    divergence_path: str | Path,
    rom_accuracy: pd.DataFrame,
) -> pd.DataFrame:
    """Measure every claim that the maps and tables of a study allow: a row each, with `COLUMNS`.

    What is left out is logged as a warning.
    """
    tables = {
        "peaks": read_table(peaks_path, peaks.COLUMNS),
        "divergence": read_table(divergence_path, divergence.COLUMNS),
        "rom_accuracy": rom_accuracy,
    }
    return judge(Evidence(config, tables, maps))


def judge(evidence: Evidence, claims: Iterable[Claim] = CLAIMS) -> pd.DataFrame:
    """Measure `claims` on `evidence` (see `table`)."""
    rows = []
    for claim in claims:
        try:
            rows.append({"id": claim.id, **asdict(claim.measure(evidence))})
        except NotMeasurable as error:
            _log.warning("left out: %s: %s (%s)", claim.id, claim.statement, error)
    return pd.DataFrame(rows, columns=COLUMNS)
