"""From a mesh file or a table of sections to a blade that can be reduced."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from bladerub.blade.linear import MOST_UNKNOWNS
from bladerub.blade.mesh import BladeMesh, MeshedBlade, solid_mesh
from bladerub.blade.sources import element_quality, mesh_file, node_sets, section_blade, tip
from bladerub.blade.sources.origin import Source
from bladerub.blade.sources.section_profile import Profile
from bladerub.blade.surface import EDGES, boundary_faces
from bladerub.io.errors import BadInput


@dataclass(frozen=True)
class Imported:
    """A blade from a mesh file or a table of sections."""

    blade: MeshedBlade
    jacobian_ratio: np.ndarray = field(repr=False)  # (n_elements,), smallest over largest determinant
    volume: float  # m³
    chord: float  # length of the tip's camber line, m
    interface_offset: float  # largest distance of an interface node from its place on that line, m
    lean: float  # angle about the engine axis from the radial axis that was named to the blade's middle, rad
    is_raised: bool = False  # whether its elements were linear (see `bladerub.blade.sources.mesh_file.read`)
    n_unused: int = 0  # nodes of the file that no element uses, which were left out
    node_sets: dict[str, int] = field(default_factory=dict)  # number of nodes of each set of the file
    sections: list[Profile] = field(default_factory=list, repr=False)  # of a table, hub to tip


def import_blade(source: Source, counts: Mapping[str, int]) -> Imported:
    """Read the mesh of `source`, or mesh its sections with the numbers of elements `counts`.

    Raises a BadInput that names the file and what is wrong in it if it cannot be used as a blade.
    """
    try:
        return _import_sections(source, counts) if source.is_table else _import_mesh(source)
    except ValueError as error:
        raise BadInput(f"{source.file}: {error}") from error


def _import_mesh(source: Source) -> Imported:
    content = mesh_file.read(source.file)
    if 3 * len(content.points) > MOST_UNKNOWNS:
        raise ValueError(f"has {3 * len(content.points)} unknowns; must be {MOST_UNKNOWNS} or fewer")
    element_quality.check_nodes(content.points, content.cells)
    mesh, origin = solid_mesh(source.frame.metres(content.points), content.cells)
    ratio, volume = element_quality.jacobians(mesh)
    if np.hypot(mesh.points[:, 1], mesh.points[:, 2]).min() <= 0:
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
    return _measured(
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


def _nodes(content, points, faces, origin, name: str | None, is_tip: bool) -> np.ndarray:
    """Nodes of the mesh in the set `name` of the file, or found by the surface."""
    part = "tip" if is_tip else "root"
    try:
        if name is None:
            return node_sets.facing(points, faces, outwards=is_tip)
        named = _with_middles(content, node_sets.named(content.node_sets, name))
    except ValueError as error:
        raise ValueError(f"{part} not found: {error}") from error
    found = np.flatnonzero(np.isin(origin, named))
    if not found.size:
        raise ValueError(f'{part} not found: no node of the set "{name}" is in an element')
    return found


def _with_middles(content: mesh_file.MeshFile, nodes: np.ndarray) -> np.ndarray:
    """Add the mid-side nodes between two of `nodes` that linear elements got."""
    if not content.is_raised:
        return nodes
    ends = content.cells[:, EDGES[content.cells.shape[1]]]
    middles = content.cells[:, -ends.shape[1] :]
    return np.union1d(nodes, middles[np.isin(ends, nodes).all(axis=-1)])


def _import_sections(source: Source, counts: Mapping[str, int]) -> Imported:
    profiles = section_blade.read_profiles(source)
    shape = section_blade.SectionShape.through(profiles)
    mesh = BladeMesh.from_shape(shape, counts)
    try:
        ratio, volume = element_quality.jacobians(mesh.mesh)
    except ValueError as error:
        raise ValueError("between its sections the blade crosses itself; give more sections") from error
    evenly = shape.points(np.linspace(0, 1, mesh.interface.size), 0.5, 1.0).T
    offset = np.linalg.norm(mesh.mesh.points[mesh.interface] - evenly, axis=1).max()
    return _measured(
        mesh,
        source,
        jacobian_ratio=ratio,
        volume=volume,
        chord=profiles[-1].chord,
        interface_offset=float(offset),
        sections=profiles,
    )


def _measured(mesh: BladeMesh, source: Source, **known: Any) -> Imported:
    """Add to what is `known` of an `Imported` what both kinds of file have in common."""
    points = mesh.mesh.points
    radius = np.hypot(points[:, 1], points[:, 2])
    tip_cone = tip.cone(points[mesh.tip], source.tip_cone, source.frame.downstream_x)
    length = float(radius[mesh.tip].mean() - radius[mesh.root].mean())
    if length <= 0:
        raise ValueError(f"the tip is no farther from the engine axis than the root ({length:.3g} m)")
    source.frame.check_length(length)
    lean = float(np.arctan2(*points.mean(axis=0)[1:]))
    return Imported(MeshedBlade(mesh, tip_cone, length), lean=lean, **known)
