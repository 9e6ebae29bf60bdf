import numpy as np
import pytest

from bladerub.blade.mesh import hexahedral_mesh
from bladerub.blade.surface import boundary_faces
from bladerub.extras.blades.importing import facing


@pytest.mark.parametrize(("degrees", "is_part"), [(40.0, True), (50.0, False)])
def test_the_tip_is_what_faces_within_45_degrees_of_the_radius(degrees, is_part):
    """A block whose top falls off from its middle on, so that one half of it faces sideways."""
    fall = np.tan(np.deg2rad(degrees))

    def points(xi, eta, zeta):
        x = xi - 0.5
        return np.stack([x, 0.1 * (eta - 0.5), 10 + zeta * (1 - fall * np.maximum(x, 0))])

    mesh, (xi, _, zeta) = hexahedral_mesh(*(np.linspace(0, 1, n + 1) for n in (4, 1, 2)), points)
    tip = facing(mesh.points, boundary_faces(mesh.cells), outwards=True)
    level = np.flatnonzero((zeta == 1) & (xi <= 0.5))
    whole_top = np.flatnonzero(zeta == 1)
    np.testing.assert_array_equal(tip, whole_top if is_part else level)
