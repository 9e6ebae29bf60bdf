"""What the files of a finished study say of each coating at each speed."""

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bladerub.blade.frequencies import ACCURACY_COLUMNS, CAMPBELL_COLUMNS
from bladerub.contact.result import UNBALANCED
from bladerub.extras.further_columns import with_further
from bladerub.io import hdf5, tables
from bladerub.settings.study import Config
from bladerub.study import divergence, peaks
from bladerub.study.grid import CoatingCase, coating_cases
from bladerub.study.manifest import read_manifest
from bladerub.study.maps import CoatingMap, read_map
from bladerub.study.summary import spectral_peak
from bladerub.study.variants import of_case

STRESS = "last_von_mises"  # column of ``stress.csv`` that the page shows, Pa; not every study has the table
BLADE = "blade/reduced_model.h5"


class Results(NamedTuple):
    """A finished study: SI units, speeds as normalised ``f_omega`` or ``f_peak`` and in ``rpm``.

    ``runs`` has a row for each coating and speed, ``peaks`` one for each coating and engine order, both with
    the ``name`` of the coating. ``coatings`` has one for each coating: highest peak, deepest wear, and the
    shares of its speeds that diverge and that pass the displacement limit. The worst come first.
    """

    config: Config
    folder: Path
    f1_hz: float  # of the blade at rest
    cases: dict[str, CoatingCase]
    peaks: pd.DataFrame
    runs: pd.DataFrame
    coatings: pd.DataFrame
    campbell: pd.DataFrame
    accuracy: pd.DataFrame
    chart: pd.DataFrame  # ``chart_choice.csv``, empty without a chart
    origin: dict[str, str]  # provenance of the tables

    def map(self, name: str) -> CoatingMap:
        """Read the map of a coating."""
        return read_map(self.folder / f"maps/{name}.h5")


def files(config: Config, folder: Path) -> list[Path]:
    """List the files that a report needs of the results `folder`."""
    tables = [folder / f"tables/{name}.csv" for name in ("campbell", "rom_accuracy", "peaks", "divergence")]
    return [folder / BLADE, *(folder / f"maps/{case.name}.h5" for case in coating_cases(config)), *tables]


def read(config: Config, folder: Path) -> Results:
    """Read a finished study from `folder`; `OSError` if a file is damaged, `ValueError` if files disagree."""
    f1_hz = float(hdf5.read_attributes(folder / BLADE)["f1_hz"])
    verdicts = tables.read(folder / "tables/divergence.csv", divergence.COLUMNS)
    verdicts = with_further(verdicts, folder / "tables/run_bands.csv")
    peak_table = tables.read(folder / "tables/peaks.csv", peaks.COLUMNS)
    peak_table = with_further(peak_table, folder / "tables/peak_bands.csv")
    cases = {case.name: case for case in coating_cases(config)}
    runs = pd.concat([_runs(folder, case, verdicts) for case in cases.values()], ignore_index=True)
    rows = pd.concat([_peaks(folder, case, peak_table, runs) for case in cases.values()], ignore_index=True)
    runs["rpm"], rows["rpm"] = 60 * f1_hz * runs.f_omega, 60 * f1_hz * rows.f_peak
    coatings = _coatings(rows, runs)
    chart = folder / "tables/chart_choice.csv"
    return Results(
        config=config,
        folder=folder,
        f1_hz=f1_hz,
        cases=cases,
        peaks=rows.sort_values("name", key=lambda names: names.map(coatings.index.get_loc), kind="stable"),
        runs=runs,
        coatings=coatings,
        campbell=tables.read(folder / "tables/campbell.csv", CAMPBELL_COLUMNS),
        accuracy=tables.read(folder / "tables/rom_accuracy.csv", ACCURACY_COLUMNS),
        chart=tables.read(chart) if chart.exists() else pd.DataFrame(),
        origin=tables.read_origin(folder / "tables/peaks.csv"),
    )


def _runs(folder: Path, case: CoatingCase, verdicts: pd.DataFrame) -> pd.DataFrame:
    """Join map, verdicts and manifest of one coating: a row for each speed."""
    coating = read_map(folder / f"maps/{case.name}.h5")
    runs = of_case(verdicts, case).sort_values("f_omega").reset_index(drop=True)
    if not np.array_equal(runs["f_omega"], coating.f_omega):
        raise ValueError(f"tables/divergence.csv: not the speeds of maps/{case.name}.h5; run snakemake again")
    path = folder / "runs" / case.name / "manifest.tsv"
    listed = {row.f_omega: row for row in read_manifest(path)} if path.exists() else {}
    known = [listed.get(speed) for speed in coating.f_omega.tolist()]
    strongest = [spectral_peak(coating.spectrum_order, row) for row in coating.spectrum_amplitude]
    order, response = np.transpose(strongest)
    return runs.reindex(columns=["f_omega", "divergent", "saturating", "divergent_draws"]).assign(
        unbounded=(runs["status"] != "completed") | (coating.status != "completed"),
        strongest_order=order,
        response=response,
        displacement=np.nan_to_num(coating.revolution_peak).max(axis=1),
        max_wear=coating.max_wear,
        # 1 or 0; NaN where no manifest tells
        unconverged=[float(row.unconverged_steps > 0) if row else np.nan for row in known],
        unbalanced=[float(row.energy_residual > UNBALANCED) if row else np.nan for row in known],
        name=case.name,
    )


def _peaks(folder: Path, case: CoatingCase, peak_table: pd.DataFrame, runs: pd.DataFrame) -> pd.DataFrame:
    """Join the peaks of one coating with the runs at their speeds and, where it is known, the stress."""
    bands = ["draws", "amplitude_low", "amplitude_high", "amplitude_error"]  # of ``peak_bands.csv``
    columns = ["order", "f_peak", "amplitude", *bands, "reason"]
    rows = of_case(peak_table, case).reindex(columns=columns)
    if rows.empty:
        raise ValueError(f"tables/peaks.csv: has no peak of {case.name}; run snakemake again")
    run = runs.loc[runs.name == case.name, ["f_omega", "divergent", "saturating", "max_wear"]]
    rows = rows.merge(run, "left", left_on="f_peak", right_on="f_omega")
    path = folder / "tables/stress.csv"
    known = path.exists()
    stress = tables.read(path, [*peaks.COLUMNS, STRESS]) if known else peak_table.assign(**{STRESS: np.nan})
    of_orders = of_case(stress, case)[["order", STRESS]]
    return rows.merge(of_orders, "left", on="order").assign(name=case.name)


def _coatings(rows: pd.DataFrame, runs: pd.DataFrame) -> pd.DataFrame:
    worst_first = rows.sort_values("amplitude", ascending=False, kind="stable")
    highest = worst_first.drop_duplicates("name").set_index("name", drop=False)
    of_runs = runs.groupby("name")[["max_wear", "divergent", "unbounded"]]
    deepest, shares = of_runs.max().max_wear.rename("deepest"), of_runs.mean().add_suffix("_share")
    return highest.join(deepest).join(shares)
