"""The surface of a mesh of quadratic elements."""

import numpy as np

FACES = {  # corners and mid-side nodes in turn around each face of an element, seen from outside
    20: np.array(
        [
            *[(0, 11, 3, 10, 2, 9, 1, 8), (4, 12, 5, 13, 6, 14, 7, 15), (0, 8, 1, 17, 5, 12, 4, 16)],
            *[(1, 9, 2, 18, 6, 13, 5, 17), (2, 10, 3, 19, 7, 14, 6, 18), (3, 11, 0, 16, 4, 15, 7, 19)],
        ]
    ),
    10: np.array([(0, 6, 2, 5, 1, 4), (0, 4, 1, 8, 3, 7), (1, 5, 2, 9, 3, 8), (2, 6, 0, 7, 3, 9)]),
}


def boundary_faces(cells: np.ndarray) -> np.ndarray:
    """Faces (n_faces, 8 or 6) that belong to one element only, of `cells` (n_elements, 20 or 10).

    The nodes of elements are in the order of CalculiX's C3D20 or C3D10; those of a face are corners and
    mid-side nodes in turn, a corner first, counter-clockwise seen from outside.
    """
    faces = cells[:, FACES[cells.shape[1]]]
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
