"""The manifest of one column of the chart: its cells with key and size, written last."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from bladerub.io import atomic, hdf5
from bladerub.io.errors import DamagedFile

CELLS = "cells"
"""Folder of the cells, beside that of the manifests."""


class CellRow(NamedTuple):
    """One cell in the manifest of its column.

    Parameters
    ----------
    file : str
        Name of its file in the folder `CELLS`.
    cell_key : str
        From `bladerub.extensions.chart.key.cell_key`.
    bytes : int
        Size of the file.
    """

    file: str
    cell_key: str
    bytes: int


def write(path: str | Path, rows: Iterable[CellRow]) -> None:
    """Write the manifest (tab-separated, with a header) to `path`, whole or not at all."""
    with atomic.writing(path) as stream:
        writer = csv.writer(stream, delimiter="\t", lineterminator="\n")
        writer.writerow(CellRow._fields)
        writer.writerows(rows)


def read(path: str | Path) -> list[CellRow]:
    """Read the manifest written by `write`.

    Raises
    ------
    OSError
        If it is missing or no manifest; the message names it.
    """
    with Path(path).open(encoding="utf-8", newline="") as stream:
        reader = csv.reader(stream, delimiter="\t")
        try:
            if next(reader, None) != list(CellRow._fields):
                raise DamagedFile(f"{path}: not a manifest, its header is not {' '.join(CellRow._fields)}")
            return [CellRow(file, key, int(size)) for file, key, size in reader]
        except (ValueError, csv.Error) as error:
            raise DamagedFile(f"{path}: not a manifest, line {reader.line_num}: {error}") from error


def cell_path(manifest: str | Path, row: CellRow) -> Path:
    """Return where a cell of the manifest lies."""
    return Path(manifest).parents[1] / CELLS / row.file


def is_current(path: str | Path, key: str) -> bool:
    """Tell whether `path` holds the whole cell that `key` stands for; a damaged one does not."""
    try:
        return hdf5.read(path)[1]["cell_key"] == key
    except Exception:  # the answer is to compute the cell again
        return False


def lost_cell(path: str | Path) -> str | None:
    """Name a cell that the manifest at `path` lists and that is missing or has another size, if there is one.

    Raises
    ------
    OSError
        As `read`.
    """
    for row in read(path):
        cell = cell_path(path, row)
        if not (cell.is_file() and cell.stat().st_size == row.bytes):
            return str(cell)
    return None
