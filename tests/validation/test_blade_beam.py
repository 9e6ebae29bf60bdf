"""Beams whose frequencies are known, at rest and rotating, and their stress, from 20-node hexahedra.

Sources: Wright, Smith, Thresher and Wang, Vibration modes of centrifugally stiffened beams, Journal of
Applied Mechanics 49 (1982) 197-202, table for the uniform cantilever of hub radius 0; and a Rayleigh-Ritz
solution of the same beam equation for the beams that are not in it (hub radius, plane of rotation).
Timoshenko and Goodier, Theory of Elasticity, 3rd ed., §21 (stress σ = P z x / I in a cantilever bent by a
force at its end); equilibrium of a bar that rotates about its end, σ = ρ Ω² (L² − x²)/2.

Expected: 0.1 %, and 1 % of the stress of bending, away from the ends. In the third mode the solid beam is
0.02 % below (shear and rotary inertia at slenderness 100, which Euler and Bernoulli leave out), with the hub
at the highest speed 0.05 % (it also stretches).
"""

import numpy as np
import pytest
from plate_solutions import beam_ritz, clamped, isotropic, straight
from scipy.spatial.transform import Rotation

from bladerub.blade.elasticity import lame
from bladerub.blade.linear import factorise, lowest_modes
from bladerub.blade.rotation import equilibrium
from bladerub.extras.stress.nodal import NodalStress, running_displacement, von_mises

YOUNG, DENSITY, LENGTH, WIDTH, THICKNESS = 2e11, 7800.0, 1.0, 0.05, 0.01

# First three flapwise frequencies ω √(ρAL⁴/EI) over Ω √(ρAL⁴/EI).
WRIGHT_1982 = {
    0: (3.5160, 22.0345, 61.6972),
    2: (4.1373, 22.6149, 62.2732),
    6: (7.3604, 26.8091, 66.6839),
    12: (13.1702, 37.6031, 79.6145),
}
UNIT = np.sqrt(YOUNG * THICKNESS**2 / 12 / (DENSITY * LENGTH**4))  # √(EI / ρAL⁴), rad/s


def cantilever(thin_axis, n_along=40, hub_radius=0.0):
    """A beam of slenderness 100 along z from the hub, thin along x (flap) or y (lag)."""
    size = [WIDTH, WIDTH, LENGTH]
    size[thin_axis] = THICKNESS
    return clamped(straight(size, hub_radius), (1, n_along), isotropic(YOUNG, 0.0, DENSITY))


def thin_bending(solid, thin_axis, speed):
    """Dimensionless frequencies of the first three modes that move along the thin axis."""
    frequencies, modes = lowest_modes(equilibrium(solid, speed * UNIT).stiffness, solid.mass, 6)
    share = [np.linalg.norm(mode[solid.axis == thin_axis]) / np.linalg.norm(mode) for mode in modes.T]
    return 2 * np.pi * frequencies[np.array(share) > 0.9][:3] / UNIT


def compare(what, found, expected):
    print(f"{what}: frequencies over the reference, less 1:", found / np.array(expected) - 1)
    np.testing.assert_allclose(found, expected, rtol=1e-3)


@pytest.mark.parametrize("speed", list(WRIGHT_1982))
def test_rotating_beam_flaps_as_tabulated(speed):
    np.testing.assert_allclose(beam_ritz(speed)[:3], WRIGHT_1982[speed], rtol=0, atol=6e-5)
    found = thin_bending(cantilever(0), 0, speed)
    compare(f"flap, speed {speed}", found, WRIGHT_1982[speed])


@pytest.mark.parametrize("speed", [2, 6, 12])
def test_spin_softening_takes_its_share_in_the_plane_of_rotation_and_a_hub_adds_its_tension(speed):
    # ω_lag² = ω_flap² − Ω²
    compare("lag", thin_bending(cantilever(1), 1, speed), np.sqrt(beam_ritz(speed)[:3] ** 2 - speed**2))
    hub = 2 * LENGTH
    compare("hub", thin_bending(cantilever(0, hub_radius=hub), 0, speed), beam_ritz(speed, hub / LENGTH)[:3])


def test_frequencies_converge_from_above_with_the_mesh():
    # Elements longer than thick are too stiff in shear: that costs two of the four orders of the element.
    values = [thin_bending(cantilever(0, n_along), 0, 0.0)[0] for n_along in (4, 8, 16, 40)]
    assert values == sorted(values, reverse=True)
    errors = np.array(values[:-1]) - values[-1]
    assert np.all(np.log2(errors[:-1] / errors[1:]) > 1.9)


@pytest.fixture(scope="module")
def beam():
    return cantilever(thin_axis=0, n_along=20)


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


def test_stress_turns_with_the_blade_and_the_displacement_is_a_cubic_of_the_squared_speed(beam):
    # The spline is exact there, and uniform strain along axes turned by much gives Hooke's law along these.
    turn, strain = Rotation.from_rotvec([0.4, -0.7, 0.9]).as_matrix(), np.diag([3e-4, -1e-4, 2e-4])
    points, (lam, mu) = beam.mesh.points, lame(beam.material)
    hooke = lam * np.trace(strain) * np.eye(3) + 2 * mu * strain
    found = stress(beam, points @ (turn - np.eye(3)).T, points @ (turn @ strain).T)
    np.testing.assert_allclose(found, 0 * found + turn @ hooke @ turn.T, atol=1e-6 * hooke.max())
    speeds = np.linspace(0, 1, 5)
    assert running_displacement(speeds, speeds[:, None, None] ** 6, 0.6) == pytest.approx(0.6**6)
