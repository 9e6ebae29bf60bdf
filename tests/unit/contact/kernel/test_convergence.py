import os
import pickle
import subprocess
import sys

import numpy as np
import pytest

from bladerub.contact.run import simulate

LIMITED = """
import pickle, sys
from bladerub.contact.kernel import gauss_seidel, newton
newton.MAX_ITERATIONS, gauss_seidel.MAX_SWEEPS = int(sys.argv[3]), int(sys.argv[4])  # before compilation
from bladerub.contact.run import simulate
with open(sys.argv[1], "rb") as file:
    blade, spec = pickle.load(file)
with open(sys.argv[2], "wb") as file:
    pickle.dump(simulate(blade, spec), file)
"""


@pytest.fixture
def stiff(spec, change):
    """A coating so stiff, in steps so long, that condensed modes decide on the forces."""
    return change(spec, E=20.0, K=10.0, theta=0.1, revolutions=1, steps_per_element=6, max_time_step=2e-5)


def limited(blade, spec, folder, iterations, sweeps):
    """Simulate with other limits of the iterations, in a process that compiles anew for them."""
    with open(folder / "input", "wb") as file:
        pickle.dump((blade, spec), file)
    arguments = [folder / "input", folder / "output", iterations, sweeps]
    command = [sys.executable, "-c", LIMITED, *map(str, arguments)]
    subprocess.run(command, env=os.environ | {"NUMBA_CACHE_DIR": str(folder)}, check=True)
    with open(folder / "output", "rb") as file:
        return pickle.load(file)


def test_a_run_that_converges_counts_no_unconverged_step(blade, spec, stiff):
    for run in (spec, stiff):
        result = simulate(blade, run)
        assert result.n_contact_steps > 100
        assert result.n_fallback_steps < result.n_contact_steps
        assert result.n_unconverged_steps == 0


@pytest.mark.slow
@pytest.mark.nightly
def test_without_newton_steps_every_step_near_the_casing_falls_back_and_converges(blade, stiff, tmp_path):
    whole, result = simulate(blade, stiff), limited(blade, stiff, tmp_path, 0, 200)
    assert result.n_fallback_steps >= result.n_contact_steps > 100
    assert result.n_unconverged_steps == 0
    np.testing.assert_allclose(result.wear, whole.wear, rtol=0, atol=1e-5 * whole.wear.max())


@pytest.mark.slow
def test_a_run_whose_iterations_fail_counts_its_unconverged_steps(blade, stiff, tmp_path):
    result = limited(blade, stiff, tmp_path, 0, 1)
    assert 100 < result.n_unconverged_steps <= result.n_fallback_steps


def test_the_rigid_casing_has_no_fallback(blade, spec, change):
    result = simulate(blade, change(spec, E=np.inf, K=np.inf, theta=0.0))
    assert result.n_contact_steps > 0
    assert (result.n_fallback_steps, result.n_unconverged_steps) == (0, 0)
