from types import SimpleNamespace

import numpy as np
import pytest
from blade_parts import section
from scipy.interpolate import CubicSpline

from bladerub.blade.geometry import EDGE_THICKNESS, BladeShape, check, corner_jacobians
from bladerub.blade.mesh import BladeMesh, hexahedral_mesh
from bladerub.settings.blade import Mesh


def camber_line_at_tip(config, xi):
    return BladeShape.from_config(config).points(np.asarray(xi, dtype=float), 0.5, 1.0)


@pytest.mark.parametrize("n", [2, 3, 4])
def test_sections_are_on_a_cubic_spline_to_the_last_bit(n):
    rng = np.random.default_rng(n)
    span, sections = np.r_[0.0, np.sort(rng.random(n - 2)), 1.0], rng.random((n, 6))
    zeta = np.r_[span, rng.random(20)]
    shape = BladeShape(0.45, 0.2, 0.0, span, sections)
    np.testing.assert_array_equal(shape.section(zeta).T, CubicSpline(span, sections)(zeta))


def test_lean_and_stagger_are_with_the_rotation_and_sweep_goes_downstream(blade_config):
    moved = [section(0.0), section(1.0, lean=0.03, sweep=0.01)]
    x, y, z = camber_line_at_tip(blade_config.replaced("sections", moved), 0.5)
    assert np.arctan2(y, z) == pytest.approx(0.03 / 0.65, rel=1e-12)
    assert x == pytest.approx(0.01, rel=1e-12)
    turned = [section(0.0), section(1.0, stagger=30.0)]  # puts the leading edge upstream and ahead
    blade = blade_config.replaced("sections", turned)
    (x_lead, x_trail), (y_lead, y_trail), _ = camber_line_at_tip(blade, [0.0, 1.0])
    assert x_trail - x_lead == pytest.approx(0.08 * np.cos(np.pi / 6), rel=1e-12)
    assert y_lead > 0 > y_trail


def test_camber_turns_by_its_angle_with_the_hollow_side_ahead(blade_config):
    blade, step = blade_config.replaced("sections", [section(s, camber=20.0) for s in (0.0, 1.0)]), 1e-6
    x, y, z = camber_line_at_tip(blade, [0.0, step, 1 - step, 1.0])
    t = 0.65 * np.arctan2(y, z)
    slope = np.diff(t) / np.diff(x)
    assert np.rad2deg(np.arctan(slope[-1]) - np.arctan(slope[0])) == pytest.approx(20.0, abs=1e-3)
    assert slope[0] < 0 < slope[-1]  # the ends lie ahead of the middle


def test_sections_are_stacked_by_the_centroid_of_the_camber_line(twisted_config):
    hub, tip = twisted_config.sections
    xi = (np.arange(2000) + 0.5) / 2000
    stacked = [hub, tip.replaced("sweep", 0.0).replaced("lean", 0.0)]
    x, y, z = camber_line_at_tip(twisted_config.replaced("sections", stacked), xi)
    assert x.mean() == pytest.approx(0.0, abs=1e-8)
    assert np.arctan2(y, z).mean() == pytest.approx(0.0, abs=1e-8)


@pytest.mark.parametrize(("chordwise", "thickness", "n_nodes"), [(6, 1, 7), (3, 4, 7)])
def test_check_counts_the_nodes_of_the_interface(blade_config, chordwise, thickness, n_nodes):
    blade = blade_config.replaced("mesh.thickness", thickness)
    with pytest.raises(ValueError, match=rf"^blade\.mesh\.chordwise = {chordwise}: gives {n_nodes} nodes"):
        check(blade.replaced("mesh.chordwise", chordwise))
    check(blade.replaced("mesh.chordwise", 4 if thickness % 2 == 0 else 7))


@pytest.mark.parametrize("cone", [0.0, 12.0])
def test_the_flow_path_widens_gradually_from_a_cylindrical_hub_to_the_tip(twisted_config, cone):
    shape = BladeShape.from_config(twisted_config.replaced("tip_cone", cone))
    xi, eta, zeta = np.meshgrid(*[np.linspace(0, 1, 5)] * 3)
    x, y, z = shape.points(xi, eta, zeta)
    expected = 0.45 + zeta * (0.2 + x * np.tan(np.deg2rad(cone)))
    np.testing.assert_allclose(np.hypot(y, z), expected, rtol=1e-14)


def test_check_finds_elements_inside_out_at_some_corners(blade_config):
    """A section so thick that its hollow side folds, while the other elements stay in order."""
    thick = [section(span, thickness=1.0, camber=100.0) for span in (0.0, 1.0)]
    blade = blade_config.replaced("sections", thick).replaced("mesh.spanwise", 1)
    corners = np.meshgrid(np.linspace(0, 1, 8), [0.0, 1.0], [0.0, 1.0], indexing="ij")
    jacobian = corner_jacobians(BladeShape.from_config(blade).points(*corners))
    assert jacobian.min() < 0 < jacobian.max()
    with pytest.raises(ValueError, match=r"^blade\.sections: mesh turned inside out at span"):
        check(blade)


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
