import numpy as np
import pytest
from tetrahedra import tetrahedral_mesh

from bladerub.blade.mesh import hexahedral_mesh
from bladerub.extras.blade_meshes import EDGES, solid_mesh


def test_elements_are_numbered_as_c3d20_and_c3d10():
    corners = (np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0]), np.array([0.0, 1.0]))
    for make_mesh, n in ((hexahedral_mesh, 8), (tetrahedral_mesh, 4)):
        mesh, _ = make_mesh(*corners, lambda *cube: np.stack(cube))
        for element in mesh.points[mesh.cells]:
            first, second, third = element[[1, 3, 4] if n == 8 else [1, 2, 3]] - element[0]
            assert np.cross(first, second) @ third > 0
            np.testing.assert_allclose(element[n:], element[EDGES[len(element)]].mean(axis=1))
    assert EDGES[20].tolist() == [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]] + [
        [corner, corner + 4] for corner in range(4)
    ]


@pytest.mark.parametrize("make_mesh", [hexahedral_mesh, tetrahedral_mesh])
def test_elements_survive_a_new_numbering(make_mesh):
    corners = (np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0]), np.array([0.0, 0.4, 1.0]))
    mesh, _ = make_mesh(*corners, lambda *cube: np.stack(cube))
    shuffled = np.random.default_rng(2).permutation(len(mesh.points) + 1)[: len(mesh.points)]
    points = np.full((len(mesh.points) + 1, 3), np.nan)
    points[shuffled] = mesh.points
    again, origin = solid_mesh(points, shuffled[mesh.cells])
    np.testing.assert_array_equal(again.points, points[origin])
    np.testing.assert_array_equal(again.points[again.cells], mesh.points[mesh.cells])
