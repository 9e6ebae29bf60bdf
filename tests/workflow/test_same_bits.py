"""One run by the workflow, the command line and the Python interface, with any number of threads of BLAS."""

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


@pytest.mark.parametrize("threads", ["2", *(pytest.param(n, marks=pytest.mark.nightly) for n in ("1", ""))])
def test_a_run_is_the_same_wherever_it_is_asked_for(copied_study, threads, tmp_path, monkeypatch):
    limits = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
    for name in limits:
        monkeypatch.delenv(name, raising=False)
    environment = {"BLADERUB_CACHE": str(tmp_path / "cache")}
    environment |= dict.fromkeys(limits, threads) if threads else {}

    of_workflow = read_run(copied_study.results / RUN)
    by_command, by_interface = tmp_path / "command.h5", tmp_path / "interface.h5"
    copied_study.said("bladerub", *OPTIONS.split(), "--output", by_command, **environment)
    blade = copied_study.said("python", "-c", PROGRAM, by_interface, **environment).strip()
    built = copied_study.results / "hidden" / "reduced_model.h5"
    assert blade_digest(blade) == blade_digest(built)
    for path in (by_command, by_interface):
        run = read_run(path)
        for name, values in of_workflow.data.items():
            assert np.array_equal(run.data[name], values, equal_nan=True), (path.name, name)
