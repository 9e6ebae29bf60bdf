"""From a file to a blade that can be reduced, with what is worth knowing of it before."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from bladerub.blade.linear import MOST_UNKNOWNS
from bladerub.blade.mesh import BladeMesh, MeshedBlade, solid_mesh
from bladerub.blade.sources import element_quality, mesh_file, node_sets, tip
from bladerub.blade.sources.origin import Source
from bladerub.blade.sources.section_profile import Profile
from bladerub.blade.surface import EDGES, boundary_faces
from bladerub.io.errors import BadInput


@dataclass(frozen=True)
class Imported:
    """A blade from a mesh file or a table of sections.

    Parameters
    ----------
    blade : MeshedBlade
        What the reduction needs.
    is_raised : bool
        Whether its elements were linear (see `bladerub.blade.sources.mesh_file.read`).
    n_unused : int
        Nodes of the file that no element uses, which were left out.
    node_sets : dict of str to int
        Names of the node sets of the file and how many nodes each has.
    jacobian_ratio : (n_elements,) ndarray
        Smallest over largest Jacobian determinant in each element.
    volume : float
        m³.
    chord, interface_offset : float
        Length of the tip's camber line, and how far an interface node is at most from its place there, m.
    lean : float
        Angle (rad) about the engine axis between the blade's middle and the radial axis that was named.
    sections : tuple of Profile
        Of a table, hub to tip; a mesh has none.
    """

    blade: MeshedBlade
    is_raised: bool
    n_unused: int
    node_sets: dict[str, int]
    jacobian_ratio: np.ndarray = field(repr=False)
    volume: float
    chord: float
    interface_offset: float
    lean: float
    sections: tuple[Profile, ...] = field(default=(), repr=False)


def import_mesh(source: Source) -> Imported:
    """Read the mesh of `source` and find root, tip and interface nodes on it.

    Raises
    ------
    BadInput
        If the file cannot be used as a blade; the message names the file and the culprit.
    """
    try:
        return _import(mesh_file.read(source.file), source)
    except ValueError as error:
        raise BadInput(f"{source.file}: {error}") from error


def _import(content: mesh_file.MeshFile, source: Source) -> Imported:
    if 3 * len(content.points) > MOST_UNKNOWNS:
        raise ValueError(f"has {3 * len(content.points)} unknowns; must be {MOST_UNKNOWNS} or fewer")
    element_quality.check_nodes(content.points, content.cells)
    mesh, origin = solid_mesh(source.frame.metres(content.points), content.cells)
    ratio, volume = element_quality.jacobians(mesh)
    radius = np.hypot(mesh.points[:, 1], mesh.points[:, 2])
    if radius.min() <= 0:
        raise ValueError(
            f"a node lies on the engine axis, through the origin of the file and along rotation = "
            f"{source.frame.rotation}: is that the engine axis?"
        )
    faces = boundary_faces(mesh.cells)
    root = _nodes(content, mesh.points, faces, origin, source.root_set, is_tip=False)
    tip_nodes = _nodes(content, mesh.points, faces, origin, source.tip_set, is_tip=True)
    if np.isin(tip_nodes, root).any():
        raise ValueError("root and tip share nodes; name other node sets")
    tip_faces = faces[np.isin(faces, tip_nodes).all(axis=1)]
    if not len(tip_faces):
        raise ValueError(f'tip not found: no face of the surface has all its nodes in "{source.tip_set}"')
    chosen = tip.interface(mesh.points, tip_faces, source.frame.downstream_x)
    return described(
        BladeMesh(mesh, root, tip_nodes, chosen.nodes),
        source,
        is_raised=content.is_raised,
        n_unused=len(content.points) - origin.size,
        node_sets={name: nodes.size for name, nodes in content.node_sets.items()},
        jacobian_ratio=ratio,
        volume=volume,
        chord=chosen.chord,
        interface_offset=chosen.offset,
    )


def described(blade: BladeMesh, source: Source, **known: Any) -> Imported:
    """Measure what else an `Imported` holds of `blade`, next to what is `known`.

    Raises
    ------
    ValueError
        If its tip is not above its root.
    """
    points = blade.mesh.points
    radius = np.hypot(points[:, 1], points[:, 2])
    tip_cone = tip.cone(points[blade.tip], source.tip_cone, source.frame.downstream_x)
    length = float(radius[blade.tip].mean() - radius[blade.root].mean())
    if length <= 0:
        raise ValueError(f"the tip is no farther from the engine axis than the root ({length:.3g} m)")
    source.frame.check_length(length)
    middle = points.mean(axis=0)
    lean = float(np.arctan2(middle[1], middle[2]))
    return Imported(MeshedBlade(blade, tip_cone, length), lean=lean, **known)


def _nodes(content, points, faces, origin, name: str | None, is_tip: bool) -> np.ndarray:
    """Nodes of the mesh in the set `name` of the file, or found by the surface."""
    part = "tip" if is_tip else "root"
    try:
        if name is None:
            return node_sets.facing(points, faces, outwards=is_tip)
        found = np.flatnonzero(
            np.isin(origin, _with_middles(content, node_sets.named(content.node_sets, name)))
        )
    except ValueError as error:
        raise ValueError(f"{part} not found: {error}") from error
    if not found.size:
        raise ValueError(f'{part} not found: no node of the set "{name}" is in an element')
    return found


def _with_middles(content: mesh_file.MeshFile, nodes: np.ndarray) -> np.ndarray:
    """Add the nodes that raising put between two of `nodes`."""
    if not content.is_raised:
        return nodes
    ends = content.cells[:, EDGES[content.cells.shape[1]]]
    middles = content.cells[:, -ends.shape[1] :]
    return np.union1d(nodes, middles[np.isin(ends, nodes).all(axis=-1)])
