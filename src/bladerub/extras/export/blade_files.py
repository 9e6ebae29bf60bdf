"""The blade at rest for other programs: decks for CalculiX, matrices, and the parametric one as sections.

CalculiX (Dhondt, The Finite Element Method for Three-Dimensional Thermomechanical Applications, 2004), an
independent finite element program, gets the same nodes as C3D20 or C3D10 elements: a static step with
geometric nonlinearity under centrifugal load, then the frequencies of small vibrations about it. Abaqus reads
the same keywords.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
from scipy import sparse
from scipy.io import mmwrite, savemat

from bladerub.blade.discrete import DiscreteBlade
from bladerub.blade.geometry import BladeShape
from bladerub.blade.model import ReducedBlade
from bladerub.blade.reduction import fit_speeds
from bladerub.extras.blades.matrix_folder import AT_SPEED, FIT, MASS, NODES
from bladerub.extras.blades.origin import Frame
from bladerub.extras.blades.section_table import CYLINDRICAL, POINTS
from bladerub.io import atomic
from bladerub.io.errors import BadInput
from bladerub.settings.blade import Material

N_MODES = 10  # whose frequencies CalculiX computes
N_SECTIONS, N_STATIONS = 21, 61
_KINDS = {20: "C3D20", 10: "C3D10"}
_DIGITS = 17  # enough to restore every bit
_FINE = 4000  # points along a side: angles interpolated between them are accurate to 1e-8
_SAME = 1e-9  # of the axial chord
_STATIONS = (1 - np.cos(np.linspace(0, np.pi, N_STATIONS))) / 2  # along the chord, closer at its ends


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
    """Write a deck of `body`, the first arguments of `deck`, at each normalised speed into `folder`."""
    paths = {Path(folder) / f"blade_{f_omega:.4f}.inp": f_omega for f_omega in f_omegas}
    if len(paths) < len(f_omegas):
        speeds = " ".join(f"{f_omega:g}" for f_omega in f_omegas)
        raise BadInput(f"--speeds {speeds}: must differ in four decimals, as the names of the decks do")
    for path, f_omega in paths.items():
        with atomic.writing(path) as stream:
            stream.write(deck(*body, 2 * np.pi * f_omega * f1_hz))
    return list(paths)


def write_matrices(path: str | Path, blade: ReducedBlade) -> None:
    """Write the fields of `ReducedBlade` under their own names; `path` ends in ``.npz`` or ``.mat``."""
    content = blade.arrays | blade.attributes
    with atomic.writing(path, "wb") as file:
        if Path(path).suffix.lower() == ".npz":
            np.savez_compressed(file, **content)
        else:
            savemat(file, content, do_compression=True, oned_as="column")


def write_fe_matrices(folder: str | Path, blade: DiscreteBlade, f_max: float, suffix: str) -> list[Path]:
    """Write mass, stiffness, nodes as `bladerub import` reads them, SI; `suffix` is ``.mtx`` or ``.npz``.

    `f_max` is the highest normalised speed of the fit.
    """
    names = dict(zip(fit_speeds(f_max), FIT, strict=True))
    matrices = {MASS: blade.mass} | {
        names.get(f_omega, f"{AT_SPEED}{f_omega:.10g}"): matrix for f_omega, matrix in blade.stiffness.items()
    }
    paths = {Path(folder) / f"{name}{suffix}": matrix for name, matrix in matrices.items()}
    for path, matrix in paths.items():
        with atomic.writing(path, "wb") as stream:
            if suffix == ".mtx":
                mmwrite(stream, matrix, precision=_DIGITS, symmetry="symmetric")
            else:
                sparse.save_npz(stream, matrix)
    nodes, mesh = Path(folder) / NODES, blade.layout.mesh
    table = pd.DataFrame(mesh.mesh.points, columns=["x", "y", "z"]).assign(interface=0, clamped=0, tip=0)
    table.loc[mesh.interface, "interface"] = np.arange(1, mesh.interface.size + 1)
    table.loc[mesh.root, "clamped"] = 1
    table.loc[mesh.tip, "tip"] = 1
    with atomic.writing(nodes) as stream:
        table.to_csv(stream, index=False, float_format=f"%.{_DIGITS}g")
    return [*paths, nodes]


def write_sections(path: str | Path, shape: BladeShape, coordinates: str) -> tuple[int, int]:
    """Write `shape` as a table of sections, hub to tip; return the number of sections and of all stations.

    Units and axes are the defaults of an import: m, rad, the blade's frame. Coordinates are ``cartesian``,
    points of the surface, or ``cylindrical``, axial position, radius and angles, which raises ValueError for
    a side that goes back along the axis (`bladerub.extras.blades.section_table`).
    """
    section, columns = (_cartesian, POINTS) if coordinates == "cartesian" else (_cylindrical, CYLINDRICAL)
    heights = enumerate(np.linspace(0, 1, N_SECTIONS).tolist(), 1)
    parts = {number: pd.DataFrame(section(shape, zeta), columns=list(columns)) for number, zeta in heights}
    frame, table = Frame(), pd.concat(parts, names=["section"])
    axes = f"it turns about {frame.rotation}, the air flows along {frame.downstream}"
    with atomic.writing(path) as stream:
        stream.write(f"# sections of the blade, hub to tip; m, rad; {axes}\n")
        table.droplevel(1).to_csv(stream, float_format="%.12g")
    return len(parts), len(table)


def _cartesian(shape: BladeShape, zeta: float) -> np.ndarray:
    """Points (61, 6) of both sides at the same places along the chord."""
    return np.hstack([shape.points(_STATIONS, side, zeta).T for side in (0.0, 1.0)])


def _cylindrical(shape: BladeShape, zeta: float) -> np.ndarray:
    """Axial positions, radii and angles (n, 4) of both sides; an edge askew to the axis is part of a side."""
    edges = [shape.points(np.array(xi), np.array([0.0, 1.0]), zeta)[0] for xi in (0.0, 1.0)]
    is_askew = [np.ptp(edge) > _SAME * (edges[1].max() - edges[0].min()) for edge in edges]
    outlines = []
    for side in (0, 1):
        first = np.argmin(edges[0]) if is_askew[0] else side
        last = np.argmax(edges[1]) if is_askew[1] else side
        outlines.append(_outline(shape, zeta, side, first, last))
    foremost, rearmost = edges[0].max(), edges[1].min()
    axial = foremost + (rearmost - foremost) * _STATIONS
    if is_askew[0]:
        axial = np.insert(axial, 0, edges[0].min())
    if is_askew[1]:
        axial = np.append(axial, edges[1].max())
    (radius, theta1), (_, theta2) = (
        [np.interp(axial, outline[0], values) for values in outline[1:]] for outline in outlines
    )
    return np.column_stack([axial, radius, theta1, theta2])


def _outline(shape: BladeShape, zeta: float, side: int, first: int, last: int) -> np.ndarray:
    """Axial position, radius and angle (3, n) along `side`, with the edges from `first` and to `last`."""
    path = np.array([(0.0, first), (0.0, side), (1.0, side), (1.0, last)])  # of (ξ, η)
    path = path[np.concatenate([[True], np.any(np.diff(path, axis=0) != 0, axis=1)])]
    number = np.arange(len(path))
    fine = np.linspace(0, number[-1], _FINE * number[-1] + 1)
    x, y, z = shape.points(*(np.interp(fine, number, coordinate) for coordinate in path.T), zeta)
    if (np.diff(x) <= 0).any():
        raise ValueError(f"the section at {zeta:.0%} of the span goes back along the axis; choose cartesian")
    return np.stack([x, np.hypot(y, z), -np.arctan2(y, z)])
