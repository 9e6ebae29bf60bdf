"""Coatings, speeds and runs of a study; a key changes with all that determines its file and nothing else."""

import dataclasses
import math

import pandas as pd
import pytest
from study_fixtures import changed

from bladerub.io import provenance, tables
from bladerub.study import divergence, grid, peaks, plan
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.growth import confirmation_spec
from bladerub.study.plan import coating_plan, growth_key, longer_run, planned_run
from bladerub.study.variants import of_case, plain

PLAIN = CoatingCase("2nd", 2.0, 0.5, 0.0)
OWN = {"damping_ratio": 1e-3, "layer_thickness": 4e-3, "interference": 4e-4}
VARIANT = PLAIN.with_own(**OWN)


def test_the_papers_coatings_a_softer_one_and_the_rigid_casing_have_names_that_lead_back_to_them(config):
    cases = grid.coating_cases(config)
    assert len(cases) == 1 + (1 + 9) * 6 + 1 + 1
    assert cases[0].name == "2nd5nd_E11_K0.5_theta0"
    assert cases[-2].name == "2nd_E2_K0.5_theta0.15"
    assert cases[-1].name == "2nd_rigid_mu0"
    assert CoatingCase("2nd", 0.11, 0.05, 0.0).name == "2nd_E0.11_K0.05_theta0"
    assert all(grid.case_from_name(config, case.name) == case for case in cases)


def test_a_coating_listed_twice_is_named(config):
    entry = {"casing": "2nd", "E": [2.0], "K": [0.5], "theta": [0.15]}
    coatings = [*config.plain()["coatings"], entry]
    with pytest.raises(ValueError, match=r"coatings\[4\]: 2nd_E2_K0.5_theta0.15: must be listed once"):
        grid.coating_cases(changed(config, coatings=coatings))
    entry |= {"E": list(range(3, 73)), "K": list(range(71))}
    with pytest.raises(ValueError, match=r"coatings\[4\]: .* to 5033, .* must be 5000 or fewer"):
        grid.coating_cases(changed(config, coatings=coatings))


@pytest.mark.parametrize(("friction", "name"), [(0, "2nd_rigid_mu0"), (0.15, "2nd_rigid_mu0.15")])
def test_the_rigid_casing_is_a_coating_without_give_at_its_angle_of_friction(config, friction, name):
    config = changed(config, coatings=[{"casing": "2nd", "coating": "rigid", "friction": [0.5, friction]}])
    case = grid.case_from_name(config, name)
    assert case.is_rigid
    assert case.friction == pytest.approx(friction)
    coating = grid.run_spec(config, case, 0.19).coating
    assert coating.is_rigid
    assert (coating.E, coating.K, coating.theta) == (math.inf, math.inf, math.atan(friction))


def test_speeds_are_sorted_unique_and_include_both_ends_and_the_extra_ones(config):
    of_paper = {"start": 0.02, "stop": 0.4, "step": 0.002, "extra": [0.197, 0.19]}
    speeds = grid.speeds(changed(config, speeds=of_paper))
    assert len(speeds) == 192  # 191 of the grid, and 0.197; 0.19 is on the grid
    assert speeds == sorted({*speeds, 0.02, 0.197, 0.4})
    coarse = {"start": 0.02, "stop": 0.32, "step": 0.1, "extra": []}
    assert (0.32 - 0.02) / 0.1 < 3  # rounding loses no speed at the stop
    assert grid.speeds(changed(config, speeds=coarse)) == [0.02, 0.12, 0.22, 0.32]


def test_run_spec_is_in_si(config, case):
    spec = grid.run_spec(config, case, 0.19)
    assert spec.clearance == pytest.approx((1.5e-4 * 0.2, 4.3e-4 * 0.2))
    assert spec.displacement_limit == pytest.approx(config.solver.displacement_limit * 0.2)
    assert spec.casing.start_angle == pytest.approx(math.radians(config.casings["2nd"].start_angle))
    assert (spec.coating.E, spec.coating.K, spec.coating.theta) == (2.0, 0.5, 0.15)


@pytest.mark.extras
def test_the_scale_of_another_blade_multiplies_lengths_moduli_and_times(config, case):
    config = changed(config, solver={"max_time_step": 1e-6})
    before = pd.json_normalize(dataclasses.asdict(grid.run_spec(config, case, 0.19))).iloc[0]
    config = changed(config, contact={"scale": {"length": 3.0, "modulus": 5.0, "time": 7.0}})
    after = pd.json_normalize(dataclasses.asdict(grid.run_spec(config, case, 0.19))).iloc[0]
    lengths = ("casing.amplitude", "casing.interference", "coating.thickness", "tip.edge_drop")
    factors = dict.fromkeys(lengths, 3.0) | {"coating.modulus_unit": 5.0, "max_time_step": 7.0}
    for name, value in before.items():
        assert after[name] == (factors[name] * value if name in factors else value), name


def test_friction_instead_of_theta_is_coulombs_law_at_its_angle(config):
    config = changed(config, coatings=[{"casing": "2nd", "E": [2], "K": [0.5], "friction": [0.15]}])
    (case,) = grid.coating_cases(config)
    assert case.name == "2nd_E2_K0.5_mu0.15"
    assert case == grid.case_from_name(config, case.name)
    assert case != grid.CoatingCase("2nd", 2.0, 0.5, case.theta)
    coating = grid.run_spec(config, case, 0.19).coating
    assert (coating.law, coating.theta) == ("coulomb", math.atan(0.15))
    assert grid.CoatingCase.described(dataclasses.asdict(case)) == case


def test_lists_of_an_entry_stand_for_all_combinations(config):
    entry = {"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.0]}
    variants = entry | {"damping_ratio": [1e-3, 2e-3], "interference": [3e-4, 4e-4]}
    run = {"casing": "2nd", "E": 2, "K": 0.5, "theta": 0, "damping_ratio": 1e-3, "interference": 3e-4}
    config = changed(config, coatings=[entry, variants], analysis={"histories": [run | {"f_omega": 0.19}]})
    cases = grid.coating_cases(config)
    assert cases[0] == PLAIN
    assert [case.variant for case in cases[1:]] == [f"xi0.00{x}_d0.000{d}" for x in (1, 2) for d in (3, 4)]
    assert grid.case_from_name(config, cases[2].name) == cases[2]
    assert [grid.keeps_history(config, case, 0.19) for case in cases] == [False, True, False, False, False]


@pytest.mark.extras
def test_a_variant_changes_its_own_runs_alone(config):
    config = changed(config, contact={"scale": {"length": 2.0, "modulus": 1.0, "time": 1.0}})
    before, after = (grid.run_spec(config, case, 0.19) for case in (PLAIN, VARIANT))
    assert (after.damping_ratio, after.coating.thickness, after.casing.interference) == (1e-3, 8e-3, 8e-4)
    parts = [pd.json_normalize(dataclasses.asdict(spec)).iloc[0].to_dict() for spec in (before, after)]
    different = {name for name, value in parts[0].items() if parts[1][name] != value}
    assert different == {"damping_ratio", "coating.thickness", "casing.interference"}
    keys = [coating_plan(config, case).runs[0].key("blade") for case in (PLAIN, VARIANT)]
    assert keys[0] != keys[1]


def test_tables_tell_variants_from_the_plain_coating(config, make_map, tmp_path):
    maps = [
        make_map(case, {4: (0.3, 1e-4), 6: (0.2, height)})
        for case, height in ((PLAIN, 2e-4), (VARIANT, 6e-4))
    ]
    for table in (peaks.table, divergence.table):
        assert "variant" not in table(config, maps[:1])
        tables.write(tmp_path / "table.csv", table(config, maps), {})
        read = tables.read(tmp_path / "table.csv")
        assert read.columns[-1] == "variant"
        for case in (PLAIN, VARIANT):
            rows = of_case(read, case)
            assert len(rows) == len(read) / 2
            assert set(rows.variant.fillna("")) == {case.variant}
        pd.testing.assert_frame_equal(plain(read), plain(table(config, maps[:1])), check_dtype=False)
    found = {"peaks": peaks.table(config, maps), "divergence": divergence.table(config, maps)}
    evidence = Evidence(config, found | {"rom_accuracy": None}, maps)
    assert evidence.peak(PLAIN, 6, "amplitude") == pytest.approx(2e-4)  # judged without variants


@pytest.fixture
def key(config, spec):
    def make(spec=spec, blade="blade", history=False, config=config):
        return planned_run(config, spec, "0.1900.h5", history).key(blade)

    return make


def _leaves(value, path=()):
    if dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            yield from _leaves(getattr(value, field.name), (*path, field.name))
    else:
        yield path, value


def _replaced(value, path, leaf):
    if not path:
        return leaf
    return dataclasses.replace(value, **{path[0]: _replaced(getattr(value, path[0]), path[1:], leaf)})


def _other(leaf):
    if isinstance(leaf, str):
        return leaf + "x"
    if isinstance(leaf, tuple):
        return (*leaf[:-1], _other(leaf[-1])) if leaf else ((0.0, 1.0),)
    return leaf + 1 if isinstance(leaf, int) else math.nextafter(leaf, 0.0 if leaf == math.inf else math.inf)


@pytest.mark.extras
def test_every_field_of_the_run_changes_the_key(key, spec):
    leaves = list(_leaves(spec))
    assert len(leaves) == 32
    assert len({key(), *(key(_replaced(spec, path, _other(leaf))) for path, leaf in leaves)}) == 33


def test_what_else_shapes_the_file_changes_the_key(key, config, monkeypatch):
    keys = [key(), key(blade="other"), key(history=True)]
    cases = CoatingCase.rigid("2nd", 0.0), CoatingCase("2nd", 1e6, 1e6, 0.0)
    keys += [key(run_spec(config, case, 0.19)) for case in cases]
    for setting in ("spectrum_revolutions", "max_order"):
        path, value = f"analysis.{setting}", getattr(config.analysis, setting)
        keys.append(key(config=config.replaced(path, value + 1)))
    for digest in ("solver_digest", "storage_digest"):
        monkeypatch.setattr(plan, digest, lambda: "other")
        keys.append(key())
    assert len(set(keys)) == 9


@pytest.mark.extras
def test_the_code_of_a_motion_is_part_of_the_key_of_runs_that_have_it_alone(key, spec, monkeypatch):
    turning = dataclasses.replace(spec, tip=dataclasses.replace(spec.tip, turns=True))
    before = key(), key(turning)
    monkeypatch.setattr("bladerub.contact.laws.digest_behind", lambda *modules: "other")
    assert (key(), key(turning) != before[1]) == (before[0], True)


def test_settings_of_maps_and_tables_the_folder_and_the_commit_leave_the_key(key, config, monkeypatch):
    before = key()
    divergence = {"growth": 0.5, "confirmation_revolutions": 100}
    analysis = {"lobe_prominence": 0.9, "peaks": {"orders": [2]}, "divergence": divergence, "histories": []}
    config = changed(config, analysis=analysis, results="elsewhere")
    monkeypatch.setattr(provenance, "git_state", lambda: ("another", "modified"))
    assert key(config=config) == before


def test_a_finer_grid_or_other_coatings_leave_the_keys(config, case):
    runs = coating_plan(config, case).runs
    assert [run.file for run in runs if run.keep_history] == ["0.1900.h5", "0.1970.h5", "0.2060.h5"]
    before = {run.file: run.key("blade") for run in runs}
    coatings = [{"casing": case.casing, "E": [2, 3], "K": [0.5], "theta": [0.15]}]
    config = changed(config, speeds={"step": config.speeds.step / 2}, coatings=coatings)
    assert case in grid.coating_cases(config)
    after = {run.file: run.key("blade") for run in coating_plan(config, case).runs}
    assert before.items() < after.items()


def test_the_longer_run_is_the_same_run_for_longer(config, spec):
    settings = config.analysis.divergence
    assert confirmation_spec(spec, settings).revolutions == 60
    run = planned_run(config, spec, "0.1900.h5", keep_history=True)
    longer = longer_run(config, run)
    assert (longer.file, longer.n_blades) == ("confirmation/0.1900.h5", 1)
    assert (longer.spec, longer.keep_history) == (confirmation_spec(spec, settings), False)
    assert longer.key("blade") != run.key("blade")


def test_every_setting_decides_which_runs_are_repeated_and_none_where_none_is(config):
    before = growth_key(config)
    for name, value in config.analysis.divergence.plain().items():
        assert growth_key(config.replaced(f"analysis.divergence.{name}", 2 * value)) != before
    off = config.replaced("analysis.divergence.confirmation_revolutions", 0)
    assert growth_key(off) == growth_key(off.replaced("analysis.divergence.growth", 0.5))
