"""The key of a run changes with everything that determines its file, and with nothing else."""

import dataclasses
import math

import pytest
from study_fixtures import changed

from bladerub.io import provenance
from bladerub.study import grid, plan
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.growth import confirmation_spec
from bladerub.study.plan import coating_plan, growth_key, longer_run, planned_run


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
