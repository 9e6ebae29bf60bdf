"""The two laws of friction compared: a contact force of constant direction, and Coulomb's law."""

from collections.abc import Iterable
from pathlib import Path

import pandas as pd

from bladerub.io.errors import DamagedFile
from bladerub.study.manifest import read_manifest
from bladerub.study.store import read_run
from bladerub.study.summary import displacement_peak

COLUMNS = [
    *("casing", "E", "K", "theta", "f_omega", "peak_theta", "peak_coulomb", "difference"),
    *("reversed_theta", "reversed_coulomb", "slowest_sliding", "status_theta", "status_coulomb"),
]
"""Columns of ``friction.csv``, described in ``columns.csv``."""

_COMPARED = ["peak", "reversed", "status"]


def table(pairs: Iterable[tuple[str | Path, str | Path]], revolutions: int) -> pd.DataFrame:
    """Compare runs speed by speed, with `COLUMNS`; peaks are those of the last `revolutions`.

    A pair is the manifest of a coating with a force of constant direction, and that of it by Coulomb's law.
    """
    tables = []
    for paths in pairs:
        constant, coulomb = (_runs(Path(path), revolutions) for path in paths)
        if list(constant.f_omega) != list(coulomb.f_omega):
            raise DamagedFile(f"{paths[1]}: its speeds are not those of {paths[0]}")
        by_law = [constant[_COMPARED].add_suffix("_theta"), coulomb[_COMPARED].add_suffix("_coulomb")]
        both = constant.join(by_law)
        tables.append(both.assign(difference=both.peak_coulomb / both.peak_theta - 1))
    return pd.concat(tables or [pd.DataFrame(columns=COLUMNS)], ignore_index=True)[COLUMNS]


def _runs(manifest: Path, revolutions: int) -> pd.DataFrame:
    """Read the runs of a coating: attributes, peak, and share of the steps in contact that are reversed."""
    runs = [read_run(manifest.with_name(row.file), {"revolution_peak"}) for row in read_manifest(manifest)]
    about = pd.DataFrame([run.attributes for run in runs])
    return about.assign(
        peak=[displacement_peak(run.data["revolution_peak"], revolutions) for run in runs],
        reversed=about.n_reversed_steps / about.n_contact_steps.clip(lower=1),
    )
