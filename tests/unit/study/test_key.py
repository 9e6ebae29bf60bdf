import dataclasses
import math

import h5py
import numpy as np
import pytest

from bladerub.io import hdf5, provenance
from bladerub.io.hdf5 import Variable
from bladerub.study import grid, key
from bladerub.study.grid import CoatingCase


@pytest.fixture
def run_key(config, spec):
    def make(spec=spec, blade="blade", history=False, analysis=None):
        return key.run_key(spec, blade, history, analysis or config["analysis"])

    return make


def _leaves(value, path=()):
    """Every field of a nested dataclass, with the path that leads to it."""
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
        return (*leaf[:-1], _other(leaf[-1]))
    return leaf + 1 if isinstance(leaf, int) else math.nextafter(leaf, math.inf)


def test_the_key_is_stable(run_key, config, case):
    assert len(run_key()) == 64
    assert run_key() == run_key(grid.run_spec(config, case, 0.19))


def test_the_rigid_casing_has_a_key_of_its_own(run_key, config):
    rigid, stiff = CoatingCase.rigid("2nd", 0.0), CoatingCase("2nd", 1e6, 1e6, 0.0)
    keys = [run_key(grid.run_spec(config, case, 0.19)) for case in (rigid, rigid, stiff)]
    assert keys[0] == keys[1] != keys[2]


def test_every_field_of_the_run_changes_the_key(run_key, spec):
    keys = {run_key()}
    leaves = list(_leaves(spec))
    assert len(leaves) == 25
    for path, leaf in leaves:
        keys.add(run_key(_replaced(spec, path, _other(leaf))))
    assert len(keys) == 1 + len(leaves)


@pytest.mark.parametrize("setting", ["spectrum_revolutions", "max_order"])
def test_what_shapes_the_file_changes_the_key(run_key, config, setting):
    before = run_key()
    config["analysis"][setting] += 1
    assert run_key() != before


def test_blade_and_history_change_the_key(run_key):
    assert len({run_key(), run_key(blade="other"), run_key(history=True)}) == 3


def test_settings_of_maps_and_tables_leave_the_key(run_key, config):
    before = run_key()
    config["analysis"]["lobe_prominence"] = 0.9
    config["analysis"]["peaks"]["orders"] = [2]
    config["analysis"]["divergence"] = {"growth": 0.5, "confirmation_revolutions": 100}
    config["analysis"]["histories"] = []
    assert run_key() == before


def test_a_finer_grid_or_other_coatings_leave_the_key(run_key, config):
    case = CoatingCase("2nd", 1.1, 0.5, 0.0)
    before = run_key(grid.run_spec(config, case, 0.2))
    config["speeds"]["step"] = 0.001
    config["coatings"] = [{"casing": "2nd", "E": [1.1, 3], "K": [0.5], "theta": [0.0]}]
    assert 0.2 in grid.speeds(config)
    assert run_key(grid.run_spec(config, grid.coating_cases(config)[0], 0.2)) == before


@pytest.mark.parametrize("digest", ["solver_digest", "storage_digest"])
def test_another_source_of_solver_or_storage_is_another_run(monkeypatch, run_key, digest):
    before = run_key()
    monkeypatch.setattr(key, digest, lambda: "other")
    assert run_key() != before


def test_another_commit_is_the_same_run(monkeypatch, run_key):
    before = run_key()
    monkeypatch.setattr(provenance, "git_state", lambda: ("another", "modified"))
    assert run_key() == before


class TestBladeDigest:
    @pytest.fixture
    def path(self, tmp_path):
        def write(name, mass, **attributes):
            variables = {"mass": Variable(("row", "column"), mass, "kg", "mass")}
            hdf5.write(tmp_path / name, variables, {"f1_hz": 192.0, **attributes})
            return tmp_path / name

        return write

    def test_an_identical_rebuild_keeps_it(self, path):
        first = path("a.h5", np.eye(3))
        second = path("b.h5", np.eye(3))
        with h5py.File(second, "a") as file:  # other bytes, same content
            del file["mass"].attrs["long_name"]
            file["mass"].attrs["long_name"] = "mass matrix of the blade"
        assert first.read_bytes() != second.read_bytes()
        assert key.blade_digest(first) == key.blade_digest(second)

    def test_where_it_comes_from_is_no_content(self, path):
        eye = np.eye(3)
        here, there = (path(f"{commit}.h5", eye, provenance_git_commit=commit) for commit in "ab")
        assert key.blade_digest(here) == key.blade_digest(there) == key.blade_digest(path("c.h5", eye))

    def test_content_changes_it(self, path):
        other = np.eye(3)
        other[0, 0] = np.nextafter(1, 2)
        digests = {
            key.blade_digest(path("a.h5", np.eye(3))),
            key.blade_digest(path("b.h5", other)),
            key.blade_digest(path("c.h5", np.eye(3), eta=6)),
        }
        assert len(digests) == 3

    def test_a_missing_blade_is_an_error_with_its_name(self, tmp_path):
        with pytest.raises(OSError, match=r"none\.h5"):
            key.blade_digest(tmp_path / "none.h5")
