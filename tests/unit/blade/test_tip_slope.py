import numpy as np
import pytest

from bladerub.blade.mesh import BladeMesh, NodeCloud
from bladerub.blade.refinement import directions
from bladerub.blade.tip_slope import tip_slope

RADIUS = 0.6


@pytest.fixture
def tip():
    """A tip of 15 by 3 nodes on a cylinder, staggered, whose middle row has the interface."""
    along, across = np.meshgrid(np.linspace(-0.04, 0.04, 15), np.linspace(-4e-3, 4e-3, 3), indexing="ij")
    x, arc = (0.5 * along - 0.8 * across).ravel(), (0.8 * along + 0.5 * across).ravel()
    points = np.column_stack([x, RADIUS * np.sin(arc / RADIUS), RADIUS * np.cos(arc / RADIUS)])
    middle = np.flatnonzero(np.isclose(across.ravel(), 0))[::2]
    return BladeMesh(NodeCloud(points), np.array([], dtype=int), np.arange(len(points)), middle)


def slope_of(tip, motion):
    radial, tangential = directions(tip.mesh.points[tip.interface], 0.0)
    return tip_slope(tip, motion[None], radial, tangential)


def test_turn_about_the_axis_of_rotation_has_its_angle_as_slope(tip):
    _, y, z = tip.mesh.points.T
    turn = np.column_stack([0 * y, z, -y])  # forward by 1 rad, to first order
    np.testing.assert_allclose(slope_of(tip, turn), -1.0, rtol=0, atol=1e-4)


def test_tip_that_is_a_line_of_nodes_has_no_slope(tip):
    line = BladeMesh(tip.mesh, tip.root, tip.interface, tip.interface)
    assert slope_of(line, tip.mesh.points) is None
