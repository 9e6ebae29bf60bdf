"""Runs with other limits of the iterations, and on processors with shorter vectors."""

import os
import pickle
import platform
import subprocess
import sys

import numpy as np
import pytest

from bladerub.contact.run import simulate

CHILD = """
import pickle, sys
from bladerub.contact.kernel import gauss_seidel, newton
if sys.argv[3:]:  # before compilation
    newton.MAX_ITERATIONS, gauss_seidel.MAX_SWEEPS = map(int, sys.argv[3:])
from bladerub.contact.run import simulate
with open(sys.argv[1], "rb") as file:
    blade, spec = pickle.load(file)
with open(sys.argv[2], "wb") as file:
    pickle.dump(simulate(blade, spec), file)
"""
# "generic" has 128 bits, on x86-64 and on ARM, and no fused products and sums
PROCESSORS = ["generic", "haswell"] if platform.machine() == "x86_64" else ["generic"]


@pytest.fixture
def elsewhere(blade, tmp_path):
    """Simulate in a process that compiles anew, for other limits of iterations and sweeps or a processor."""

    def run(spec, *limits, **environment):
        (tmp_path / "input").write_bytes(pickle.dumps((blade, spec)))
        command = [sys.executable, "-c", CHILD, tmp_path / "input", tmp_path / "output", *map(str, limits)]
        environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)} | environment
        subprocess.run(command, env=environment, check=True)
        return pickle.loads((tmp_path / "output").read_bytes())

    return run


@pytest.fixture
def stiff(spec, change):
    """A coating so stiff, in steps so long, that condensed modes decide on the forces."""
    return change(spec, E=20.0, K=10.0, theta=0.1, revolutions=1, steps_per_element=6, max_time_step=2e-5)


def test_a_run_that_converges_counts_no_unconverged_step(blade, spec, stiff, change):
    for run in (spec, stiff):
        result = simulate(blade, run)
        assert result.n_contact_steps > 100
        assert result.n_fallback_steps < result.n_contact_steps
        assert result.n_unconverged_steps == 0
    result = simulate(blade, change(spec, E=np.inf, K=np.inf, theta=0.0))  # has no fallback
    assert result.n_contact_steps > 0
    assert (result.n_fallback_steps, result.n_unconverged_steps) == (0, 0)


@pytest.mark.slow
@pytest.mark.nightly
def test_without_newton_steps_every_step_near_the_casing_falls_back_and_converges(blade, stiff, elsewhere):
    whole, result = simulate(blade, stiff), elsewhere(stiff, 0, 200)
    assert result.n_fallback_steps >= result.n_contact_steps > 100
    assert result.n_unconverged_steps == 0
    np.testing.assert_allclose(result.wear, whole.wear, rtol=0, atol=1e-5 * whole.wear.max())


@pytest.mark.slow
def test_a_run_whose_iterations_fail_counts_its_unconverged_steps(stiff, elsewhere):
    result = elsewhere(stiff, 0, 1)
    assert 100 < result.n_unconverged_steps <= result.n_fallback_steps


@pytest.mark.slow
@pytest.mark.nightly
@pytest.mark.parametrize("processor", PROCESSORS)
def test_short_vectors_give_the_same_run(blade, spec, change, elsewhere, processor):
    spec = change(spec, E=2.0, K=0.5, theta=0.15, revolutions=2)
    narrow = elsewhere(spec, NUMBA_CPU_NAME=processor, NUMBA_CPU_FEATURES="")
    wide = simulate(blade, spec)
    assert wide.n_contact_steps == narrow.n_contact_steps > 1000
    for name in ("wear", "radial_displacement", "revolution_peak"):
        expected = getattr(wide, name)
        scale = np.abs(expected).max()
        np.testing.assert_allclose(getattr(narrow, name), expected, rtol=0, atol=1e-10 * scale)
