"""The files that users rely on: names, datasets, units; the tiny study has made them all."""

import json
import math

import h5py
import pandas as pd
import pytest
import xarray as xr

from bladerub.io.tables import description_path

COATING = "2nd_E2_K0.5_theta0.15"
WEAR_AND_SPECTRUM = {"wear", "angle", "spectrum_order", "spectrum_amplitude"}
DATASETS = {
    "blade/reduced_model.h5": {"mass", "stiffness_0", "stiffness_1", "stiffness_2", "node_position"},
    "blade/mesh.h5": {"points", "cells", "recovery"},
    f"runs/{COATING}/0.2300.h5": WEAR_AND_SPECTRUM | {"revolution_peak", "revolution_amplitude"},
    f"runs/{COATING}/0.1900.h5": WEAR_AND_SPECTRUM | {"revolution_peak", "radial_displacement"},
    "runs/*/confirmation/*.h5": WEAR_AND_SPECTRUM | {"revolution_peak", "revolution_amplitude"},
    f"maps/{COATING}.h5": WEAR_AND_SPECTRUM | {"f_omega", "revolution_amplitude", "confirmation_amplitude"},
}
"""What docs/reference promises to those who read the files."""

COATING_KEYS = ["casing", "E", "K", "theta"]
KEYS = {
    "blade/rom_accuracy": ["f_omega", "mode"],
    "tables/peaks": [*COATING_KEYS, "order"],
    "tables/margins": ["variation", "id"],
    "benchmarks/cost": ["rule", "job"],
    "figures/fig05_casing": ["nodal_diameters", "angle"],
    "figures/fig17_history_0190": ["theta", "revolution"],
    "figures/fig19_wear_polar": ["f_omega", "theta", "angle"],
}


@pytest.fixture
def results(study):
    return study.folder / "results"


PROVENANCE = {"software", "git_commit", "git_state", "config_sha256", "packages"}


@pytest.mark.parametrize("name", DATASETS)
def test_file_opens_in_xarray_and_says_what_it_holds(results, name):
    path = min(results.glob(name))
    with xr.open_dataset(path, engine="h5netcdf", phony_dims="sort") as dataset:
        assert set(dataset.variables) >= DATASETS[name]
        assert set(dataset.attrs) >= {f"provenance_{what}" for what in PROVENANCE}
    with h5py.File(path) as file:
        for variable in file.values():
            assert variable.attrs["units"], variable.name
            assert variable.attrs["long_name"], variable.name
            assert variable.is_scale or all(len(dim) == 1 for dim in variable.dims), variable.name


def test_beside_every_table_stands_what_its_columns_hold(results):
    tables = sorted([*(results / "tables").iterdir(), *(results / "figures").glob("*.csv*")])
    plain = [path for path in tables if path.suffix == ".csv"]
    assert tables == sorted([*plain, *map(description_path, plain)])
    for path in plain:
        about = json.loads(description_path(path).read_text(encoding="utf-8"))
        described = about["tableSchema"]["columns"]
        table = pd.read_csv(path)
        assert [column["name"] for column in described] == list(table.columns), path
        for column in described:
            if column["datatype"] in ("number", "integer") and not table.empty:
                assert table[column["name"]].dtype.kind in "if", (path, column)
        told = {entry["schema:name"] for entry in about["dc:provenance"]}
        assert told == {f"provenance_{what}" for what in PROVENANCE}


def test_every_table_has_one_row_for_each_observation(results):
    for name, keys in KEYS.items():
        table = pd.read_csv(results / f"{name}.csv", keep_default_na=False)
        assert len(table) > 0
        assert not table.duplicated(keys).any(), name


def test_the_rigid_casing_is_in_the_tables_but_not_in_the_histograms(results):
    with h5py.File(results / "runs/2nd_rigid_mu0/0.2300.h5") as run:
        assert (run.attrs["E"], run.attrs["K"], run.attrs["theta"]) == (math.inf, math.inf, 0)
        assert not run["wear"][:].any()
    for name, rows in (("peaks", 2), ("divergence", 8)):
        table = pd.read_csv(results / "tables" / f"{name}.csv")
        assert len(table.query("E == inf and K == inf")) == rows
    assert list(pd.read_csv(results / "figures" / "fig11_Y4.csv").E) == [0.11, 1.1, 2]


def test_every_figure_is_there_twice(results):
    for kind, first in (("png", b"\x89PNG"), ("pdf", b"%PDF")):
        files = sorted((results / "figures").glob(f"fig*.{kind}"))
        assert [path.name[:5] for path in files] == [f"fig{number:02}" for number in range(1, 20)]
        assert all(path.read_bytes().startswith(first) for path in files)
