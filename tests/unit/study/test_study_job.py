import threading
import time

import h5py
import pytest
from study_fixtures import changed

from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.study import divergence, maps
from bladerub.study.job import compute_missing
from bladerub.study.manifest import write_manifest
from bladerub.study.plan import coating_plan
from bladerub.study.solver import each_done
from bladerub.study.store import read_run


def test_all_runs_are_computed_once(compute, simulated, tmp_path):
    rows = compute()
    assert simulated == [0.1, 0.19, 0.2, 0.3]
    assert [row.file for row in rows] == ["0.1000.h5", "0.1900.h5", "0.2000.h5", "0.3000.h5"]
    assert [row.status for row in rows] == ["completed"] * 3 + ["unbounded"]
    assert all(read_run(tmp_path / row.file).attributes["run_key"] == row.run_key for row in rows)
    assert compute() == rows
    assert len(simulated) == 4


def test_missing_damaged_and_new_runs_are_computed_and_no_others(compute, study, simulated, tmp_path):
    """A run of which a bit changed gets no checksum as it is, with or without a manifest."""
    rows, damaged = compute(), tmp_path / "0.2000.h5"
    write_manifest(tmp_path / "manifest.tsv", rows)
    with h5py.File(damaged) as file:
        start = file["energy_wear"].id.get_offset()  # neither packed nor with a checksum of HDF5
    content = bytearray(damaged.read_bytes())
    content[start] ^= 1
    damaged.write_bytes(content)
    with pytest.raises(DamagedFile, match=r"0\.2000\.h5: not as it was written"):
        read_run(damaged)
    (tmp_path / "0.1000.h5").unlink()
    (tmp_path / "0.3000.h5").write_bytes((tmp_path / "0.3000.h5").read_bytes()[:3000])
    (tmp_path / "manifest.tsv").unlink()
    simulated.clear()
    assert compute() == rows
    assert simulated == [0.1, 0.2, 0.3]
    compute(study=changed(study, speeds={"extra": [0.19, 0.25]}))
    assert simulated == [0.1, 0.2, 0.3, 0.25]


def test_a_run_without_a_checksum_is_computed_again_and_archived(compute, simulated, tmp_path):
    rows, path = compute(), tmp_path / "0.2000.h5"
    with h5py.File(path, "r+") as file:  # as older versions wrote it
        del file.attrs[hdf5.CHECKSUM]
    path.write_bytes(path.read_bytes().replace(b"file checksum, sha256=", bytes(22)))
    older = path.read_bytes()
    simulated.clear()
    assert compute() == rows
    assert simulated == [0.2]
    (archived,) = (tmp_path / ".archive").iterdir()
    assert archived.read_bytes() == older


def test_an_interrupted_job_goes_on_where_it_stopped(compute, simulated):
    def stop_after_two(done):
        if done.number == 2:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        compute(report=stop_after_two)
    simulated.clear()
    compute()
    assert simulated == [0.2, 0.3]


def test_runs_that_grow_are_repeated_for_longer_once(compute, simulated, growing, repeated, tmp_path):
    growing.update({0.1: 0.03, 0.2: 0.02, 0.19: 0.001, 0.3: 0.5})
    reports = []
    rows = compute(report=reports.append)
    assert repeated == [0.1, 0.2]  # 0.3 is unbounded
    assert [bool(row.confirmation_key) for row in rows] == [True, False, True, False]
    assert [(done.number, done.total) for done in reports] == [(1, 4), (2, 5), (3, 5), (4, 5), (5, 6), (6, 6)]
    assert [done.seconds_left > 1e-9 for done in reports] == [True, True, True, True, True, False]
    longer = read_run(tmp_path / "confirmation" / "0.2000.h5")
    assert longer.attributes["run_key"] == rows[2].confirmation_key != rows[2].run_key
    assert longer.data["revolution_amplitude"].shape == (60,)
    listed = [file for row in rows for file in row.files(tmp_path)]
    assert sorted(file.path for file in listed) == sorted(tmp_path.rglob("*.h5"))
    assert not any(file.is_damaged() for file in listed)
    assert compute() == rows
    assert (len(simulated), len(repeated)) == (4, 2)


def test_another_length_of_confirmation_repeats_only_what_grows(compute, study, simulated, growing, repeated):
    growing[0.2] = 0.03
    before = compute()
    rows = compute(study=study.replaced("analysis.divergence.confirmation_revolutions", 40))
    assert (len(simulated), repeated) == (4, [0.2, 0.2])
    assert [row.run_key for row in rows] == [row.run_key for row in before]
    assert compute() == before  # from the archive
    alone = study.replaced("analysis.divergence.confirmation_revolutions", 0)
    assert not any(row.confirmation_key for row in compute(study=alone))
    assert (len(simulated), len(repeated)) == (4, 2)


@pytest.fixture
def quick(study, case):
    study = changed(
        study.replaced("speeds.extra", []),
        contact={"elements": 200},
        solver={"revolutions": 3, "steps_per_element": 20, "max_time_step": 2e-5},
        analysis={"spectrum_revolutions": 2, "divergence": {"revolutions": 3, "confirmation_revolutions": 6}},
    ).replaced("analysis.divergence.growth", -1.0)
    return study, coating_plan(study, case)


def test_runs_computed_at_once_are_the_same_to_the_byte(quick, blade, tmp_path):
    one, three = (compute_missing(*quick, blade, tmp_path / str(n), "digest", threads=n) for n in (1, 3))
    assert one == three
    assert any(row.confirmation_checksum for row in one)


def test_real_runs_go_from_the_solver_to_the_table(quick, case, blade, tmp_path):
    study, plan = quick
    folder = tmp_path / "runs"
    rows = compute_missing(study, plan, blade, folder, "digest")
    coating = maps.collect_listed(study, case, blade, folder, rows)
    table = divergence.table(study, [coating])
    assert list(table.f_omega) == [0.1, 0.2, 0.3]
    assert set(table.status) == {"completed"}
    assert (coating.max_wear > 0).all()
    assert list(coating.lobes) == [2, 2, 2]  # stiff and heavy, it cuts the two lobes of the casing


def test_one_thread_is_the_caller_s_and_computes_on_demand():
    began = []
    done = each_done(lambda item: began.append((item, threading.current_thread())), [1, 2, 3], 1)
    next(done)
    assert began == [(1, threading.current_thread())]


def test_as_many_are_computed_at_once_as_there_are_threads():
    together = threading.Barrier(3, timeout=10)
    assert len(list(each_done(lambda item: together.wait(), range(6), 3))) == 6


@pytest.mark.parametrize("threads", [1, 2])
def test_after_an_error_none_is_begun(threads):
    began = []

    def compute(item):
        began.append(item)
        if item == 1:
            raise ValueError("first")
        time.sleep(0.2)

    with pytest.raises(ValueError, match="first"):
        list(each_done(compute, range(1, 30), threads))
    assert len(began) <= 1 + 2 * (threads - 1)
