from types import SimpleNamespace

import numpy as np
import pytest

from bladerub.blade.geometry import EDGE_THICKNESS, BladeShape
from bladerub.blade.mesh import BladeMesh, hexahedral_mesh
from bladerub.settings.blade import Mesh


def test_every_node_lies_on_the_blade(twisted_config):
    shape = BladeShape.from_config(twisted_config)
    lattice = (np.linspace(0, 1, 8), np.linspace(0, 1, 2), np.linspace(0, 1, 4))
    mesh, parameters = hexahedral_mesh(*lattice, shape.points)
    np.testing.assert_array_equal(mesh.doflocs, shape.points(*parameters))
    corners, edges = 8 * 2 * 4, 7 * 2 * 4 + 8 * 1 * 4 + 8 * 2 * 3
    assert mesh.doflocs.shape[1] == corners + edges
    assert np.unique(mesh.cells).size == corners + edges


@pytest.mark.parametrize(("chordwise", "thickness"), [(7, 1), (8, 2)])  # 15 and 17 nodes for 8
def test_interface_takes_the_nodes_of_the_tip_nearest_to_even_places(twisted_config, chordwise, thickness):
    shape = BladeShape.from_config(twisted_config)
    counts = Mesh.model_construct(chordwise=chordwise, thickness=thickness, spanwise=1)
    blade = BladeMesh.from_shape(shape, counts)
    on_line = np.linspace(0, 1, 2 * chordwise + 1)[:: 3 - thickness]
    nearest = [np.argmin(np.abs(on_line - place)) for place in np.linspace(0, 1, 8)]
    expected = shape.points(on_line[nearest], 0.5, 1.0)
    np.testing.assert_allclose(blade.mesh.points[blade.interface], expected.T, atol=1e-15)
    assert np.isin(blade.interface, blade.tip).all()


def test_volume_is_that_of_the_sections(twisted_config):
    # Wrapping and stacking keep the area of a section in (x, t): thickness times camber line.
    shape = BladeShape.from_config(twisted_config)
    xi, weight = np.polynomial.legendre.leggauss(20)
    xi, weight = (xi + 1) / 2, weight / 2
    volume = 0.0
    for height, share in zip(xi, weight, strict=True):
        chord, thickness, camber = ((1 - height) * shape.sections[0] + height * shape.sections[1])[:3]
        slope = np.tan(camber / 2) * (1 - 2 * xi)
        profile = 1 - (1 - EDGE_THICKNESS) * (2 * xi - 1) ** 2
        volume += share * 0.2 * chord**2 * thickness * np.sum(weight * profile * np.hypot(1, slope))
    mesh = BladeMesh.from_shape(shape, Mesh(chordwise=8, thickness=1, spanwise=6)).mesh
    points, weights = mesh.quadrature()
    assert np.sum(mesh.mapping().detDF(points) @ weights) == pytest.approx(volume, rel=2e-5)


def test_a_shape_that_turns_elements_inside_out_is_refused(twisted_config):
    for points in (lambda xi, eta, zeta: np.stack([eta, xi, zeta]), lambda *xi: np.stack(xi) + np.nan):
        with pytest.raises(ValueError, match="turned inside out"):
            BladeMesh.from_shape(SimpleNamespace(points=points), twisted_config.mesh)
