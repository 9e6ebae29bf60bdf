import numpy as np
import pytest

from bladerub.config.errors import ConfigError
from bladerub.config.read import validate
from bladerub.contact.casing import gap
from bladerub.extras.casings.settings import MeasuredCasing
from bladerub.study.grid import CoatingCase, casing_spec, coating_cases, run_spec
from bladerub.study.peaks import excites, nodal_diameters

ANGLE = np.arange(0, 360, 5)
GAP = 0.3 - 0.5 * np.cos(np.deg2rad(3 * ANGLE))  # mm
ROWS = [f"{a},{g!r}" for a, g in zip(ANGLE.tolist(), GAP.tolist(), strict=True)]


@pytest.fixture
def table(tmp_path):
    def written(rows, header="angle,gap", **entry):
        path = tmp_path / "gap.csv"
        path.write_text("\n".join(["# measured cold", header, *rows]) + "\n")
        return {"table": {"file": str(path), "unit": "mm"}, "start_angle": 60.0} | entry

    return written


def test_the_gap_of_a_table_is_that_of_the_casing_also_when_it_turns_elsewhere_and_is_closed(table):
    entry = MeasuredCasing.model_validate(table(ROWS))
    casing = casing_spec("own", entry, length_scale=3.0)
    np.testing.assert_allclose(gap(casing, 1e-4, np.deg2rad(ANGLE)), 1e-4 + GAP * 1e-3, atol=1e-15)
    assert casing.interference == pytest.approx(0.2e-3)
    assert casing.start_angle == pytest.approx(np.pi / 3)
    assert nodal_diameters(entry) == [3]
    assert excites(entry, 6) > excites(entry, 4)
    there = casing_spec("own", entry)
    cells = [row.split(",") for row in ROWS]
    turned = [*cells[30:], *([str(360 + int(angle)), of_gap] for angle, of_gap in cells[:31])]
    entry = MeasuredCasing.model_validate(table([";".join(row) for row in turned], "Angle;GAP"))
    np.testing.assert_allclose(casing_spec("own", entry).measured, there.measured, atol=1e-12)


def test_a_table_that_is_none_or_goes_through_the_layer_is_refused_and_an_edited_one_another_run(
    config, table
):
    values = config.plain()
    for rows, said in (
        (ROWS[:5], "5 angles"),
        (ROWS[:60], "no angle for 65 degrees after 295"),
        ([*ROWS, "380,0.3"], "380"),
        ([*ROWS[:3], ROWS[1], *ROWS[4:]], "line 6"),
        ([*ROWS[:3], "15,wide", *ROWS[4:]], "line 6"),
        ([row.split(",")[0] + ",0.1" for row in ROWS], "same gap"),
    ):
        values["casings"]["own"] = table(rows)
        with pytest.raises(ConfigError) as error:
            validate(values)
        assert "casings.own.table.file = " in str(error.value)
        assert said in str(error.value)
    specs = []
    for rows in (ROWS, ROWS, [*ROWS[:-1], "355,-0.1999"]):
        values["casings"]["own"] = table(rows)
        specs.append(run_spec(validate(values), CoatingCase("own", 1.1, 0.5, 0.0), 0.2))
    assert specs[0] == specs[1] != specs[2]
    values["casings"]["own"] = table([f"{a},{40 * g!r}" for a, g in zip(ANGLE, GAP.tolist(), strict=True)])
    with pytest.raises(ConfigError, match="layer_thickness"):
        validate(values)


@pytest.mark.parametrize(("beside", "clearance"), [(False, 0.0), (True, 1.5e-4)])
def test_a_gap_above_zero_touches_by_an_interference(config, table, beside, clearance):
    rows = [f"{a},{0.4 - 0.02 * np.cos(np.deg2rad(2 * a)):.4f}" for a in ANGLE]
    depth, values = clearance * config.blade.length + 2e-5, config.plain()
    values["contact"]["clearance"] = {"leading_edge": clearance, "trailing_edge": clearance}
    coating = {"casing": "measured", "E": [2], "K": [0.5], "theta": [0.0]}
    entry = table(rows)
    values["casings"]["measured"], values["coatings"] = entry, [coating]
    with pytest.raises(ConfigError, match=r"never touches; give an interference"):
        validate(values)
    if beside:
        entry["interference"] = depth
    else:
        coating["interference"] = [depth]
    (case,) = coating_cases(study := validate(values))
    assert run_spec(study, case, 0.2).casing.interference == pytest.approx(depth)
    (entry if beside else coating)["interference"] = 1e-3 if beside else [1e-3]
    with pytest.raises(ConfigError, match="touches all around"):
        validate(values)
