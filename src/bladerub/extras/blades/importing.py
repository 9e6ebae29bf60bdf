"""From a mesh file or a table of sections to a blade that can be reduced, and blades kept for their study."""

from contextlib import suppress
from typing import NamedTuple

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from bladerub.blade import built
from bladerub.blade.built import BuiltBlade
from bladerub.blade.cache import kept_at
from bladerub.blade.files import is_built
from bladerub.blade.linear import MOST_UNKNOWNS
from bladerub.blade.mesh import BladeMesh, MeshedBlade, SolidMesh
from bladerub.blade.model import N_INTERFACE
from bladerub.blade.surface import boundary_faces, normals
from bladerub.extras.blade_meshes import EDGES, read_built, solid_mesh
from bladerub.extras.blades import mesh_file, origin, profile, sections
from bladerub.extras.blades.sections import Profile
from bladerub.extras.blades.settings import Source
from bladerub.io.provenance import provenance
from bladerub.settings.blade import Mesh
from bladerub.settings.study import Config

_FACING = np.cos(np.pi / 4)
_SAME_PLACE = 1e-7  # of the extent of the mesh
_FLAT = 1e-12  # Jacobian, over the cube of the size of the element
_MOST_OFF = 0.35  # of the edge; the middle of a quarter of a circle is 0.21 off its chord


class Imported(NamedTuple):
    """A blade from a mesh file or a table of sections."""

    blade: MeshedBlade
    jacobian_ratio: np.ndarray  # (n_elements,), smallest over largest determinant
    volume: float  # m³
    chord: float  # length of the tip's camber line, m
    interface_offset: float  # largest distance of an interface node from its place on that line, m
    is_raised: bool  # whether its elements were linear (see `bladerub.extras.blades.mesh_file.read`)
    n_unused: int  # nodes of the file that no element uses, which were left out
    node_sets: dict[str, int]  # number of nodes of each set of the file
    sections: list[Profile]  # of a table, hub to tip


def import_blade(source: Source, counts: Mesh, n_interface: int = N_INTERFACE) -> Imported:
    """Read a mesh, or mesh sections by the numbers of elements `counts`; a BadInput says what is wrong."""
    with origin.naming(origin.path(source)):
        if origin.is_table(source):
            return _import_sections(source, counts, n_interface)
        return _import_mesh(source, n_interface)


def keep(blade: BuiltBlade, config: Config) -> None:
    """Keep the blade of `config` in the cache of this user for its study, unless it cannot be written."""
    with suppress(OSError):
        built.write(blade, provenance(config.plain()), kept_at(config))


def kept(config: Config) -> BuiltBlade | None:
    """Read the blade of `config` as it is kept; None if it is not, or damaged. Raises as `kept_at`."""
    with suppress(OSError):
        path = kept_at(config)
        if is_built(config, path):
            return read_built(path)
    return None


def _import_mesh(source: Source, n_interface: int) -> Imported:
    content, frame = mesh_file.read(origin.path(source)), origin.frame(source)
    if 3 * len(content.points) > MOST_UNKNOWNS:
        raise ValueError(f"has {3 * len(content.points)} unknowns; must be {MOST_UNKNOWNS} or fewer")
    check_joined(content.cells)
    check_nodes(content.points, content.cells)
    mesh, places = solid_mesh(frame.metres(content.points), content.cells)
    ratio, volume = jacobians(mesh)
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
    return Imported(blade, ratio, volume, chord, offset, content.is_raised, n_unused, node_sets, [])


def check_joined(cells: np.ndarray) -> None:
    """Check that `cells` are one body of elements whose nodes differ; a ValueError says if they are not."""
    ordered = np.sort(cells, axis=1)
    collapsed = np.flatnonzero((np.diff(ordered, axis=1) == 0).any(axis=1))
    if collapsed.size:
        raise ValueError(
            f"element {collapsed[0] + 1}: has a node twice ({collapsed.size} such of {len(cells)}); wedges "
            "written as hexahedra must be split into tetrahedra, and all others too"
        )
    sizes = np.unique(connected(cells), return_counts=True)[1]
    if sizes.size > 1:
        fault = f"has {sizes.size} bodies that share no nodes, of {', '.join(map(str, sizes[:4]))} elements"
        rule = "must be one blade: merge nodes where they touch, or leave the others out"
        raise ValueError(f"{fault}; {rule}")


def connected(cells: np.ndarray) -> np.ndarray:
    """Find the number (n,) of the body that each element or face of the nodes `cells` (n, m) is part of."""
    first = np.repeat(cells[:, 0], cells.shape[1])
    joined = sparse.coo_array((np.ones(first.size), (first, cells.ravel())), shape=2 * [cells.max() + 1])
    return connected_components(joined, directed=False)[1][cells[:, 0]]


def check_nodes(points: np.ndarray, cells: np.ndarray) -> None:
    """Check that the nodes of `cells` are apart, and mid-side ones in the middle; a ValueError names one."""
    used = np.unique(cells)
    outliers = used[~(abs(points[used]) <= origin.FARTHEST).all(axis=1)]
    if outliers.size:
        place, limit = ", ".join(f"{x:.4g}" for x in points[outliers[0]]), f"{origin.FARTHEST:g}"
        raise ValueError(f"node {outliers[0] + 1}: is at {place}; must be finite numbers up to {limit}")
    extent = np.ptp(points[used], axis=0).max()
    twins = cKDTree(points[used]).query_pairs(_SAME_PLACE * extent, output_type="ndarray")
    if len(twins):
        first, second = np.sort(used[twins[0]]) + 1
        raise ValueError(f"nodes {first} and {second}: are in one place; merge them ({len(twins)} pairs)")
    ends = points[cells[:, EDGES[cells.shape[1]]]]
    sides = points[cells[:, -ends.shape[1] :]]
    off = np.linalg.norm(sides - ends.mean(axis=2), axis=-1)
    misplaced = np.argwhere(off > _MOST_OFF * np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=-1))
    if len(misplaced):
        element, edge = misplaced[0]
        number = cells.shape[1] - ends.shape[1] + edge + 1
        fault = f"element {element + 1}: its {number}th node is not in the middle of its edge"
        raise ValueError(f"{fault}; nodes must be in the order of CalculiX and VTK")


def jacobians(mesh: SolidMesh) -> tuple[np.ndarray, float]:
    """Smallest over largest Jacobian of each element (n_elements,), or a ValueError, and the volume, m³."""
    points, weights = mesh.mass_quadrature()
    determinant = np.linalg.det(np.moveaxis(mesh.mapping().DF(points), (0, 1), (-2, -1)))
    if (determinant < 0).all():
        raise ValueError("all elements are left-handed; the mesh must not be mirrored, nor count backwards")
    flat = _FLAT * np.ptp(mesh.points[mesh.cells], axis=1).max(axis=1, keepdims=True) ** 3
    bad = np.flatnonzero((determinant <= flat).any(axis=1))
    if bad.size:
        fault = "its Jacobian is zero or negative, it is flat or turned inside out"
        raise ValueError(f"element {bad[0] + 1}: {fault} ({bad.size} such of {len(determinant)})")
    return determinant.min(axis=1) / determinant.max(axis=1), float(np.sum(determinant @ weights))


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
    part = connected(facing_so)
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
    profiles = sections.read_profiles(source)
    shape = sections.SectionShape(profiles)
    mesh = BladeMesh.from_shape(shape, counts, n_interface)
    try:
        ratio, volume = jacobians(mesh.mesh)
    except ValueError as error:
        raise ValueError("between its sections the blade crosses itself; give more sections") from error
    evenly = shape.points(np.linspace(0, 1, mesh.interface.size), 0.5, 1.0).T
    offset = float(np.linalg.norm(mesh.mesh.points[mesh.interface] - evenly, axis=1).max())
    blade = measured(mesh, origin.frame(source), source.tip_cone)
    return Imported(blade, ratio, volume, profiles[-1].chord, offset, False, 0, {}, profiles)


def measured(mesh: BladeMesh, frame: origin.Frame, tip_cone: float | None) -> MeshedBlade:
    """Measure length (without clamped nodes the range of radii) and tip cone; ValueError for no blade."""
    blade = MeshedBlade(mesh, profile.cone(mesh.mesh.points[mesh.tip], tip_cone, frame.downstream_x))
    if mesh.root.size:
        if (length := blade.length) <= 0:
            raise ValueError(f"the tip is no farther from the engine axis than the root ({length:.3g} m)")
        frame.check_length(blade.length)
    return blade
