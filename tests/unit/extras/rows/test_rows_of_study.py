import pytest

from bladerub.extras.rows import study
from bladerub.extras.rows.spec import Disk, Row
from bladerub.study.grid import run_spec
from bladerub.study.plan import longer_run, planned_run
from bladerub.study.solver import row_of


def test_runs_are_of_single_blades_unless_the_study_has_a_rotor(config):
    assert row_of(config) is None
    rotor = {"blades": 3, "length": [1e-5, 0.0, 0.0], "damping": [1.2], "coupling": [0.01, 0.003]}
    row = row_of(config | {"rotor": rotor})
    assert row == Row.even(3, [1e-5, 0.0, 0.0], damping=1.2, disk=Disk.ring(3, [0.01, 0.003]))
    drawn = row_of(config | {"rotor": rotor | {"length_scatter": 5e-5, "seed": 4}})
    draws = Row.drawn(3, 4, 5e-5)
    for own, plain, draw in zip(drawn.blades, row.blades, draws.blades, strict=True):
        assert own.length == plain.length + draw.length
        assert own.frequency == 0.0
    with pytest.raises(ValueError, match=r"row: 2 values of length; must be 1 or 3"):
        row_of(config | {"rotor": rotor | {"length": [0.0, 0.0]}})


def test_the_blades_and_the_sources_of_a_row_are_part_of_its_key_alone(config, case, monkeypatch):
    spec = run_spec(config, case, 0.19)

    def key(row):
        return planned_run(config, spec, "0.1900.h5", False, row).key("blade")

    rows = [
        None,
        Row.even(1),
        Row.even(2),
        Row.even(2, length=[0.0, 1e-5]),
        Row.even(2, frequency=0.01),
        Row.even(2, frequency=[[0.01], [0.01]]),
        Row.even(2, damping=2.0),
        Row.even(2, angle_error=0.01),
        Row.even(2, disk=Disk.ring(2, [0.01])),
    ]
    keys = [key(row) for row in rows]
    assert len(set(keys)) == len(rows)
    assert [key(row) for row in rows] == keys
    run = planned_run(config, spec, "0.1900.h5", False, rows[3])
    assert longer_run(config, run).row == rows[3]
    monkeypatch.setattr(study, "rows_digest", lambda: "other")
    assert key(rows[0]) == keys[0]
    assert key(rows[1]) != keys[1]
