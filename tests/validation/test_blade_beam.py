"""Beams whose frequencies are known, at rest and rotating, from 20-node hexahedra.

Source: Wright, Smith, Thresher and Wang, Vibration modes of centrifugally stiffened beams, Journal of Applied
Mechanics 49 (1982) 197-202, table for the uniform cantilever of hub radius 0; and a Rayleigh-Ritz solution of
the same beam equation for the beams that are not in it (hub radius, plane of rotation).

Expected: 0.1 %. In the third mode the solid beam is 0.02 % below (shear and rotary inertia at slenderness
100, which Euler and Bernoulli leave out), with the hub at the highest speed 0.05 % (it also stretches).
"""

import numpy as np
import pytest
from plate_solutions import beam_ritz, clamped, straight

from bladerub.blade.elasticity import Material
from bladerub.blade.linear import lowest_modes
from bladerub.blade.rotation import equilibrium

YOUNG, DENSITY, LENGTH, THICKNESS = 2e11, 7800.0, 1.0, 0.01

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
    size = [0.05, 0.05, LENGTH]
    size[thin_axis] = THICKNESS
    return clamped(straight(size, hub_radius), (1, n_along), Material(YOUNG, 0.0, DENSITY))


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
