import dataclasses

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub.contact.modes import mode_shapes_at, modes_at
from bladerub.extras.turning.motion import further


def test_modes_diagonalise_the_blade_and_give_its_static_tip_compliance(blade):
    modes = modes_at(blade, 0.3)
    compliance = (modes.tip / modes.omega**2) @ modes.tip.T
    load = np.zeros(30)
    load[:3] = blade.radial_direction[0]
    u = np.linalg.solve(blade.stiffness(0.3), load)
    radial = np.einsum("ja,ja->j", blade.radial_direction, u[:24].reshape(8, 3))
    tangential = np.einsum("ja,ja->j", blade.tangential_direction, u[:24].reshape(8, 3))
    np.testing.assert_allclose(compliance[0], np.concatenate([radial, tangential]), rtol=1e-9, atol=1e-16)


def test_turn_of_the_whole_blade_about_the_axis_tilts_no_profile(blade, spec):
    """The tip's slope is minus the angle then, and the normal of the casing turns with the nodes."""
    _, y, z = blade.node_position.T
    turn = np.concatenate([np.column_stack([0 * y, z, -y]).ravel(), np.zeros(6)])
    turning = dataclasses.replace(blade, tip_slope=-np.outer(np.ones(8), turn) / (turn @ turn))
    np.testing.assert_allclose(further(turning, turn[:, None], spec), 0.0, rtol=0, atol=1e-12)
    along = dataclasses.replace(blade, tip_slope=np.zeros((8, turn.size)))  # it moves and does not turn
    width = 2 * np.pi * 0.65 / spec.coating.n_elements
    np.testing.assert_allclose(further(along, turn[:, None], spec), width)


def test_the_shapes_do_not_depend_on_the_threads_of_who_asks_first(blade):
    found = []
    for threads in (1, 2):
        with threadpool_limits(threads, "blas"):
            unknown = dataclasses.replace(blade)  # another one, whose modes were not asked for
            found.append(mode_shapes_at(unknown, 0.3))
    for one, other in zip(*found, strict=True):
        np.testing.assert_array_equal(one, other)
