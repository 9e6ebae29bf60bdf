"""Decks for CalculiX, an independent finite element program: the blade at rest and rotating.

CalculiX (Dhondt, The Finite Element Method for Three-Dimensional Thermomechanical Applications, 2004) gets
the same nodes as C3D20 or C3D10 elements: a static step with geometric nonlinearity under centrifugal load,
then the frequencies of small vibrations about it. Abaqus reads the same keywords.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from bladerub.io import atomic
from bladerub.io.errors import BadInput
from bladerub.settings.blade import Material

N_MODES = 10
_KINDS = {20: "C3D20", 10: "C3D10"}


def deck(points: np.ndarray, cells: np.ndarray, root: np.ndarray, material: Material, omega: float) -> str:
    """Input of CalculiX for the blade at the angular speed `omega` (rad/s) about the x axis.

    `points` (n_nodes, 3) are in m, `cells` (n_elements, 20 or 10) in CalculiX's order but from 0, `root` the
    clamped nodes.
    """
    lines = ["*NODE, NSET=ALL"]
    # at most 20 characters a number
    lines += [f"{i}, {x:.12e}, {y:.12e}, {z:.12e}" for i, (x, y, z) in enumerate(points, 1)]
    lines.append(f"*ELEMENT, TYPE={_KINDS[cells.shape[1]]}, ELSET=BLADE")
    for i, nodes in enumerate(cells + 1, 1):
        lines += _in_lines([i, *nodes])
    lines.append("*NSET, NSET=ROOT")
    lines += [f"{node}," for node in np.asarray(root) + 1]
    elastic = f"{material.young_modulus:.9e}, {material.poisson_ratio:.9e}"
    lines += ["*MATERIAL, NAME=METAL", "*ELASTIC", elastic, "*DENSITY", f"{material.density:.9e}"]
    lines += ["*SOLID SECTION, ELSET=BLADE, MATERIAL=METAL", "*BOUNDARY", "ROOT, 1, 3"]
    if omega > 0:
        lines += ["*STEP, NLGEOM", "*STATIC", "1., 1.", "*DLOAD"]
        lines += [f"BLADE, CENTRIF, {omega**2:.12e}, 0., 0., 0., 1., 0., 0.", "*END STEP"]
    lines.append("*STEP, PERTURBATION" if omega > 0 else "*STEP")
    return "\n".join([*lines, "*FREQUENCY", str(N_MODES), "*END STEP", ""])


def _in_lines(numbers: list[int]) -> list[str]:
    """Write at most 16 of `numbers` on a line, with a comma at its end if more follow."""
    rows = [numbers[start : start + 16] for start in range(0, len(numbers), 16)]
    return [", ".join(map(str, row)) + ("," if row is not rows[-1] else "") for row in rows]


def write_decks(folder: str | Path, f_omegas: Sequence[float], f1_hz: float, *body) -> list[Path]:
    """Write a deck of `body`, the first arguments of `deck`, at each normalised speed into `folder`.

    Raises `BadInput` if two decks would have the same name.
    """
    paths = {Path(folder) / f"blade_{f_omega:.4f}.inp": f_omega for f_omega in f_omegas}
    if len(paths) < len(f_omegas):
        speeds = " ".join(f"{f_omega:g}" for f_omega in f_omegas)
        raise BadInput(f"--speeds {speeds}: must differ in four decimals, as the names of the decks do")
    for path, f_omega in paths.items():
        with atomic.writing(path) as stream:
            stream.write(deck(*body, 2 * np.pi * f_omega * f1_hz))
    return list(paths)
