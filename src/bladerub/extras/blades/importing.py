"""From a mesh file or a table of sections to a blade that can be reduced."""

from dataclasses import dataclass, field

import numpy as np

from bladerub.blade.linear import MOST_UNKNOWNS
from bladerub.blade.mesh import BladeMesh, MeshedBlade
from bladerub.blade.model import N_INTERFACE
from bladerub.blade.surface import boundary_faces, normals
from bladerub.extras.blade_meshes import EDGES, solid_mesh
from bladerub.extras.blades import element_quality, mesh_file, origin, profile, section_blade
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.section_profile import Profile
from bladerub.extras.blades.settings import Source
from bladerub.settings.blade import Mesh

_FACING = np.cos(np.pi / 4)


@dataclass(frozen=True)
class Imported:
    """A blade from a mesh file or a table of sections."""

    blade: MeshedBlade
    jacobian_ratio: np.ndarray = field(repr=False)  # (n_elements,), smallest over largest determinant
    volume: float  # m³
    chord: float  # length of the tip's camber line, m
    interface_offset: float  # largest distance of an interface node from its place on that line, m
    is_raised: bool = False  # whether its elements were linear (see `bladerub.extras.blades.mesh_file.read`)
    n_unused: int = 0  # nodes of the file that no element uses, which were left out
    node_sets: dict[str, int] = field(default_factory=dict)  # number of nodes of each set of the file
    sections: list[Profile] = field(default_factory=list, repr=False)  # of a table, hub to tip


def import_blade(source: Source, counts: Mesh, n_interface: int = N_INTERFACE) -> Imported:
    """Read a mesh, or mesh sections by the numbers of elements `counts`; a BadInput says what is wrong.

    The tip gets `n_interface` interface nodes.
    """
    with origin.naming(origin.path(source)):
        if origin.is_table(source):
            return _import_sections(source, counts, n_interface)
        return _import_mesh(source, n_interface)


def _import_mesh(source: Source, n_interface: int) -> Imported:
    content, frame = mesh_file.read(origin.path(source)), origin.frame(source)
    if 3 * len(content.points) > MOST_UNKNOWNS:
        raise ValueError(f"has {3 * len(content.points)} unknowns; must be {MOST_UNKNOWNS} or fewer")
    element_quality.check_joined(content.cells)
    element_quality.check_nodes(content.points, content.cells)
    mesh, places = solid_mesh(frame.metres(content.points), content.cells)
    ratio, volume = element_quality.jacobians(mesh)
    if np.hypot(mesh.points[:, 1], mesh.points[:, 2]).min() <= 0:
        raise ValueError(f"a node lies on the engine axis: is it rotation = {frame.rotation}?")
    faces = boundary_faces(mesh.cells)
    root = _nodes(content, mesh.points, faces, places, source.root_set, is_tip=False)
    tip_nodes = _nodes(content, mesh.points, faces, places, source.tip_set, is_tip=True)
    if np.isin(tip_nodes, root).any():
        raise ValueError("root and tip share nodes; name other node sets")
    tip_faces = faces[np.isin(faces, tip_nodes).all(axis=1)]
    if not len(tip_faces):
        raise ValueError(f'tip not found: no face of the surface has all its nodes in "{source.tip_set}"')
    interface, chord, offset = profile.interface(mesh.points, tip_faces, frame.downstream_x, n_interface)
    blade = measured(BladeMesh(mesh, root, tip_nodes, interface), frame, source.tip_cone)
    n_unused = len(content.points) - places.size
    node_sets = {name: nodes.size for name, nodes in content.node_sets.items()}
    return Imported(blade, ratio, volume, chord, offset, content.is_raised, n_unused, node_sets)


def _nodes(content, points, faces, places, name: str | None, is_tip: bool) -> np.ndarray:
    """Nodes of the mesh in the set `name` of the file, or found by the surface."""
    try:
        if name is None:
            return facing(points, faces, outwards=is_tip)
        nodes = np.flatnonzero(np.isin(places, _with_middles(content, _named(content, name))))
        if not nodes.size:
            raise ValueError(f'the set "{name}" has no node of an element (a set of other sets is not read)')
    except ValueError as error:
        raise ValueError(f"{'tip' if is_tip else 'root'} not found: {error}") from error
    return nodes


def _named(content: mesh_file.MeshFile, name: str) -> np.ndarray:
    """Nodes of the set `name`, in capital or small letters unless another set differs in them only."""
    node_sets = content.node_sets
    alike = [name] if name in node_sets else [key for key in node_sets if key.lower() == name.lower()]
    if len(alike) == 1:
        return node_sets[alike[0]]
    if name in content.volume_sets:
        raise ValueError(f'"{name}" is a set of volume elements; must be of nodes, points, lines or surfaces')
    raise ValueError(f'there is no node set "{name}"; there are {", ".join(node_sets) or "none"}')


def facing(points: np.ndarray, faces: np.ndarray, outwards: bool) -> np.ndarray:
    """Nodes of the part of the surface that is farthest from the engine axis and faces `outwards`: the tip.

    If not `outwards`, the part nearest to the axis that faces inwards: the root. Its normals are within 45
    degrees of the radial direction, and its `faces` are connected: it may be a cylinder, a cone or a plane,
    but ends at its edges. Raises a ValueError if there is none.
    """
    sign = 1 if outwards else -1
    middle = points[faces].mean(axis=1)
    radius = np.hypot(middle[:, 1], middle[:, 2])
    radial = normals(points[faces])[:, 1:] * middle[:, 1:]
    facing_so = faces[sign * radial.sum(axis=1) > _FACING * radius]
    if not len(facing_so):
        raise ValueError(
            "no part of the surface faces along the radius; do the axes of the blade agree "
            "with rotation, downstream and radial? Or name a node set"
        )
    part = element_quality.connected(facing_so)
    height = (sign * np.hypot(points[:, 1], points[:, 2]))[facing_so].max(axis=1)
    return np.unique(facing_so[part == part[np.argmax(height)]])


def _with_middles(content: mesh_file.MeshFile, nodes: np.ndarray) -> np.ndarray:
    """Add the mid-side nodes between two of `nodes` that linear elements got."""
    if not content.is_raised:
        return nodes
    ends = content.cells[:, EDGES[content.cells.shape[1]]]
    middles = content.cells[:, -ends.shape[1] :]
    return np.union1d(nodes, middles[np.isin(ends, nodes).all(axis=-1)])


def _import_sections(source: Source, counts: Mesh, n_interface: int) -> Imported:
    profiles = section_blade.read_profiles(source)
    shape = section_blade.SectionShape(profiles)
    mesh = BladeMesh.from_shape(shape, counts, n_interface)
    try:
        ratio, volume = element_quality.jacobians(mesh.mesh)
    except ValueError as error:
        raise ValueError("between its sections the blade crosses itself; give more sections") from error
    evenly = shape.points(np.linspace(0, 1, mesh.interface.size), 0.5, 1.0).T
    offset = np.linalg.norm(mesh.mesh.points[mesh.interface] - evenly, axis=1).max()
    chord = profiles[-1].chord
    blade = measured(mesh, origin.frame(source), source.tip_cone)
    return Imported(blade, ratio, volume, chord, float(offset), sections=profiles)


def measured(mesh: BladeMesh, frame: Frame, tip_cone: float | None) -> MeshedBlade:
    """Measure the length of the blade and, if it is not given in degrees, the cone of its tip.

    A ValueError says if the length is none of a blade. It is that from the clamped nodes to the tip or, where
    no node is clamped, the range of the radii.
    """
    cone = profile.cone(mesh.mesh.points[mesh.tip], tip_cone, frame.downstream_x)
    blade = MeshedBlade(mesh, cone)
    if mesh.root.size:
        if blade.length <= 0:
            raise ValueError(
                f"the tip is no farther from the engine axis than the root ({blade.length:.3g} m)"
            )
        frame.check_length(blade.length)
    return blade
