import errno
import os
from dataclasses import replace
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
from study_fixtures import changed

from bladerub.contact.result import Energy
from bladerub.extras.inventory import COUNTS, take
from bladerub.extras.verification.integrity import examine
from bladerub.io import hdf5
from bladerub.study.manifest import write_manifest
from bladerub.study.plan import coating_plan
from bladerub.study.store import read_run

NONE = {"done": 0, "missing": 0, "stale": 0, "corrupt": 0, "unbounded": 0}


@pytest.fixture
def done(simulated, growing, compute, tmp_path):
    """Four runs: one unbounded (at 0.3), one that grows (at 0.2) and has a longer one."""
    growing[0.2] = 0.05
    write_manifest(tmp_path / "manifest.tsv", compute())


@pytest.fixture
def look(study, case, tmp_path):
    return lambda study=study, **more: take(study, coating_plan(study, case), tmp_path, "blade", **more)


@pytest.fixture
def inventory(look):
    return lambda **options: look(**options)[0]


def counts(inventory):
    return {name: inventory[name] for name in NONE}


def test_what_is_missing_and_what_is_done_is_counted(inventory, request, tmp_path):
    assert inventory() == dict.fromkeys(COUNTS, 0) | {"planned": 4, "missing": 4}
    request.getfixturevalue("done")
    found = inventory()
    assert counts(found) == {**NONE, "done": 4, "unbounded": 1}
    assert (found["planned"], found["longer_planned"], found["longer_done"]) == (4, 1, 1)
    assert found["bytes"] == sum(path.stat().st_size for path in tmp_path.rglob("*.*") if path.is_file())
    assert inventory(known=[tmp_path / "0.1000.h5"]) == found | {"done": 3, "corrupt": 1, "unbalanced": 3}


def test_longer_runs_are_those_of_the_plan_not_of_the_manifest(done, inventory, study, tmp_path):
    for revolutions, expected in ((60, (1, 1)), (80, (1, 0)), (0, (0, 0))) * 2:
        of_length = study.replaced("analysis.divergence.confirmation_revolutions", revolutions)
        found = inventory(study=of_length)
        assert (found["longer_planned"], found["longer_done"]) == expected
        if revolutions == 0:
            (tmp_path / "manifest.tsv").unlink(missing_ok=True)


def test_a_changed_setting_makes_every_run_stale_and_a_speed_only_itself(done, inventory, study):
    study = changed(study, speeds={"extra": [0.19, 0.25]})
    assert counts(inventory(study=study)) == {**NONE, "done": 4, "missing": 1, "unbounded": 1}
    study = study.replaced("contact.damping_ratio", 1e-3)
    assert counts(inventory(study=study)) == {**NONE, "stale": 4, "missing": 1}


@pytest.mark.parametrize("listed", [True, False])
def test_damage_anywhere_in_a_file_ends_no_inventory_and_is_found(done, inventory, tmp_path, listed):
    if not listed:  # before the end of the job
        (tmp_path / "manifest.tsv").unlink()
    path = tmp_path / "0.1000.h5"
    whole = path.read_bytes()
    found = []
    for start in range(0, len(whole), len(whole) // 40):
        content = bytearray(whole)
        damaged = slice(start, start + 300)
        content[damaged] = bytes(255 - byte for byte in content[damaged])
        path.write_bytes(content)
        found.append(counts(inventory(known=examine(tmp_path).damaged))["corrupt"])
    assert set(found) <= {0, 1}
    assert sum(found) == len(found) if listed else sum(found) > 20
    if listed:
        assert inventory()["corrupt"] == 0  # what has its size is not opened


def test_runs_that_did_not_converge_or_are_out_of_balance_are_counted(
    solve_by, make_result, compute, inventory, tmp_path
):
    def doubtful(spec):
        steps, wear = {0.1: (3, 0.01), 0.2: (1, np.nan)}.get(spec.f_omega, (0, 0.0))
        entries = dict.fromkeys(Energy.__annotations__, 0.0) | {"wear": wear, "exchanged": 1.0}
        result = replace(make_result(spec.revolutions), energy=Energy(**entries))
        return replace(result, n_unconverged_steps=steps, n_fallback_steps=9)

    solve_by(doubtful)
    rows = compute()
    for _ in range(2):  # without and with the manifest
        found = inventory()
        assert (found["done"], found["unconverged"], found["unbalanced"]) == (4, 2, 2)
        write_manifest(tmp_path / "manifest.tsv", rows)
    attributes = read_run(tmp_path / "0.1000.h5").attributes
    assert (attributes["n_unconverged_steps"], attributes["n_fallback_steps"]) == (3, 9)


def test_what_the_system_refuses_to_read_is_not_damaged(
    done, look, compute, simulated, monkeypatch, tmp_path
):
    def opened(path, *arguments, **options):
        if str(path).endswith("0.1000.h5"):
            raise OSError(errno.EIO, os.strerror(errno.EIO))
        return whole(path, *arguments, **options)

    whole = h5py.File
    monkeypatch.setattr(hdf5, "h5py", SimpleNamespace(**vars(h5py) | {"File": opened}))
    (tmp_path / "manifest.tsv").unlink()  # or it is not opened
    taken = look()
    assert (taken.counts["unreadable"], taken.counts["corrupt"], taken.damaged) == (1, 0, [])
    assert "0.1000.h5" in taken.unreadable[0]
    simulated.clear()
    with pytest.raises(OSError, match=r"0\.1000\.h5"):
        compute()
    assert simulated == []
