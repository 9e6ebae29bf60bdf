"""Runs on a GPU by the real workflow; the GPU is emulated."""

import subprocess
import sys
from importlib.util import find_spec

import numpy as np
import pytest

from bladerub.extras.gpu import ADDRESS, emulation
from bladerub.study.manifest import read_manifest
from bladerub.study.store import read_run

COATING, RIGID = "2nd_E2_K0.5_theta0.15", "2nd_rigid_mu0"
TARGETS = [f"results/runs/{name}/manifest.tsv" for name in (COATING, RIGID)]


@pytest.fixture
def few(tiny):
    """A coating and the rigid casing at three speeds, of which one grows."""
    tiny["speeds"] = {"start": 0.19, "stop": 0.31, "step": 0.06, "extra": []}
    tiny["coatings"] = tiny["coatings"][2:]
    tiny["analysis"]["histories"] = []
    tiny["solver"]["device"] = "gpu"
    return tiny


@pytest.fixture
def gpu(tmp_path, monkeypatch):
    """Start the process that has the GPU, which is emulated."""
    folder = tmp_path / "gpu"
    folder.mkdir()
    command = [sys.executable, "-m", "bladerub.extras.gpu.server", folder / "socket", "--emulated"]
    with subprocess.Popen(command, stdin=subprocess.PIPE) as server:
        while not (folder / "socket").exists():
            assert server.poll() is None
        monkeypatch.setenv(ADDRESS, str(folder / "socket"))
        yield folder
        server.stdin.close()
        assert server.wait(30) == 0
    assert not folder.exists()


@pytest.mark.nightly
@pytest.mark.skipif(not emulation.is_possible(), reason="no C++ compiler")
def test_the_runs_are_those_of_the_processor(copied_study, few, gpu):
    def runs():
        folder = copied_study.results / "runs" / COATING
        names = [row.file for row in read_manifest(folder / "manifest.tsv")]
        return {name: read_run(folder / name) for name in names}

    copied_study.build(few, *TARGETS)
    log = (copied_study.results / "logs" / "coating" / f"{RIGID}.log").read_text()
    assert "3 of 3 runs on the CPU: contact with the rigid casing is solved node by node" in log
    on_gpu, files = runs(), copied_study.runs(f"{COATING}/[0-9]*.h5")
    few["solver"]["device"] = "cpu"
    copied_study.build(few, *TARGETS)
    on_cpu = runs()
    assert on_gpu.keys() == on_cpu.keys()
    for name, run in on_gpu.items():
        other = on_cpu[name]
        assert run.attributes["run_key"] != other.attributes["run_key"]
        assert run.attributes["n_steps"] == other.attributes["n_steps"]
        np.testing.assert_allclose(run.data["wear"], other.data["wear"], rtol=0, atol=1e-9)
        np.testing.assert_allclose(run.data["revolution_peak"], other.data["revolution_peak"], rtol=1e-7)
    few["solver"]["device"] = "gpu"
    copied_study.build(few, *TARGETS)
    assert copied_study.runs(f"{COATING}/[0-9]*.h5") == files  # out of the archive


@pytest.mark.skipif(find_spec("cupy") is not None, reason="CuPy is installed")
def test_without_a_gpu_nothing_is_begun(copied_study, few):
    before = copied_study.runs()
    said = copied_study.failure(TARGETS[0], "--cores", "1", config=few)
    assert "solver.device = gpu: needs CuPy" in said
    assert copied_study.runs() == before
