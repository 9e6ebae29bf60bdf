from dataclasses import replace

import numpy as np
import pytest

from bladerub.blade.mesh import hexahedral_mesh
from bladerub.blade.surface import boundary_faces, normals
from bladerub.contact.illustration import loading_cycle, pressed_elements
from bladerub.contact.spec import Coating, TipProfile
from bladerub.plots.blade_mesh import front_faces, project
from bladerub.plots.illustration import coating_cycle, tip_profile

COATING = Coating(2.0, 0.5, 0.15, yield_stress=0.0, modulus_unit=1e8, thickness=5e-3, n_elements=2000)
SCENE = pressed_elements(COATING, TipProfile(half_width=1.0, edge_drop=20e-6), 0.65, depth=1e-4, reach=3)


def test_elements_reach_from_the_surface_to_the_casing_at_their_angle_and_are_worn(draws):
    shape, heights = draws(tip_profile(SCENE)).axes
    corners = np.array([path.vertices[:4] for path in shape.collections[0].get_paths()])
    np.testing.assert_allclose(corners[:, 0, 1], 1e3 * SCENE.shortening, atol=1e-12)
    np.testing.assert_allclose(corners[:, 2, 1], 5.0)
    lean = corners[:, 3] - corners[:, 0]
    np.testing.assert_allclose(lean[:, 0] / lean[:, 1], np.tan(0.15))
    at_surface = (corners[:, 0, 0] + corners[:, 1, 0]) / 2 - np.tan(0.15) * corners[:, 0, 1]
    np.testing.assert_allclose(at_surface, 1e3 * SCENE.width * SCENE.element, atol=1e-9)
    element, elastic, worn = (
        np.array([(bar.get_x() + bar.get_width() / 2, bar.get_y(), bar.get_height()) for bar in bars]).T
        for bars in heights.containers
    )
    np.testing.assert_allclose(worn[[0, 2]], [1e3 * SCENE.width * SCENE.element, 1e6 * SCENE.wear])  # mm, μm
    np.testing.assert_allclose(elastic[2], 1e6 * (SCENE.shortening - SCENE.wear), atol=1e-9)
    np.testing.assert_allclose(element[1], 1e6 * SCENE.shortening)


def test_slopes_and_the_remaining_strain_are_marked_where_they_are(draws):
    coatings = [replace(COATING, yield_stress=yield_stress) for yield_stress in (0.0, 0.02)]
    small, large = (loading_cycle(coating, (0.0, 0.03, 0.0), 30) for coating in coatings)
    axes = draws(coating_cycle({"(a) small": small, "(b) large": large})).axes
    for panel, yield_stress in zip(axes, (0.0, 0.02), strict=True):
        triangles = [line.get_xydata() for line in panel.lines if line.get_label() == "_slope"]
        slopes = [(corner[1] - start[1]) / (corner[0] - start[0]) for start, _, corner in triangles]
        assert slopes == pytest.approx([2.0, 0.4])
        (mark,) = [line for line in panel.lines if line.get_marker() == "v"]
        assert mark.get_xdata() == pytest.approx([(2.0 * 0.03 - yield_stress) / 2.5])


def tower(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Stack n unit cubes of 20 nodes: points and connectivity."""
    mesh, _ = hexahedral_mesh([0, 1], [0, 1], np.arange(n + 1.0), lambda *cube: np.stack(cube))
    return mesh.points, mesh.cells


def test_outer_faces_alone_are_found_whose_normals_point_outward():
    points, hexahedra = tower(3)
    faces = boundary_faces(hexahedra)
    assert faces.shape == (14, 8)
    polygons = points[faces]
    outward = polygons.mean(axis=1) - points.mean(axis=0)
    assert (np.einsum("ij,ij->i", normals(polygons), outward) > 0).all()
    steps = np.linalg.norm(np.diff(polygons, axis=1), axis=2)
    np.testing.assert_allclose(steps, 0.5)  # from a corner to the next mid-side node


def test_view_from_the_front():
    eye = np.array([0.0, -1.0, 0.0])  # looking along +y: x to the right, z up
    np.testing.assert_allclose(project(np.eye(3), eye), [[1, 0], [0, 0], [0, 1]], atol=1e-12)
    points, hexahedra = tower(2)
    polygons = points[boundary_faces(hexahedra)]
    seen = front_faces(polygons, eye)
    np.testing.assert_allclose(polygons[seen][:, :, 1], 0, atol=1e-12)
    assert len(seen) == 2
