import numpy as np
import pytest

import bladerub as br
from bladerub.api import map as maps
from bladerub.extras.gpu import emulation, server, solver
from bladerub.extras.rows.spec import Row
from bladerub.study.plan import planned_run

pytestmark = pytest.mark.skipif(not emulation.is_possible(), reason="no C++ compiler")


@pytest.fixture
def gpu(monkeypatch):
    """Stand in for the GPU; lists how many runs it was given at once."""
    given = []

    def device(works):
        for work in works:
            given.append(len(work.runs))
            yield from emulation.run([work])

    monkeypatch.setattr(server, "find", lambda: device)
    return given


@pytest.fixture
def on_gpu(tmp_path):
    """A study whose blade is coarse."""
    mesh = "blade: {mesh: {chordwise: 7, thickness: 1, spanwise: 6}}\nreduction: {accuracy_speeds: 3}\n"
    path = tmp_path / "gpu.yaml"
    path.write_text(f"{mesh}results: results_of_no_workflow\nsolver: {{device: gpu}}\n")
    return br.load_study(path)


def test_its_sources_are_part_of_the_key_of_a_run(on_gpu, monkeypatch):
    config, spec = on_gpu.config, on_gpu.run("2nd", E=2, K=0.5, f_omega=0.19).spec

    def key(row=None):
        return planned_run(config, spec, "0.1900.h5", False, row).key("blade")

    of_gpu, of_row = key(), key(Row.even(2))
    monkeypatch.setattr(solver, "gpu_digest", lambda: "other")
    assert key() != of_gpu
    config["solver"]["device"] = "cpu"
    assert key() != of_gpu
    assert key(Row.even(2)) == of_row  # which the processor computes in any case


def test_speeds_are_computed_together(gpu, on_gpu):
    blade, coating = br.build_blade(on_gpu), on_gpu.coating("2nd", E=2, K=0.5)
    runs_ = [coating.at(f, revolutions=3) for f in (0.19, 0.2)]
    found = maps.solve_all(blade, runs_, jobs=2, follow=False, progress=False)
    assert gpu == [2]
    assert [each.f_omega for each in found] == [0.19, 0.2]
    alone = br.simulate(blade, runs_[1], follow=False)
    np.testing.assert_array_equal(found[1].wear, alone.wear)
