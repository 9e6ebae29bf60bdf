"""Rows of blades by the real workflow: complete, restartable, and computed again only where they change."""

import pytest
import yaml

from bladerub.io import tables
from bladerub.study.store import read_run

COATING = {"casing": "2nd", "E": 2, "K": 0.5, "theta": 0.0}
SCATTER = {"length_scatter": [0, 5.0e-5], "frequency_scatter": [0.01], "coupling": [0.01]}
GROUP = COATING | {"f_omega": [0.19], "blades": [3]} | SCATTER | {"draws": 3}
SWEEP = GROUP | {"f_omega": [0.19, 0.25], "length_scatter": [5.0e-5], "draws": 2}
PATTERN = GROUP | {"length_scatter": [5.0e-5], "draws": 2}
PLAN = {
    "seed": 1,
    "groups": {"small": GROUP},
    "sweeps": {"two_speeds": SWEEP},
    "patterns": {"harmonic": 4, "interval": 1, "groups": {"some": PATTERN}},
}

TAIL = dict.fromkeys(("rotor_tables", "rotor_figure", "rotor_sweeps_figure", "rotor_patterns", "rotor"), 1)


def write(workspace, **changes):
    plan = PLAN | {"groups": {"small": GROUP | changes}}
    (workspace.folder / "config" / "rotor.yaml").write_text(yaml.safe_dump(plan, sort_keys=False))


@pytest.mark.nightly
def test_rows_are_made_once_and_lost_or_changed_ones_alone(copied_study, tiny):
    write(copied_study)
    assert copied_study.plan(tiny, "rotor") == TAIL | {"rotor_combination": 5}
    copied_study.build(tiny, "rotor")
    draws = tables.read(copied_study.results / "tables" / "rotor_draws.csv")
    table = tables.read(copied_study.results / "tables" / "rotor.csv")
    assert len(table) == 5
    assert len(draws) == table.rows.sum() == 2 * 3 + 1 + 2 + 1
    assert (draws.energy_residual < 1e-3).all()
    assert draws.divergent.dtype == bool
    alone = table[(table.blades == 1) & (table.frequency_scatter == 0)]
    assert alone.amplification_median.tolist() == [1.0, 1.0]
    drift = tables.read(copied_study.results / "tables" / "rotor_drift.csv")
    assert drift[["blades", "rows", "followed_rows"]].values.tolist() == [[1, 1, 1], [3, 2, 2]]
    assert copied_study.plan(tiny, "rotor") == {}

    folder = next((copied_study.results / "rotor" / "runs").glob("*_f0.1900_n3_l5e-05_d0.01_c0.01"))
    times = copied_study.runs()
    (folder / "0001.h5").unlink()
    (folder / "0002.h5").write_bytes(b"broken")
    counted = copied_study.status()["rows_of_blades"]
    assert (counted["planned"], counted["done"], counted["missing"], counted["corrupt"]) == (10, 8, 1, 1)
    copied_study.status("--discard")
    assert not (folder / "0002.h5").exists()
    copied_study.build(tiny, "rotor")
    again = copied_study.runs()
    assert {name[-7:] for name in times if times[name] != again[name]} == {"0001.h5", "0002.h5"}

    write(copied_study, draws=4)
    assert copied_study.plan(tiny, "rotor") == TAIL | {"rotor_combination": 2}
    copied_study.build(tiny, "rotor")
    assert len(tables.read(copied_study.results / "tables" / "rotor_draws.csv")) == 2 * 4 + 1 + 2 + 1
    more = copied_study.runs()
    assert {name[-7:] for name in more if more[name] != again.get(name)} == {"0003.h5"}


def test_a_study_may_be_of_rows_throughout(copied_study, tiny):
    rotor = {"blades": 2, "length": [0.0, 5.0e-5], "frequency_scatter": 0.01, "coupling": [0.01]}
    target = "results/maps/2nd_E2_K0.5_theta0.h5"
    copied_study.build(tiny | {"rotor": rotor}, target)
    folder = copied_study.results / "runs" / "2nd_E2_K0.5_theta0"
    run = read_run(folder / "0.1900.h5")
    assert run.data["blade_length"].tolist() == [0.0, 5.0e-5]
    assert run.attributes["energy_residual"] < 1e-3
    assert copied_study.plan(tiny | {"rotor": rotor}, target) == {}
    wrong = copied_study.snakemake("-n", target, config=tiny | {"rotor": rotor | {"length": [0.0] * 3}})
    assert wrong.returncode == 2
    assert "rotor: 3 values of length; must be 1 or 2" in wrong.stderr
