import pytest
import yaml

from bladerub.config.errors import UNKNOWN, ConfigError
from bladerub.config.files import Located
from bladerub.config.read import read, read_with_notes
from bladerub.io.folders import ROOT
from bladerub.study.grid import coating_cases, keeps_history, listed_case, speeds
from bladerub.study.paper import HISTORIES, ORDERS
from bladerub.study.peaks import peak_orders, peak_settings

STUDY = ROOT / "config" / "config.yaml"
OTHER_COATING = {"coatings": [{"casing": "2nd", "E": [3], "K": [0.5], "theta": [0.0]}]}
ROUND = {"weights": [1.0], "amplitude": 1e-3, "interference": 5e-4, "start_angle": 100.0}


def on_casing(**casing):
    entry = {"casing": "own", "E": [2], "K": [0.5], "theta": [0.0]}
    return {"casings": {"own": ROUND | casing}, "coatings": [entry]}


@pytest.fixture
def laid_over(tmp_path):
    def read_over(content, **command_line):
        path = tmp_path / "my.yaml"
        path.write_text(yaml.safe_dump(content))
        return read_with_notes(STUDY, path, command_line=command_line)

    return read_over


@pytest.mark.parametrize(
    ("content", "left_out", "kept"),
    [(OTHER_COATING, 6, []), ({"speeds": {"extra": []}}, 2, [0.19, 0.206])],  # without 0.197
)
def test_histories_of_replaced_coatings_are_left_out_with_one_note(laid_over, content, left_out, kept):
    config, (note,) = laid_over(content)
    assert note.startswith(f"analysis.histories: {left_out} left out")
    cases = coating_cases(config)
    assert [f for f in speeds(config) if any(keeps_history(config, case, f) for case in cases)] == kept


def test_a_history_that_the_file_itself_lists_is_still_an_error(laid_over):
    lost = {"casing": "2nd", "E": 7, "K": 0.5, "theta": 0.0, "f_omega": 0.19}
    content = OTHER_COATING | {"analysis": {"histories": [lost]}}
    with pytest.raises(ConfigError, match=r"my.yaml:\d+: analysis.histories\[0\] = 2nd_E7_K0.5_theta0"):
        laid_over(content, results="elsewhere")


@pytest.mark.parametrize(
    "content",
    [
        OTHER_COATING,
        on_casing(nodal_diameters=[3]),
        on_casing(nodal_diameters=[3]) | {"contact": {"scale": {"length": 0.5, "modulus": 1.0, "time": 1.0}}},
        on_casing(nodal_diameters=[3]) | {"analysis": {"peaks": {"orders": [5]}}},
        on_casing(nodal_diameters=[2]) | {"speeds": {"stop": 0.2, "extra": []}},
    ],
)
def test_a_text_means_the_same_in_the_file_of_the_study_and_laid_over_it(laid_over, tmp_path, content):
    whole = tmp_path / "config.yaml"
    study = Located.of(yaml.safe_load(STUDY.read_text(encoding="utf-8")), UNKNOWN)
    whole.write_text(yaml.safe_dump(study.merged(Located.of(content, UNKNOWN)).plain()))
    assert read_with_notes(whole) == laid_over(content)


def test_the_orders_and_histories_of_the_paper_are_those_of_the_study():
    analysis = read(STUDY).analysis
    assert analysis.peaks.orders == list(ORDERS)
    assert {(listed_case(entry), entry.f_omega) for entry in analysis.histories} == HISTORIES


@pytest.mark.parametrize(
    ("diameters", "weights", "start", "orders"),
    [
        ([3], [1], 0.02, [6, 9]),
        ([3, 5], [1, 1], 0.02, [5, 6]),
        ([2, 5], [0, 1], 0.02, [5, 10]),
        ([2], [1], 0.2, [4]),  # 6 times 0.2 is above C1
        ([2, 5], [1, 1], 0.02, None),
    ],
)
def test_a_casing_that_does_not_excite_4_and_6_has_orders_of_its_own(
    laid_over, diameters, weights, start, orders
):
    content = on_casing(nodal_diameters=diameters, weights=weights)
    config, notes = laid_over(content | {"speeds": {"start": start, "stop": 0.4, "step": 0.01, "extra": []}})
    assert peak_orders(config, "own") == peak_settings(config, "own").orders == (orders or [4, 6])
    assert len(notes) == (2 if orders else 1)  # the first is of the histories


def test_orders_that_a_file_gives_are_kept_and_doubted(laid_over):
    content = on_casing(nodal_diameters=[3])
    config, notes = laid_over(content | {"analysis": {"peaks": {"orders": [4, 10]}}})
    assert peak_orders(config, "own") == [4, 10]
    assert "casing own" in notes[1]
    content["casings"]["own"]["peak_orders"] = [3, 6, 12]
    content["speeds"] = {"stop": 0.35}
    config, notes = laid_over(content)
    assert peak_orders(config, "own") == [3, 6, 12]
    assert len(notes) == 1


@pytest.mark.parametrize(("diameters", "widest"), [([2], 90), ([3], 60)])
def test_a_blade_that_starts_inside_the_coating_is_doubted(laid_over, diameters, widest):
    _, notes = laid_over(on_casing(nodal_diameters=diameters, start_angle=0.0))
    (note,) = [note for note in notes if note.startswith("casings.own.start_angle = 0: ")]
    assert "0.47 mm" in note  # 0.5 less the clearance
    assert note.endswith(f"at {widest} degrees")
