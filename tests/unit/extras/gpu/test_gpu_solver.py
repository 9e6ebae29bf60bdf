import inspect
import threading
import time
from multiprocessing.connection import Listener
from unittest.mock import Mock

import numpy as np
import pytest
from stand_in import COARSE

import bladerub as br
from bladerub.cli import main
from bladerub.extras.gpu import emulation, server, solver
from bladerub.extras.gpu.batch import Output, Work
from bladerub.extras.gpu.device import NoGpuError
from bladerub.extras.many_runs import solve_all
from bladerub.extras.rows.spec import Row
from bladerub.study.plan import planned_run
from bladerub.study.solver import Solver


@pytest.fixture
def on_gpu(tmp_path):
    path = tmp_path / "gpu.yaml"
    path.write_text(f"{COARSE}results: results_of_no_workflow\nsolver: {{device: gpu}}\n")
    return br.load_study(path)


def test_without_one_no_blade_is_built(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("bladerub.extras.gpu.device.connect", Mock(side_effect=NoGpuError("no GPU")))
    monkeypatch.setattr("bladerub.cli.inputs.study_folder", lambda: tmp_path)
    assert main(["run", "--device", "gpu", "--casing", "2nd", "--E", "2", "--K", "0.5", "--f", "0.19"]) == 2
    assert capsys.readouterr().err == "bladerub run: no GPU\n"
    assert not list(tmp_path.iterdir())


def test_its_sources_are_part_of_the_key_of_a_run(on_gpu, monkeypatch):
    config, spec = on_gpu.config, on_gpu.run("2nd", E=2, K=0.5, f_omega=0.19).spec

    def key(row=None):
        return planned_run(config, spec, "0.1900.h5", False, row).key("blade")

    of_gpu, of_row = key(), key(Row.even(2))
    monkeypatch.setattr(solver, "gpu_digest", lambda: "other")
    assert key() != of_gpu
    config = config.replaced("solver.device", "cpu")
    assert key() != of_gpu
    assert key(Row.even(2)) == of_row  # which the processor computes in any case


def test_it_is_called_as_that_of_the_processor():
    own, other = (inspect.signature(kind.simulate_many).parameters for kind in (solver.Gpu, Solver))
    assert list(own) == list(other)  # the chart names some


@pytest.mark.skipif(not emulation.is_possible(), reason="no C++ compiler")
def test_speeds_are_computed_together(on_gpu, monkeypatch):
    given = []

    def device(works):
        for work in works:
            given.append(len(work.runs))
            yield from emulation.run([work])

    monkeypatch.setattr(server, "find", lambda: device)
    blade, coating = br.build_blade(on_gpu), on_gpu.coating("2nd", E=2, K=0.5)
    runs_ = [coating.at(f, revolutions=3) for f in (0.19, 0.2)]
    found = solve_all(blade, runs_, jobs=2, follow=False, progress=False)
    assert given == [2]
    assert [each.f_omega for each in found] == [0.19, 0.2]
    alone = br.simulate(blade, runs_[1], follow=False)
    np.testing.assert_array_equal(found[1].wear, alone.wear)


def work_of(number, n_runs=2, source="a"):
    runs, record = np.zeros((n_runs, 5), dtype=np.int32), np.full((1, 1), float(number))
    return Work(source, 1, 4, 1, *4 * [record], runs, np.full((n_runs, 2, 1), float(number)))


def left_of(work):
    return Output(work.modes, *(np.zeros((len(work.runs), 1)) for _ in range(6)))


@pytest.fixture
def serve(tmp_path, monkeypatch):
    opened = []

    def start(run):
        address = str(tmp_path / "socket")
        opened.append(Listener(address, "AF_UNIX"))
        threading.Thread(target=server.serve, args=(opened[0], run), daemon=True).start()
        monkeypatch.setenv(server.ADDRESS, address)

    yield start
    opened[0].close()


def test_what_is_asked_for_while_the_gpu_is_busy_is_computed_together(serve):
    begun, go_on, seen = threading.Event(), threading.Event(), []

    def run(works):
        together = list(works)
        seen.append(sorted((work.source, len(work.runs)) for work in together))
        begun.set()
        go_on.wait(30)
        return map(left_of, together)

    serve(run)
    answers = {}

    def ask(number, source):
        answers[number, source] = list(server.ask([work_of(number, source=source)]))

    callers = [threading.Thread(target=ask, args=(number, "ab"[number % 2])) for number in range(7)]
    callers[0].start()
    assert begun.wait(30)
    for each in callers[1:]:
        each.start()
    deadline = time.monotonic() + 30
    while threading.active_count() < 7 + 7 and time.monotonic() < deadline:  # a thread of the server for each
        threading.Event().wait(0.01)
    threading.Event().wait(0.2)  # their requests are read
    go_on.set()
    for each in callers:
        each.join(30)
    assert seen == [[("a", 2)], [("a", 2)] * 3 + [("b", 2)] * 3]
    for (number, _), (left,) in answers.items():
        assert np.all(left.modes == number)


def test_an_error_reaches_who_asked(serve):
    def run(works):
        for work in works:
            if work.source == "wrong":
                raise ValueError("no such thing")
            yield left_of(work)

    serve(run)
    with pytest.raises(ValueError, match="no such thing"):
        list(server.ask([work_of(1, source="wrong")]))
    works = [work_of(number, n_runs=number) for number in (1, 2, 3)]  # and the server goes on
    for work, left in zip(works, server.find()(works), strict=True):
        np.testing.assert_array_equal(left.modes, work.modes)
