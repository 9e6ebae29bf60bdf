"""The paper's claims, each measured by a function of its own on the tables and maps of the study.

The claims C1 to C12 are numbered in the order of the paper; a letter stands for a separately testable
part. A part that speaks of coatings or speeds outside the study has no row: the log names it and what is
missing.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import asdict, fields
from pathlib import Path
from string import ascii_lowercase
from typing import Any

import pandas as pd

from bladerub.io.tables import read as read_table
from bladerub.study import divergence, peaks
from bladerub.study.findings import moduli, reduction, rigid_limit, spectra, tangential, wear_patterns
from bladerub.study.findings.evidence import Evidence
from bladerub.study.findings.finding import Finding, NotMeasurable
from bladerub.study.maps import read_map

CLAIMS: tuple[Callable[[Evidence], Finding], ...] = (
    reduction.first_six_modes,
    reduction.seventh_mode,
    wear_patterns.five_lobes_low,
    wear_patterns.five_lobes_high,
    wear_patterns.ten_lobes,
    wear_patterns.four_lobes,
    wear_patterns.wear_maximum_five,
    wear_patterns.wear_maximum_four,
    wear_patterns.vibration_maximum_five,
    wear_patterns.vibration_maximum_four,
    spectra.soft_peak_six,
    spectra.soft_peak_four,
    spectra.soft_even_orders,
    spectra.critical_is_higher_four,
    spectra.critical_is_higher_six,
    spectra.critical_all_orders,
    moduli.y4_greatest,
    moduli.y4_ridge,
    moduli.y4_high_cells,
    moduli.f4_rises,
    moduli.f4_monotonic,
    moduli.y4_insensitive,
    moduli.f4_insensitive,
    moduli.y6_greatest,
    moduli.f6_rises,
    moduli.f6_monotonic,
    moduli.y6_insensitive,
    moduli.f6_insensitive,
    tangential.lower_y4,
    tangential.lower_y6,
    tangential.lower_f4,
    tangential.lower_f6,
    tangential.tilted_diverges,
    tangential.straight_diverges,
    tangential.straight_is_steady,
    tangential.tilted_is_steady,
    tangential.tilted_lobes,
    tangential.straight_lobes,
    tangential.tilted_diverges_at_own_peak,
    tangential.straight_diverges_at_own_peak,
    tangential.straight_is_steady_at_tilted_peak,
    tangential.tilted_is_steady_at_straight_peak,
    tangential.tilted_lobes_at_own_peak,
    tangential.straight_lobes_at_own_peak,
    rigid_limit.stiff_is_rigid,
    moduli.softer_is_harmless,
)
"""Every measurable part of every claim, in the order of the table."""


def _split(claim: Callable[[Evidence], Finding]) -> tuple[str, str]:
    """Take id and statement from the first sentence of a claim's docstring."""
    id_, _, statement = claim.__doc__.split("\n\n")[0].partition(": ")
    return id_, " ".join(statement.split()).rstrip(".")


TITLES = dict(map(_split, CLAIMS))
"""What each part says, by its id, in the order of the table."""

COLUMNS = [field.name for field in fields(Finding)]
"""Columns of `table`, see `Finding`."""

_log = logging.getLogger(__name__)


def table(
    config: Mapping[str, Any],
    map_paths: Iterable[str | Path],
    peaks_path: str | Path,
    divergence_path: str | Path,
    rom_accuracy_path: str | Path,
) -> pd.DataFrame:
    """Measure every claim that the study allows.

    Parameters
    ----------
    config : mapping
        The study.
    map_paths : iterable of path-like
        Files of `bladerub.study.maps.build_map`.
    peaks_path, divergence_path, rom_accuracy_path : path-like
        The tables of the same study.

    Returns
    -------
    DataFrame
        A row per measured part, with `COLUMNS`; what is left out is logged as a warning.
    """
    tables = {
        "peaks": read_table(peaks_path, peaks.COLUMNS),
        "divergence": read_table(divergence_path, divergence.COLUMNS),
        "rom_accuracy": read_table(rom_accuracy_path, reduction.READS),
    }
    return judge(Evidence(config, tables, map(read_map, map_paths)))


def of_claims(claims: Collection[str]) -> list[Callable[[Evidence], Finding]]:
    """Return the measurable parts of the claims named, ``C2`` for C2a to C2d."""
    return [part for part, id_ in zip(CLAIMS, TITLES, strict=True) if claim_of(id_) in claims]


def claim_of(id_: str) -> str:
    """Return the claim that ``C2a`` is a part of: ``C2``."""
    return id_.rstrip(ascii_lowercase)


def judge(evidence: Evidence, claims: Iterable[Callable[[Evidence], Finding]] = CLAIMS) -> pd.DataFrame:
    """Measure `claims` on `evidence` (see `table`)."""
    rows = []
    for claim in claims:
        try:
            rows.append(asdict(claim(evidence)))
        except NotMeasurable as error:
            _log.warning("left out: %s (%s)", claim.__doc__.splitlines()[0], error)
    return pd.DataFrame(rows, columns=COLUMNS)


def verdicts(table: pd.DataFrame, by: str) -> pd.DataFrame:
    """Return ``holds`` of each claim (rows) by the values of the column `by` (columns), both in their order.

    Parameters
    ----------
    table : DataFrame
        Findings of several studies, or of several ways to look at one, told apart by the column `by`.
    by : str
        Name of that column.
    """
    wide = table.pivot_table(index="id", columns=by, values="holds", aggfunc="first")
    return wide.loc[list(dict.fromkeys(table["id"])), list(dict.fromkeys(table[by]))]
