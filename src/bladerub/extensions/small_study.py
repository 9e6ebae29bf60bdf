"""A small study beside the main one: its runs and maps, by the same functions, in a folder of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from bladerub.blade.model import read_reduced_blade
from bladerub.study.grid import coating_cases
from bladerub.study.job import compute_missing
from bladerub.study.key import blade_digest
from bladerub.study.maps import build_map
from bladerub.study.store import write_manifest


def make_maps(
    config: Mapping[str, Any],
    model: str | Path,
    folder: str | Path,
    report: Callable[[object], None] = lambda line: None,
) -> list[Path]:
    """Run every coating of `config` and gather its map.

    Parameters
    ----------
    config : mapping
        The small study.
    model : path-like
        Its reduced blade.
    folder : path-like
        For its runs and maps; runs that are there and current are kept.
    report : callable, optional
        As of `bladerub.study.job.compute_missing`.

    Returns
    -------
    list of Path
        The maps, in the order of the coatings.
    """
    folder, blade, digest, maps = Path(folder), read_reduced_blade(model), blade_digest(model), []
    for case in coating_cases(config):
        runs, gathered = folder / "runs" / case.name, folder / "maps" / f"{case.name}.h5"
        rows = compute_missing(config, case, blade, runs, digest, report=report)
        write_manifest(runs / "manifest.tsv", rows)
        build_map(config, case, blade, runs, gathered)
        maps.append(gathered)
    return maps
