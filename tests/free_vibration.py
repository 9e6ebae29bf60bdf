"""Frequencies of a body by finite elements, for tests of what makes its mesh."""

from bladerub.blade.elasticity import Solid
from bladerub.blade.linear import lowest_modes
from bladerub.blade.rotation import equilibrium


def frequencies(mesh, root, material, n_modes=8):
    """Lowest frequencies at rest, Hz, of a `mesh` whose nodes `root` are clamped."""
    solid = Solid(mesh, material, clamped=root)
    return lowest_modes(equilibrium(solid, 0.0).stiffness, solid.mass, n_modes)[0]
