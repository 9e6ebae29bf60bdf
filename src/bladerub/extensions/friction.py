"""The two laws of friction compared: a contact force of constant direction, and Coulomb's law."""

from collections.abc import Iterable, Iterator
from pathlib import Path

import pandas as pd

from bladerub.io.errors import DamagedFile
from bladerub.study.manifest import read_manifest
from bladerub.study.store import StoredRun, read_run
from bladerub.study.summary import displacement_peak

COLUMNS = [
    "casing",
    "E",
    "K",
    "theta",
    "f_omega",
    "peak_theta",
    "peak_coulomb",
    "difference",
    "reversed_theta",
    "reversed_coulomb",
    "slowest_sliding",
    "status_theta",
    "status_coulomb",
]
"""Columns of ``friction.csv``, described in ``io/columns.csv``."""


def table(pairs: Iterable[tuple[str | Path, str | Path]], revolutions: int) -> pd.DataFrame:
    """Compare the runs of each pair of coatings, speed by speed: a row per run, with `COLUMNS`.

    A pair is the manifest of a coating with a force of constant direction and that of the same by Coulomb's
    law; peaks are sought in the last `revolutions`. Raises `OSError` if a manifest or run is missing or
    damaged, or the speeds of a pair differ.
    """
    rows = []
    for constant_path, coulomb_path in pairs:
        pair = list(_runs(Path(constant_path))), list(_runs(Path(coulomb_path)))
        speeds, others = ([run.attributes["f_omega"] for run in runs] for runs in pair)
        if speeds != others:
            raise DamagedFile(f"{coulomb_path}: its speeds are not those of {constant_path}")
        for constant, coulomb in zip(*pair, strict=True):
            about = constant.attributes
            peaks = [
                displacement_peak(run.data["revolution_peak"], revolutions) for run in (constant, coulomb)
            ]
            rows.append(
                {
                    **{name: about[name] for name in COLUMNS[:5]},
                    "peak_theta": peaks[0],
                    "peak_coulomb": peaks[1],
                    "difference": peaks[1] / peaks[0] - 1,
                    "reversed_theta": _reversed(constant),
                    "reversed_coulomb": _reversed(coulomb),
                    "slowest_sliding": about["slowest_sliding"],
                    "status_theta": about["status"],
                    "status_coulomb": coulomb.attributes["status"],
                }
            )
    return pd.DataFrame(rows, columns=COLUMNS)


def _runs(manifest: Path) -> Iterator[StoredRun]:
    for row in read_manifest(manifest):
        yield read_run(manifest.with_name(row.file), {"revolution_peak"})


def _reversed(run: StoredRun) -> float:
    """Share of the steps in contact in which a node in contact does not slide with the rotation."""
    return run.attributes["n_reversed_steps"] / max(run.attributes["n_contact_steps"], 1)
