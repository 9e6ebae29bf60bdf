"""The blade's mesh for other programs: at rest, and for ParaView in motion, that of a row with its coating.

The mesh is that at rest in the rotating frame; ``displacement`` is the increment of each node about its
running position, as in the run, so without the centrifugal displacement and without the rotation. The stress
is the whole stress, that of the rotation included.
"""

import os
import xml.etree.ElementTree as ET
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.blade.surface import boundary_faces
from bladerub.contact.strips import element_angle
from bladerub.extras.blade_meshes import NAMES
from bladerub.io import atomic, hdf5
from bladerub.io.errors import package

if TYPE_CHECKING:
    from bladerub.extras.export.recording import Recording
    from bladerub.extras.stress.nodal import NodalStress

meshio = package("meshio", "mesh")

COLLECTION = "blade.pvd"  # the file to open: it names the others with their time in revolutions
FORMATS = {".inp": "abaqus", ".msh": "gmsh22", ".vtu": "vtu"}  # names in meshio by suffix
_FACES = {20: "quad8", 10: "triangle6"}
_MESH = {"points", "cells", "root_nodes", "tip_nodes", "interface_nodes", "recovery"}
_FRAME = (
    "Mesh: blade at rest in the rotating frame, x along the axis of rotation, m. displacement: of each node "
    "about its running position (in equilibrium at speed), m. von_mises, principal (the largest): "
    "stress of rotation and vibration, Pa. Time: revolutions from the start of the run."
)


def write_mesh_file(
    path: str | Path, points: np.ndarray, cells: np.ndarray, node_sets: dict, fields: dict | None = None
) -> None:
    """Write a mesh as ``.inp``, ``.msh`` or ``.vtu``, as the suffix of `path` says, one of `FORMATS`.

    `points` (n_nodes, 3) are in m, `cells` (n_elements, 20 or 10) in the order of CalculiX and VTK. The node
    sets become node sets in ``.inp``; in ``.msh`` physical groups of the faces of the surface that lie in
    them, or of points if there are none; in ``.vtu`` point data, 1 on the nodes of the set. Modes and
    displacements (`fields`) are point data in ``.vtu``; the other formats have no place for them.
    """
    suffix = Path(path).suffix.lower()
    if suffix == ".inp":
        mesh = meshio.Mesh(points, [_block(points, cells)], point_sets=node_sets)
    elif suffix == ".msh":
        mesh = _with_physical_groups(points, cells, node_sets)
    else:
        number = np.arange(len(points))
        marks = {name: np.isin(number, nodes).astype(np.int8) for name, nodes in node_sets.items()}
        mesh = meshio.Mesh(points, [_block(points, cells)], point_data=marks | (fields or {}))
    with atomic.writing(path, "wb") as stream:
        mesh.write(stream.name, FORMATS[suffix])  # meshio wants a path


def _block(points: np.ndarray, cells: np.ndarray) -> tuple[str, np.ndarray]:
    """Give `cells` with their name in meshio, or the nodes as vertices if there are no cells."""
    return (NAMES[cells.shape[1]], cells) if len(cells) else ("vertex", np.arange(len(points))[:, None])


def _with_physical_groups(points: np.ndarray, cells: np.ndarray, node_sets) -> meshio.Mesh:
    surface = boundary_faces(cells)
    blocks, groups = [(NAMES[cells.shape[1]], cells)], {"blade": np.array((1, 3))}  # tag, dimension
    for tag, (name, nodes) in enumerate(node_sets.items(), 2):
        inside = surface[np.isin(surface, nodes).all(axis=1)]
        if len(inside):
            blocks.append((_FACES[cells.shape[1]], np.hstack([inside[:, ::2], inside[:, 1::2]])))
        else:
            blocks.append(("vertex", np.asarray(nodes)[:, None]))
        groups[name] = np.array((tag, 2 if len(inside) else 0))
    tags = [np.full(len(rows), tag) for tag, (_, rows) in enumerate(blocks, 1)]
    data = {"gmsh:physical": tags, "gmsh:geometrical": tags}
    return meshio.Mesh(points, blocks, cell_data=data, field_data=groups)


def read_mesh(path: str | Path, blade: ReducedBlade) -> dict[str, np.ndarray]:
    """Read the mesh of `blade` and its recovery from ``mesh.h5``; an OSError names a file that is none."""
    mesh, _ = hdf5.read(path, _MESH)
    if missing := _MESH - mesh.keys():
        raise OSError(f"{path}: not the mesh of a blade, {', '.join(sorted(missing))} missing")
    interface = mesh["points"][mesh["interface_nodes"]]
    if len(mesh["recovery"]) != len(blade.mass) or not np.array_equal(interface, blade.node_position):
        raise OSError(f"{path}: is not the mesh of the reduced blade in the same folder")
    return mesh


def write_motion(
    folder: Path, mesh: dict, recording: "Recording", about: dict, stress: "NodalStress | None", row
) -> dict[str, Any]:
    """Write a recorded motion to a new folder, whole or not at all.

    `mesh` is from `read_mesh`, `stress` from `bladerub.extras.stress.run.stress_of`; `about` is what the
    motion is and where it comes from, for a comment in the collection. With a `row` its blades stand at their
    angles and the coating is written with them; None is a single blade. Returns ``largest_displacement`` (m)
    and, with `stress`, ``largest_von_mises`` and ``largest_principal`` (Pa), each with its place (m, at rest)
    and time (revolutions).
    """
    folder.parent.mkdir(parents=True, exist_ok=True)
    turns = [_turn(blade.angle) for blade in row.blades] if row else [np.eye(3)]
    points = np.concatenate([mesh["points"] @ turn for turn in turns])
    shifted = [mesh["cells"] + number * len(mesh["points"]) for number in range(len(turns))]
    cells = [_block(points, np.concatenate(shifted))]  # nodes in the order of VTK already
    root = ET.Element("VTKFile", type="Collection", version="0.1")
    lines = [_FRAME, *(f"{key}: {value}" for key, value in about.items())]
    root.append(ET.Comment("\n".join(["", *(line.replace("--", "- -") for line in lines), ""])))
    collection = ET.SubElement(root, "Collection")
    largest: dict[str, Any] = {"largest_displacement": 0.0}
    with TemporaryDirectory(prefix=f".{folder.name}.", dir=folder.parent) as scratch:
        motion = Path(scratch) / folder.name
        motion.mkdir()
        instants = zip(recording.coordinates, recording.wear, recording.time, strict=True)
        for number, (coordinates, wear, time) in enumerate(instants, 1):
            fields: list[dict[str, np.ndarray]] = []  # of each blade
            for blade_coordinates, turn in zip(coordinates, turns, strict=True):
                displacement = np.tensordot(blade_coordinates, mesh["recovery"], axes=1).astype(np.float32)
                norm = float(np.linalg.norm(displacement, axis=1).max())
                largest["largest_displacement"] = max(largest["largest_displacement"], norm)
                turned = {"displacement": (displacement @ turn).astype(np.float32)}
                fields.append(turned | _stress_fields(stress, displacement))
            data = {name: np.concatenate([of_blade[name] for of_blade in fields]) for name in fields[0]}
            for name, values in data.items():
                if name != "displacement":
                    _note(largest, f"largest_{name}", values, points, time)
            parts = {f"blade_{number:04}.vtu": meshio.Mesh(points, cells, data)}
            if row:
                parts[f"coating_{number:04}.vtu"] = _ring(mesh, wear, time)
            for part, (name, content) in enumerate(parts.items()):
                content.write(motion / name)
                ET.SubElement(collection, "DataSet", timestep=f"{time:.10g}", part=str(part), file=name)
        ET.indent(root)
        ET.ElementTree(root).write(motion / COLLECTION, encoding="utf-8", xml_declaration=True)
        os.rename(motion, folder)
    return largest


def _turn(angle: float) -> np.ndarray:
    """Matrix (3, 3) by which points (n, 3) are multiplied to turn them with the rotation."""
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])


def _ring(mesh: dict[str, np.ndarray], wear: np.ndarray, time: float) -> meshio.Mesh:
    """Make the surface of the coating, through the nodes of the tip at rest, with its `wear` (8, n)."""
    tip = mesh["points"][mesh["interface_nodes"]]
    angle = element_angle(wear.shape[1]) - 2 * np.pi * time  # as the rotating frame sees it
    radius = np.hypot(tip[:, 1], tip[:, 2])[:, None]
    axial = np.broadcast_to(tip[:, :1], wear.shape)
    points = np.stack([axial, radius * np.sin(angle), radius * np.cos(angle)], axis=-1).reshape(-1, 3)
    number = np.arange(wear.size).reshape(wear.shape)
    ahead = np.roll(number, -1, axis=1)
    cells = np.stack([number[:-1], number[1:], ahead[1:], ahead[:-1]], axis=-1).reshape(-1, 4)
    return meshio.Mesh(points, [("quad", cells)], point_data={"wear": wear.ravel().astype(np.float32)})


def _stress_fields(stress: "NodalStress | None", displacement: np.ndarray) -> dict[str, np.ndarray]:
    if stress is None:
        return {}
    from bladerub.extras.stress.nodal import von_mises

    tensor = stress(displacement)
    fields = {"von_mises": von_mises(tensor), "principal": np.linalg.eigvalsh(tensor)[:, -1]}
    return {name: values.astype(np.float32) for name, values in fields.items()}


def _note(largest: dict[str, Any], name: str, values: np.ndarray, points: np.ndarray, time: float) -> None:
    """Keep the largest of `values`, with place and time, if it exceeds that of the instants before."""
    node = np.nanargmax(values)
    if values[node] > largest.get(name, -np.inf):
        place = {f"{name}_at": points[node].tolist(), f"{name}_time": float(time)}
        largest.update({name: float(values[node])} | place)
