"""Blades from elsewhere that cannot be one, and the words of the answer.

`IMPORTS` are command lines of ``bladerub``; the files and folders that they name are made by `make_blades`.
"""

from collections.abc import Callable
from pathlib import Path

import meshio
import numpy as np
import pandas as pd
from scipy import sparse
from scipy.io import mmwrite

from bladerub.blade.geometry import BladeShape
from bladerub.blade.mesh import BladeMesh
from bladerub.config.read import load
from bladerub.extras.export.mesh_file import write_mesh_file

CONFIG = Path(__file__).parents[2] / "config" / "config.yaml"

_VTU = "import blades/blade.vtu"
_CSV = "import blades/{}.csv"
_FOLDER = "import blades/{}"

IMPORTS: dict[str, str] = {
    "import blades/no.inp": "blades/no.inp: there is no such file",
    "import blades/empty.msh": "blades/empty.msh: is empty",
    "import blades/words.vtu": "blades/words.vtu: is not a .vtu file that can be read",
    "import blades/blade.stl": "blades/blade.stl: must be a mesh file that ends in .inp, .msh, .vtu",
    f"{_VTU} --root-set FOTO": 'root not found: there is no node set "FOTO"; did you mean FOOT?',
    f"{_VTU} --tip-set FACE": "the tip is no profile with two sides; name its node set",
    f"{_VTU} --tip-set FOOT --root-set FOOT": "root and tip share nodes; name other node sets",
    f"{_VTU} --tip-set INSIDE": "tip not found: no face of the surface has all its nodes in",
    f"{_VTU} --unit mm": "with the unit mm the blade is 0.0001996 m long; must be from 0.01 to 3 m",
    f"{_VTU} --radial x": "radial = x: must not be the axis of rotation",
    "import blades/mixed.vtu": "mixes hexahedron20 and tetra10; must have elements of one kind",
    "import blades/shell.vtu": "has no volume elements; must have some of one kind",
    "import blades/mirrored.vtu": "all elements are left-handed; the mesh must not be mirrored",
    "import blades/inside_out.vtu": "element 5: its Jacobian is negative, it is turned inside out",
    "import blades/nan.vtu": "node 8: its coordinates are not finite numbers",
    "import blades/far.vtu": "node 8: a coordinate is 1e+160; must be 1e+09 or less",
    "import blades/flat.vtu": "element 1: its Jacobian is zero, it is flat",
    "import blades/circle.vtu": "blades/circle.vtu: there is no such file",
    "import blades/twins.vtu": "are in one place; merge them",
    "import blades/loose.vtu": "node is not in the middle of its edge",
    "import blades/two_parts.inp": "has 2 blocks *NODE; must have all nodes in one",
    _CSV.format("columns"): "blades/columns.csv: has no column z2; must have section, x1, y1, z1",
    _CSV.format("holes"): "blades/holes.csv: line 5: x2 = nothing, must be a finite number",
    _CSV.format("one_section"): "blades/one_section.csv: has 1 section; must have two or more",
    _CSV.format("downwards"): "section hub: its mean radius of 0.4 m is not above that of section tip",
    _CSV.format("crossed"): "line 6: the sides of section hub touch or cross here",
    _FOLDER.format("lacking"): "blades/lacking: holds no stiffness_rest.mtx or stiffness_rest.npz",
    _FOLDER.format("lopsided"): "stiffness_half.mtx: is not symmetric: its entry (7, 4) is",
    _FOLDER.format("larger"): "stiffness_max.mtx: is 30 x 30; must have three rows for each",
    _FOLDER.format("not_finite"): "mass.mtx: its entry (3, 3) is inf; must be a finite number",
    _FOLDER.format("massless"): "mass.mtx: is not positive definite: its entry (6, 6) is 0; must be",
    _FOLDER.format("seven"): "mass.mtx: is 48 x 48; must have three rows for each of the 15 nodes",
}


def make_blades(folder: Path) -> None:
    """Make what `IMPORTS` name, below `folder`."""
    folder = folder / "blades"
    folder.mkdir()
    (folder / "empty.msh").touch()
    (folder / "words.vtu").write_text("a blade\n")
    (folder / "blade.stl").write_text("solid blade\n")
    _make_meshes(folder)
    _make_tables(folder)
    for name, damage in _DAMAGES.items():
        _make_matrices(folder / name, damage)


def _make_meshes(folder: Path) -> None:
    blade = load(CONFIG)["blade"]
    counts = {"chordwise": 7, "thickness": 1, "spanwise": 3}
    mesh = BladeMesh.from_shape(BladeShape.from_config(blade), counts)
    points, cells = mesh.mesh.points, mesh.mesh.cells
    corners = cells[:, :8]
    face = np.intersect1d(cells[-1], mesh.tip)
    sets = {"FOOT": mesh.root, "TOP": mesh.tip, "FACE": face, "INSIDE": mesh.tip[::2]}
    write_mesh_file(folder / "blade.vtu", points, cells, sets)

    def write(name: str, points: np.ndarray = points, cells: np.ndarray = cells) -> None:
        write_mesh_file(folder / name, points, cells, {})

    def changed(values: np.ndarray, at: tuple, value: object) -> np.ndarray:
        copy = values.copy()
        copy[at] = value
        return copy

    write("mirrored.vtu", points * [1, 1, -1])
    write("flat.vtu", points * [1, 0, 1] + [0, 1, 0])
    write("far.vtu", changed(points, (7, 1), 1e160))
    (folder / "circle.vtu").symlink_to("circle.vtu")
    write("nan.vtu", changed(points, (7, 1), np.nan))
    ends = points[corners[4, [1, 2]]]
    write("loose.vtu", changed(points, (cells[4, 9],), 0.9 * ends[0] + 0.1 * ends[1]))
    upside_down = [*range(4, 8), *range(4), *range(12, 16), *range(8, 12), *range(16, 20)]
    write("inside_out.vtu", cells=changed(cells, (4,), cells[4, upside_down]))
    apart = changed(cells, (0,), len(points) + np.arange(20))
    write("twins.vtu", np.vstack([points, points[cells[0]]]), apart)
    write("two_parts.inp")
    with (folder / "two_parts.inp").open("a") as file:
        file.write("*NODE\n90001, 0, 0, 0\n")
    tetrahedra = ("tetra10", cells[:1, [0, 1, 3, 4, 8, 9, 11, 16, 17, 19]])
    meshio.Mesh(points, [("hexahedron20", cells), tetrahedra]).write(folder / "mixed.vtu")
    meshio.Mesh(points, [("quad", corners[:, :4])]).write(folder / "shell.vtu")


def _make_tables(folder: Path) -> None:
    """A straight plate in two sections, and what can be wrong with it."""
    x = np.linspace(-0.03, 0.03, 9)
    side = {"x1": x, "y1": 0.002 + 0 * x, "x2": x, "y2": -0.002 + 0 * x}
    heights = {"hub": 0.4, "tip": 0.6}
    hub, tip = (pd.DataFrame({"section": name, **side, "z1": z, "z2": z}) for name, z in heights.items())
    table = pd.concat([hub, tip], ignore_index=True)
    holes, crossed = table.copy(), table.copy()
    holes.loc[3, "x2"] = np.nan
    crossed.loc[4, "y1"] = -0.004
    for name, content in {
        "columns": table.drop(columns="z2"),
        "holes": holes,
        "one_section": hub,
        "downwards": pd.concat([tip, hub]),
        "crossed": crossed,
    }.items():
        content.to_csv(folder / f"{name}.csv", index=False)


def _make_matrices(folder: Path, damage: Callable[[dict], None]) -> None:
    """Two rows of eight nodes on springs, with one thing wrong."""
    n = 48
    off_diagonal = -np.ones(n - 3)
    chain = sparse.diags_array([np.full(n, 2.1), off_diagonal, off_diagonal], offsets=[0, 3, -3]).tocsc()
    nodes = pd.DataFrame(
        {
            "x": np.tile(np.linspace(-0.03, 0.03, 8), 2),
            "y": 0.0,
            "z": np.repeat([0.5, 0.6], 8),
            "interface": np.concatenate([np.zeros(8, dtype=int), np.arange(1, 9)]),
        }
    )
    content = {"mass": 1e-3 * sparse.eye_array(n).tocsc(), "nodes": nodes}
    for name, factor in (("rest", 1e5), ("half", 1.1e5), ("max", 1.4e5)):
        content[f"stiffness_{name}"] = factor * chain
    damage(content)
    folder.mkdir()
    for name, value in content.items():
        if name == "nodes":
            value.to_csv(folder / "nodes.csv", index=False)
        else:
            mmwrite(folder / f"{name}.mtx", value, symmetry="general")


def _set(name: str, at: tuple[int, int], value: float) -> Callable[[dict], None]:
    def damage(content: dict) -> None:
        matrix = content[name].tolil()
        matrix[at] = value
        content[name] = matrix.tocsc()

    return damage


_DAMAGES: dict[str, Callable[[dict], None]] = {
    "lacking": lambda content: content.__delitem__("stiffness_rest"),
    "lopsided": _set("stiffness_half", (3, 6), 7.0),
    "larger": lambda content: content.update(stiffness_max=sparse.eye_array(30).tocsc()),
    "not_finite": _set("mass", (2, 2), np.inf),
    "massless": _set("mass", (5, 5), 0.0),
    "seven": lambda content: content.update(nodes=content["nodes"][:15]),
}
