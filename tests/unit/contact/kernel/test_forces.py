"""Forces by Newton's method and node by node, runs with other limits of iterations, and shorter vectors."""

import math
import os
import pickle
import platform
import subprocess
import sys

import numpy as np
import pytest
from numba import njit

from bladerub.contact.kernel import gauss_seidel, newton, records
from bladerub.contact.kernel.modal import pack
from bladerub.contact.modes import modes_at
from bladerub.contact.run import simulate
from bladerub.contact.schemes import SCHEMES, Contact
from bladerub.contact.start import stator_record, tip_record
from bladerub.numerics.memory import addresses
from bladerub.numerics.vectors import LANES

STEP = 2e-5

find_forces, sweep = njit(newton.find_forces), njit(gauss_seidel.gauss_seidel)


@pytest.fixture
def parts(blade, spec, change):
    """Build what the loop works on, for a coating so stiff that many modes give way in the step."""

    def build(**changes):
        chosen = change(spec, n_elements=2000, **changes)
        angle = chosen.coating.theta
        stiffness = np.full(LANES, 1e7 if np.isfinite(chosen.coating.E) else np.inf)
        contact = Contact(stiffness, -math.cos(angle), -math.sin(angle))
        rule = SCHEMES["exponential"](modes_at(blade, 0.3), 0.0, STEP, contact)
        state = records.at_rest(rule.omega.size, 2000)
        tip = tip_record(blade, chosen)
        stator = stator_record(blade, chosen, rule)
        state.tangential_factor[:] = stator.tangential_factor
        return pack(rule), stator, tip, state

    return build


def pressed_in(stator, tip, depth):
    """Displacement that puts node j by `depth` times (1 + j / 10) into the coating, all slightly along it."""
    rows = stator.initial_gap[0] + depth * (1 + np.arange(LANES) / 10)
    return np.concatenate([rows, np.full(LANES, 0.2 / tip.per_metre), np.zeros(2 * LANES)])


@pytest.mark.parametrize("theta", [0.0, 0.15])
@pytest.mark.parametrize("depth", [-1e-6, 1e-6, 3e-5])
def test_the_same_forces_as_newton(parts, depth, theta):
    modal, stator, tip, state = parts(E=20.0, K=10.0, theta=theta)
    assert modal.compliance.any()
    records = [addresses(record) for record in (modal, stator, tip, state)]
    free = pressed_in(stator, tip, depth)
    u = free.copy()
    assert find_forces(*records[:3], 0.0, records[3], u.ctypes.data, False)
    by_newton = state.force[0].copy(), state.normal_force[0].copy(), u[: 2 * LANES].copy()
    state.force[:], state.normal_force[:] = 0.0, 0.0
    u[:] = free
    sweep(*records[:3], records[3], 0.0, u.ctypes.data, 1e-13)
    by_sweeps = state.force[0], state.normal_force[0], u[: 2 * LANES]
    for found, expected in zip(by_sweeps, by_newton, strict=True):
        tolerance = 2 * newton.TOLERANCE / abs(depth)  # of heights, in parts of the penetration
        np.testing.assert_allclose(found, expected, rtol=0, atol=tolerance * np.abs(expected).max())
    assert (state.normal_force[0] > 0).sum() >= (8 if depth > 0 else 0)


def test_rigid_casing_stops_the_tip(parts):
    modal, stator, tip, state = parts(E=np.inf, K=np.inf, theta=0.0)
    records = [addresses(record) for record in (modal, stator, tip, state)]
    u = pressed_in(stator, tip, 1e-5)
    sweep(*records[:3], records[3], 0.0, u.ctypes.data, 1e-13)
    height = np.hypot(tip.radius + u[:LANES], u[LANES : 2 * LANES]) - tip.radius
    touching = state.normal_force[0] > 0
    assert touching.any()
    position = tip.start + u[LANES : 2 * LANES] * tip.per_metre
    along = np.arange(-3, 4)
    for j in range(LANES):
        gap = np.interp(position[j], along + 0.5, stator.initial_gap[along, j])
        if touching[j]:
            assert height[j] == pytest.approx(gap, abs=1e-11)
        else:
            assert height[j] <= gap


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
