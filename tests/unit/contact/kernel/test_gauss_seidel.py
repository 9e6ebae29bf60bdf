"""Forces found node by node against those of Newton's method and against the law of contact."""

import math

import numpy as np
import pytest
from numba import njit

from bladerub.contact.kernel import gauss_seidel, newton, records
from bladerub.contact.kernel.modal import pack
from bladerub.contact.modes import modes_at
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
