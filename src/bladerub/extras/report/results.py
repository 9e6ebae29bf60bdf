"""What the files of a finished study say of each coating at each speed."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from bladerub.blade.accuracy import ACCURACY_COLUMNS, CAMPBELL_COLUMNS
from bladerub.contact.result import UNBALANCED
from bladerub.io import hdf5, tables
from bladerub.study import bands, divergence, peaks
from bladerub.study.grid import CoatingCase, coating_cases
from bladerub.study.manifest import read_manifest
from bladerub.study.maps import CoatingMap, read_map
from bladerub.study.summary import spectral_peak
from bladerub.study.variants import of_case

STRESS = "last_von_mises"
"""Column of ``stress.csv`` that the page shows, Pa; not every study has the table."""

_RUN_COLUMNS = ["f_omega", "divergent", "saturating", "divergent_draws"]
_PEAK_COLUMNS = ["order", "f_peak", "amplitude", *bands.PEAK_COLUMNS, "reason"]


class Results(NamedTuple):
    """A finished study: SI units, speeds as normalised ``f_omega`` or ``f_peak`` and in ``rpm``.

    ``peaks`` has a row for each coating and engine order, ``runs`` one for each coating and speed, both with
    the ``name`` of the coating. ``coatings`` has one for each coating, by name, the worst first: its highest
    peak, its deepest wear, and the shares of its speeds that diverge and that pass the displacement limit.
    """

    config: Mapping[str, Any]
    folder: Path
    f1_hz: float  # of the blade at rest
    cases: dict[str, CoatingCase]
    peaks: pd.DataFrame
    runs: pd.DataFrame
    coatings: pd.DataFrame
    campbell: pd.DataFrame
    accuracy: pd.DataFrame
    origin: dict[str, str]  # provenance of the tables

    def map(self, name: str) -> CoatingMap:
        """Read the map of a coating."""
        return read_map(_map(self.folder, name))


def files(config: Mapping[str, Any], folder: Path) -> list[Path]:
    """List the files that a report needs of the results `folder`."""
    maps = [_map(folder, case.name) for case in coating_cases(config)]
    names = ("campbell", "rom_accuracy", "peaks", "divergence")
    return [_blade(folder), *maps, *(_table(folder, name) for name in names)]


def read(config: Mapping[str, Any], folder: Path) -> Results:
    """Read a finished study from the results `folder`.

    Raises `OSError`, naming the file, if one is damaged, and `ValueError` if tables and maps are not of the
    same coatings and speeds.
    """
    rpm = 60 * float(hdf5.read_attributes(_blade(folder))["f1_hz"])
    verdicts = tables.read(_table(folder, "divergence"), divergence.COLUMNS)
    peak_table = tables.read(_table(folder, "peaks"), peaks.COLUMNS)
    cases = {case.name: case for case in coating_cases(config)}
    runs = {
        name: _runs(read_map(_map(folder, name)), of_case(verdicts, case), folder)
        for name, case in cases.items()
    }
    all_peaks = _joined({name: _peaks(folder, case, peak_table, runs[name]) for name, case in cases.items()})
    all_peaks, all_runs = all_peaks.assign(rpm=rpm * all_peaks.f_peak), _joined(runs)
    all_runs = all_runs.assign(rpm=rpm * all_runs.f_omega)
    return Results(
        config=config,
        folder=folder,
        f1_hz=rpm / 60,
        cases=cases,
        peaks=all_peaks,
        runs=all_runs,
        coatings=_coatings(all_peaks, all_runs),
        campbell=tables.read(_table(folder, "campbell"), CAMPBELL_COLUMNS),
        accuracy=tables.read(_table(folder, "rom_accuracy"), ACCURACY_COLUMNS),
        origin=tables.read_origin(_table(folder, "peaks")),
    )


def _runs(coating: CoatingMap, verdicts: pd.DataFrame, folder: Path) -> pd.DataFrame:
    """Join map, verdicts and manifest of one coating: a row for each speed."""
    name = coating.case.name
    runs = verdicts.sort_values("f_omega").reset_index(drop=True)
    if not np.array_equal(runs["f_omega"], coating.f_omega):
        raise ValueError(f"tables/divergence.csv: not the speeds of maps/{name}.h5; run snakemake again")
    strongest = [spectral_peak(coating.spectrum_order, row) for row in coating.spectrum_amplitude]
    order, response = np.transpose(strongest)
    return runs.reindex(columns=_RUN_COLUMNS).assign(
        unbounded=(runs["status"] != "completed") | (coating.status != "completed"),
        strongest_order=order,
        response=response,
        displacement=np.nan_to_num(coating.revolution_peak).max(axis=1),
        max_wear=coating.max_wear,
        **_of_manifest(folder / "runs" / name / "manifest.tsv", coating.f_omega),
    )


def _of_manifest(path: Path, f_omega: np.ndarray) -> dict[str, list[float]]:
    """Say which runs did not converge or lose energy, 1 or 0; NaN where no manifest tells."""
    rows = {row.f_omega: row for row in read_manifest(path)} if path.exists() else {}
    listed = [rows.get(speed) for speed in f_omega.tolist()]
    return {
        "unconverged": [float(row.unconverged_steps > 0) if row else np.nan for row in listed],
        "unbalanced": [float(row.energy_residual > UNBALANCED) if row else np.nan for row in listed],
    }


def _peaks(folder: Path, case: CoatingCase, peak_table: pd.DataFrame, runs: pd.DataFrame) -> pd.DataFrame:
    """Join the peaks of one coating with the runs at their speeds and, where it is known, the stress."""
    rows = of_case(peak_table, case).reindex(columns=_PEAK_COLUMNS)
    if rows.empty:
        raise ValueError(f"tables/peaks.csv: has no peak of {case.name}; run snakemake again")
    run = runs[["f_omega", "divergent", "saturating", "max_wear"]]
    rows = rows.merge(run, "left", left_on="f_peak", right_on="f_omega")
    path = _table(folder, "stress")
    if path.exists():
        stress = of_case(tables.read(path, [*peaks.COLUMNS, STRESS]), case)
        return rows.merge(stress[["order", STRESS]], "left", on="order")
    return rows.assign(**{STRESS: np.nan})


def _coatings(all_peaks: pd.DataFrame, runs: pd.DataFrame) -> pd.DataFrame:
    highest = all_peaks.sort_values("amplitude", ascending=False, kind="stable", na_position="last")
    summaries = runs.groupby("name").agg(
        deepest=("max_wear", "max"),
        divergent_share=("divergent", "mean"),
        unbounded_share=("unbounded", "mean"),
    )
    return highest.drop_duplicates("name").set_index("name").join(summaries)


def _joined(parts: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    return pd.concat([part.assign(name=name) for name, part in parts.items()], ignore_index=True)


def _map(folder: Path, name: str) -> Path:
    return folder / "maps" / f"{name}.h5"


def _table(folder: Path, name: str) -> Path:
    return folder / "tables" / f"{name}.csv"


def _blade(folder: Path) -> Path:
    return folder / "blade" / "reduced_model.h5"
