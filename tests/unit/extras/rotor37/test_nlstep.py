from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg

from bladerub.contact.casing import gap
from bladerub.contact.modes import mode_shapes_at, tip_radii
from bladerub.extras.rotor37 import direct, nlstep, reference

F_OMEGA, DAMPING, MOVING = 0.2, 0.005, 6


@pytest.fixture
def reduced(blade):
    return nlstep.massless_boundary(blade, F_OMEGA, DAMPING, MOVING)


def test_the_boundary_has_neither_mass_nor_damping(blade, reduced):
    boundary = 3 * blade.n_interface
    for matrix in reduced[:2]:
        assert not matrix[:boundary].any()
        assert not matrix[:, :boundary].any()


def test_a_static_force_moves_the_interface_as_on_the_whole_blade(blade, reduced):
    boundary = 3 * blade.n_interface
    turn = scipy.linalg.block_diag(*nlstep.directions(blade))
    np.testing.assert_allclose(turn @ turn.T, np.eye(boundary), atol=1e-12)
    whole = turn @ np.linalg.inv(blade.stiffness(F_OMEGA))[:boundary, :boundary] @ turn.T
    here = np.linalg.inv(reduced[2])[:boundary, :boundary]
    np.testing.assert_allclose(here, whole, atol=1e-6 * abs(whole).max())


def test_the_free_modes_keep_their_frequencies_and_damping(blade, reduced):
    mass, damping, stiffness = reduced
    boundary = 3 * blade.n_interface
    free = stiffness[boundary:, boundary:] - stiffness[boundary:, :boundary] @ np.linalg.solve(
        stiffness[:boundary, :boundary], stiffness[:boundary, boundary:]
    )
    omega = mode_shapes_at(blade, F_OMEGA)[0][:MOVING]
    rounding = 16 * np.finfo(float).eps * np.abs(stiffness).max()  # what `free` is a difference of
    squares = scipy.linalg.eigvalsh(free, mass[boundary:, boundary:])
    np.testing.assert_allclose(squares, omega**2, rtol=2e-8, atol=rounding)
    np.testing.assert_allclose(np.diag(damping)[boundary:], 2 * DAMPING * omega)


def test_the_gap_is_that_of_the_casing_under_each_node_as_the_blade_turns(blade):
    config, steps = reference.plan()["reference"], 400
    spec = replace(direct.spec_of(config, blade, 0.15), f_omega=F_OMEGA)
    speed = 2 * np.pi * F_OMEGA * blade.f1_hz
    stated = nlstep.case(blade, spec, MOVING, steps)
    assert stated["gap"].shape == (8, 50 * steps + 1)
    assert stated["time"][steps] == pytest.approx(2 * np.pi / speed)
    quarter, (_, y, z) = steps // 4, blade.node_position.T
    there = spec.casing.start_angle + np.arctan2(y, z) + np.pi / 2
    clearance = np.full(8, spec.clearance[0])
    np.testing.assert_allclose(stated["gap"][:, quarter], gap(spec.casing, clearance, there), atol=1e-12)
    opening = np.gradient(stated["gap"], stated["time"], axis=1, edge_order=2)
    np.testing.assert_allclose(stated["opening_speed"], opening, atol=0.01 * opening.max())
    np.testing.assert_allclose(stated["sliding_speed"], tip_radii(blade)[0] * speed)
    assert stated["friction"] == pytest.approx(0.15)
