import numpy as np

from bladerub.blade.surface import boundary_faces, normals
from bladerub.plots.blade_mesh import View

CORNERS = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float
)
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]


def tower(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Stack n unit cubes of 20 nodes: points and connectivity."""
    cube = np.vstack([CORNERS, [(CORNERS[a] + CORNERS[b]) / 2 for a, b in EDGES]])
    every = np.vstack([cube + np.array([0, 0, level]) for level in range(n)])
    points, index = np.unique(every, axis=0, return_inverse=True)
    return points, index.reshape(n, 20)


def test_faces_between_elements_are_left_out():
    points, hexahedra = tower(3)
    faces = boundary_faces(hexahedra)
    assert faces.shape == (14, 8)
    assert set(np.unique(faces)) == set(range(len(points)))


def test_normals_point_outward_and_nodes_go_around():
    points, hexahedra = tower(2)
    polygons = points[boundary_faces(hexahedra)]
    outward = polygons.mean(axis=1) - points.mean(axis=0)
    assert (np.einsum("ij,ij->i", normals(polygons), outward) > 0).all()
    steps = np.linalg.norm(np.diff(polygons, axis=1), axis=2)
    np.testing.assert_allclose(steps, 0.5)  # from a corner to the next mid-side node


def test_view_from_the_front():
    view = View(elevation=0, azimuth=-90)  # looking along +y: x to the right, z up
    np.testing.assert_allclose(view.project(np.eye(3)), [[1, 0], [0, 0], [0, 1]], atol=1e-12)
    points, hexahedra = tower(2)
    polygons = points[boundary_faces(hexahedra)]
    seen = view.front_faces(polygons)
    np.testing.assert_allclose(polygons[seen][:, :, 1], 0, atol=1e-12)
    assert len(seen) == 2
