"""The motion of the blade for ParaView: a mesh file for each instant, and the collection of all.

The mesh is that at rest in the rotating frame; ``displacement`` is the increment of each node about its
running position, as in the run, so without the centrifugal displacement and without the rotation.
"""

import os
import shutil
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path

import meshio
import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.recording import Recording
from bladerub.export.mesh_file import block
from bladerub.io import hdf5

COLLECTION = "blade.pvd"  # the file to open: it names the others with their time in revolutions

_MESH = {"points", "cells", "root_nodes", "tip_nodes", "interface_nodes", "recovery"}
_FRAME = (
    "Mesh: blade at rest in the rotating frame, x along the axis of rotation, m. displacement: of each node "
    "about its running position (in equilibrium at speed), m. Time: revolutions from the start of the run."
)


def read_mesh(path: str | Path, blade: ReducedBlade) -> dict[str, np.ndarray]:
    """Read the mesh of a blade and how it follows the reduced coordinates from its ``mesh.h5``.

    Raises an OSError that names the file if it is missing, damaged, or not the mesh of this blade.
    """
    mesh, _ = hdf5.read(path, _MESH)
    missing = _MESH - mesh.keys()
    if missing:
        raise OSError(f"{path}: not the mesh of a blade, {', '.join(sorted(missing))} missing")
    interface = mesh["points"][mesh["interface_nodes"]]
    if len(mesh["recovery"]) != len(blade.mass) or not np.array_equal(interface, blade.node_position):
        raise OSError(f"{path}: is not the mesh of the reduced blade in the same folder")
    return mesh


def write_motion(
    folder: str | Path, mesh: Mapping[str, np.ndarray], recording: Recording, about: Mapping[str, str]
) -> float:
    """Write a recorded motion to a new folder, whole or not at all; return the largest displacement, m.

    `mesh` is from `read_mesh`; `about` is what the motion is and where it comes from, for a comment in the
    collection.
    """
    folder = Path(folder)
    folder.parent.mkdir(parents=True, exist_ok=True)
    temporary = folder.with_name(f".{folder.name}.{os.getpid()}.tmp")
    temporary.mkdir()
    try:
        names, largest = [], 0.0
        for number, coordinates in enumerate(recording.coordinates, 1):
            displacement = np.tensordot(coordinates, mesh["recovery"], axes=1).astype(np.float32)
            largest = max(largest, float(np.linalg.norm(displacement, axis=1).max()))
            names.append(f"blade_{number:04}.vtu")
            meshio.Mesh(
                mesh["points"],
                [block(mesh["points"], mesh["cells"])],  # nodes in the order of VTK already
                point_data={"displacement": displacement},
            ).write(temporary / names[-1])
        _write_collection(temporary / COLLECTION, names, recording.time, about)
        os.rename(temporary, folder)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
    return largest


def _write_collection(path: Path, names: list[str], time: np.ndarray, about: Mapping[str, str]) -> None:
    root = ET.Element("VTKFile", type="Collection", version="0.1")
    lines = [_FRAME, *(f"{key}: {value}" for key, value in about.items())]
    root.append(ET.Comment("\n".join(["", *(line.replace("--", "- -") for line in lines), ""])))
    collection = ET.SubElement(root, "Collection")
    for name, instant in zip(names, time, strict=True):
        ET.SubElement(collection, "DataSet", timestep=f"{instant:.10g}", part="0", file=name)
    ET.indent(root)
    ET.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)
