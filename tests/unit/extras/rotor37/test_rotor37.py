from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import scipy.linalg

from bladerub.contact.casing import gap
from bladerub.contact.modes import mode_shapes_at, tip_radii
from bladerub.extras.rotor37 import direct, nlstep, numbers, reference

F_OMEGA, DAMPING, MOVING = 0.2, 0.005, 6


def test_the_boundary_is_massless_and_moves_and_the_free_modes_are_as_on_the_whole_blade(blade):
    mass, damping, stiffness = nlstep.massless_boundary(blade, F_OMEGA, DAMPING, MOVING)
    boundary = 3 * blade.n_interface
    for matrix in (mass, damping):
        assert not matrix[:boundary].any()
        assert not matrix[:, :boundary].any()
    turn = scipy.linalg.block_diag(*nlstep.directions(blade))
    np.testing.assert_allclose(turn @ turn.T, np.eye(boundary), atol=1e-12)
    whole = turn @ np.linalg.inv(blade.stiffness(F_OMEGA))[:boundary, :boundary] @ turn.T
    here = np.linalg.inv(stiffness)[:boundary, :boundary]
    np.testing.assert_allclose(here, whole, atol=1e-6 * abs(whole).max())
    follows = np.linalg.solve(stiffness[:boundary, :boundary], stiffness[:boundary, boundary:])
    free = stiffness[boundary:, boundary:] - stiffness[boundary:, :boundary] @ follows
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


def test_uncertainty_adds_changes_and_resolution_and_direct_contact_is_of_the_last_five_revolutions():
    def measured(**values):
        rows = [(name, value, "m", 0.3 if name == "speed" else 0.0) for name, value in values.items()]
        return pd.DataFrame(rows, columns=numbers.COLUMNS)

    depths = {"reference": 1.0, "step": 1.3, "modes": 0.6, "nodes": 1.0}
    tables = {name: measured(depth=depth, speed=2.0, lost=1.0) for name, depth in depths.items()}
    table = reference.with_uncertainty(tables | {"mesh": measured(depth=1.0, speed=2.4)}).set_index("number")
    assert table.uncertainty.to_dict() == pytest.approx({"depth": 0.5, "speed": 0.5})
    assert table.by_step["depth"] == pytest.approx(0.3)
    assert table.by_modes["depth"] == pytest.approx(-0.4)
    turned = np.arange(10 * 360) / 360 * 2 * np.pi
    displacement = 1e-4 * (2 * np.cos(4 * turned) - 0.5 * np.cos(6 * turned) - 1)
    displacement[: 5 * 360] = 1.0
    result = SimpleNamespace(radial_displacement=displacement, n_contact_steps=1, n_steps=4)
    found = numbers.of_direct_contact("rest", result, 10).set_index("number").value
    assert found["rest.order_4"] == pytest.approx(2e-4, rel=1e-6)
    assert found["rest.order_6"] == pytest.approx(0.5e-4, rel=1e-6)
    assert found["rest.highest"] == pytest.approx(displacement[-360:].max())
    assert found["rest.amplitude"] == pytest.approx(np.ptp(displacement[-360:]) / 2)
    assert found["rest.contact_share"] == 0.25
