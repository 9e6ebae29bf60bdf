"""Stress of beams from their displacement, against closed forms.

Sources: Timoshenko and Goodier, Theory of Elasticity, 3rd ed., §21 (σ = P z x / I in a cantilever bent by a
force at its end); equilibrium of a bar that rotates about its end, σ = ρ Ω² (L² − x²)/2.
Expected: 1 % (0.1 % for the rotating bar), away from the ends.
"""

import numpy as np
import pytest
from plate_solutions import clamped, straight

from bladerub.blade.elasticity import Material
from bladerub.blade.linear import factorise
from bladerub.blade.rotation import equilibrium
from bladerub.extras.stress.nodal import NodalStress, running_displacement, von_mises

YOUNG, DENSITY, LENGTH, WIDTH, THICKNESS = 2e11, 7800.0, 1.0, 0.05, 0.02


@pytest.fixture(scope="module")
def beam():
    """A cantilever along z from the axis of rotation, thin along x."""
    return clamped(straight((THICKNESS, WIDTH, LENGTH)), (1, 20), Material(YOUNG, 0.0, DENSITY))


def stress(solid, running, vibration):
    return NodalStress(solid.mesh.points, solid.mesh.cells, solid.material, running)(vibration)


def away_from_the_ends(points):
    return (points[:, 2] > 0.1 * LENGTH) & (points[:, 2] < 0.9 * LENGTH)


def test_bending_stress_of_a_cantilever_with_a_force_at_its_tip(beam):
    solid, points, force = beam, beam.mesh.points, 1.0
    tip = np.flatnonzero(points[:, 2] == LENGTH)
    load = np.zeros(solid.free.size)
    load[solid.coordinates(tip)[::3]] = force / tip.size
    u = solid.full(factorise(solid.tangent(np.zeros(solid.free.size)))(load))
    inertia = WIDTH * THICKNESS**3 / 12
    expected = -force * (LENGTH - points[:, 2]) * points[:, 0] / inertia
    found = stress(solid, np.zeros_like(u), u)
    surface = away_from_the_ends(points) & (np.abs(points[:, 0]) == THICKNESS / 2)
    np.testing.assert_allclose(found[surface, 2, 2], expected[surface], rtol=0.01)
    np.testing.assert_allclose(von_mises(found)[surface], np.abs(expected[surface]), rtol=0.01)


def test_stress_of_a_rotating_bar(beam):
    solid, z, omega = beam, beam.mesh.points[:, 2], 50.0
    speeds = np.array([0.0, 30.0, 60.0])
    static = np.stack([solid.full(equilibrium(solid, omega).displacement) for omega in speeds])
    expected = DENSITY * omega**2 * (LENGTH**2 - z**2) / 2
    running = running_displacement(speeds, static, omega)
    found = stress(solid, running, np.zeros_like(running))[:, 2, 2]
    inside = away_from_the_ends(solid.mesh.points)
    np.testing.assert_allclose(found[inside], expected[inside], atol=1e-3 * expected.max())
    assert found[z == 0] == pytest.approx(expected.max(), rel=0.01)


def test_a_turn_of_the_whole_body_causes_no_stress(beam):
    angle = 0.3
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    turned = beam.mesh.points @ turn.T - beam.mesh.points
    assert np.abs(stress(beam, turned, np.zeros_like(turned))).max() < 1e-9 * YOUNG
