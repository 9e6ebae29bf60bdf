"""Edges and faces of quadratic elements, and the surface of a mesh of them."""

import numpy as np

NAMES = {20: "hexahedron20", 10: "tetra10"}
"""By the nodes of the element: its name in meshio."""

EDGES = {
    20: np.array(
        [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    ),
    10: np.array([(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]),
}
"""By the nodes of the element: the corners at the ends of each edge, in the order of its mid-side nodes."""

_CORNERS_OF_FACES = {
    20: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
    10: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
}


def _faces(n_nodes: int) -> np.ndarray:
    """Corners and mid-side nodes in turn around each face of an element, seen from outside."""
    corners = _CORNERS_OF_FACES[n_nodes]
    first = n_nodes - len(EDGES[n_nodes])
    middle = {frozenset(edge): first + at for at, edge in enumerate(EDGES[n_nodes].tolist())}
    around = [zip(face, face[1:] + face[:1], strict=True) for face in corners]
    return np.array([[node for a, b in face for node in (a, middle[frozenset((a, b))])] for face in around])


_FACES = {n_nodes: _faces(n_nodes) for n_nodes in EDGES}


def boundary_faces(cells: np.ndarray) -> np.ndarray:
    """Faces (n_faces, 8 or 6) that belong to one element only, of `cells` (n_elements, 20 or 10).

    The nodes of elements are in the order of CalculiX's C3D20 or C3D10; those of a face are corners and
    mid-side nodes in turn, a corner first, counter-clockwise seen from outside.
    """
    faces = cells[:, _FACES[cells.shape[1]]]
    faces = faces.reshape(-1, faces.shape[-1])
    _, inverse, count = np.unique(np.sort(faces, axis=1), axis=0, return_inverse=True, return_counts=True)
    return faces[count[inverse.ravel()] == 1]


def normals(polygons: np.ndarray) -> np.ndarray:
    """Outward unit normals (n, 3) of faces (n, 8 or 6, 3) ordered as by `boundary_faces`."""
    corners = polygons[:, ::2]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    if corners.shape[1] == 4:
        normal += np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 0])
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)
