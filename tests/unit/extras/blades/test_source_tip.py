import numpy as np
import pytest
from blade_parts import section, tetrahedral_mesh

from bladerub.blade.geometry import BladeShape, lattice
from bladerub.blade.mesh import hexahedral_mesh
from bladerub.blade.surface import boundary_faces
from bladerub.extras.blades import tip
from bladerub.extras.blades.tip import interface


def tip_of(blade_config, make_mesh, counts):
    shape = BladeShape.from_config(blade_config)
    mesh, cube = make_mesh(*lattice(counts), shape.points)
    faces = boundary_faces(mesh.cells)
    return shape, mesh.points, faces[(cube[2][faces] == 1).all(axis=1)]


@pytest.mark.parametrize("cone", [-20.0, 0.0, 12.0])
def test_the_cone_of_the_tip_is_found(twisted_config, cone):
    twisted_config["tip_cone"] = cone
    _, points, faces = tip_of(twisted_config, hexahedral_mesh, twisted_config["mesh"])
    assert np.rad2deg(tip.cone(points[np.unique(faces)], None, -1)) == pytest.approx(cone, abs=1e-9)


@pytest.mark.parametrize("camber", [0.0, 30.0, 80.0])
@pytest.mark.parametrize("make_mesh", [hexahedral_mesh, tetrahedral_mesh])
def test_interface_nodes_lie_evenly_on_the_camber_line(blade_config, make_mesh, camber):
    blade_config["sections"] = [section(0.0), section(1.0, camber=camber, stagger=40.0)]
    shape, points, faces = tip_of(blade_config, make_mesh, {"chordwise": 28, "thickness": 2, "spanwise": 1})
    found = interface(points, faces, downstream_x=1)
    line = shape.points(np.linspace(0, 1, 2001), 0.5, 1.0).T
    arc = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    evenly = np.stack([np.interp(np.linspace(0, arc[-1], 8), arc, column) for column in line.T], axis=1)
    off = np.linalg.norm(points[found.nodes] - evenly, axis=1)
    assert found.chord == pytest.approx(arc[-1], rel=3e-3)
    assert off.max() < 0.6 * arc[-1] / 56  # half the distance of nodes along the chord, and a little
    assert found.offset < 0.6 * arc[-1] / 56


def test_the_leading_edge_is_upstream(twisted_config):
    _, points, faces = tip_of(
        twisted_config, hexahedral_mesh, {"chordwise": 14, "thickness": 2, "spanwise": 1}
    )
    one, other = (interface(points, faces, downstream_x=sign) for sign in (1, -1))
    np.testing.assert_array_equal(one.nodes, other.nodes[::-1])
    assert points[one.nodes[0], 0] < points[one.nodes[-1], 0]


@pytest.mark.parametrize("angle", [90.0, 180.0, -120.0])
def test_where_the_blade_stands_does_not_matter(twisted_config, angle):
    _, points, faces = tip_of(twisted_config, hexahedral_mesh, twisted_config["mesh"])
    c, s = np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle))
    turned = points @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]])
    one, other = interface(points, faces, 1), interface(turned, faces, 1)
    np.testing.assert_array_equal(one.nodes, other.nodes)
    assert other.chord == pytest.approx(one.chord, rel=1e-9)
