"""One run by the workflow, the command line and the Python interface, with any number of threads of BLAS."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from bladerub.study.cache import blade_digest
from bladerub.study.store import read_run

RUN = "runs/2nd_E2_K0.5_theta0.15/0.1970.h5"
OPTIONS = "run --casing 2nd --E 2 --K 0.5 --theta 0.15 --f 0.197 --config overlay.yaml"
PROGRAM = """
import sys
import bladerub as br
study = br.load_study("overlay.yaml")
study.results.joinpath("blade").rename(study.results / "hidden")  # so that it is built here
blade = br.build_blade(study)
run = br.simulate(blade, study.run("2nd", E=2, K=0.5, theta=0.15, f_omega=0.197))
run.write(sys.argv[1], study.config)
print(blade.path)
"""


@pytest.fixture(
    params=["2", pytest.param("1", marks=pytest.mark.nightly), pytest.param("", marks=pytest.mark.nightly)]
)
def environment(request, tmp_path, copied_study):
    limits = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), request.param)
    given = {name: value for name, value in os.environ.items() if name not in limits}
    given |= {"PYTHONPATH": str(copied_study.sources), "BLADERUB_CACHE": str(tmp_path / "cache")}
    return given | (limits if request.param else {})


def test_a_run_is_the_same_wherever_it_is_asked_for(copied_study, environment, tmp_path):
    def call(*command: str | Path) -> str:
        done = subprocess.run(
            command, cwd=copied_study.folder, env=environment, capture_output=True, text=True, check=True
        )
        return done.stdout.strip()

    of_workflow = read_run(copied_study.results / RUN)
    by_command, by_interface = tmp_path / "command.h5", tmp_path / "interface.h5"
    call(Path(sys.executable).with_name("bladerub"), *OPTIONS.split(), "--output", str(by_command))
    blade = call(sys.executable, "-c", PROGRAM, str(by_interface))
    built = copied_study.results / "hidden" / "reduced_model.h5"
    assert blade_digest(blade) == blade_digest(built)
    for path in (by_command, by_interface):
        run = read_run(path)
        for name, values in of_workflow.data.items():
            assert np.array_equal(run.data[name], values, equal_nan=True), (path.name, name)
