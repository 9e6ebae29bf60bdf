"""Write the mesh of the twisted plate, which config/twisted_plate.yaml studies.

    python config/blades/twisted_plate.py

A flat titanium plate, 150 mm long, 50 mm wide and 2.5 mm thick, twisted by 30 degrees: with length over
width 3 and width over thickness 20 it is of the family of plates of Leissa, MacBain and Kielb. It stands in
the rotor as a blade does, staggered by 30 degrees at the root and 60 at the tip, and is trimmed to a cylinder
at the hub and to a cone at the casing.
"""

from pathlib import Path

import numpy as np

from bladerub.blade.mesh import SolidMesh, hexahedral_mesh
from bladerub.extras.export.mesh_file import write_mesh_file

FILE = Path(__file__).with_name("twisted_plate.inp")

HUB_RADIUS, LENGTH, WIDTH, THICKNESS = 0.35, 0.15, 0.05, 2.5e-3
STAGGER, TWIST = np.deg2rad(30), np.deg2rad(30)
TIP_CONE = np.deg2rad(12.5)
ELEMENTS = (7, 1, 24)  # along the chord, so that eight corners are on the camber line; thickness; span


def points(xi: np.ndarray, eta: np.ndarray, zeta: np.ndarray) -> np.ndarray:
    """Map the unit cube to the blade (3, n), m: x along the engine axis, z along the blade.

    As in the parametric blade, the leading edge is upstream and ahead in the rotation, which takes z to y.
    """
    angle = STAGGER + TWIST * zeta
    along, across = WIDTH * (xi - 0.5), THICKNESS * (eta - 0.5)
    x = along * np.cos(angle) + across * np.sin(angle)
    y = across * np.cos(angle) - along * np.sin(angle)
    radius = HUB_RADIUS + LENGTH * zeta + zeta * np.tan(TIP_CONE) * x
    return np.stack([x, y, np.sqrt(radius**2 - y**2)])


def mesh() -> tuple[SolidMesh, dict[str, np.ndarray]]:
    """Mesh of the blade and its node sets."""
    hexahedra, (_, _, zeta) = hexahedral_mesh(*(np.linspace(0, 1, n + 1) for n in ELEMENTS), points)
    return hexahedra, {"ROOT": np.flatnonzero(zeta == 0), "TIP": np.flatnonzero(zeta == 1)}


if __name__ == "__main__":
    plate, node_sets = mesh()
    write_mesh_file(FILE, plate.points, plate.cells, node_sets)
