"""The figures of an imported blade, and warnings of what is probably wrong with it."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import scipy
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

from bladerub.blade.built import BuiltBlade
from bladerub.blade.frequencies import doubts, reduced_frequencies, tip_lean
from bladerub.blade.mesh import BladeMesh, MeshedBlade
from bladerub.blade.model import ReducedBlade
from bladerub.extras.blade_doubts import errors_by_mode
from bladerub.extras.blade_meshes import EDGES, NAMES
from bladerub.extras.blades import origin
from bladerub.extras.blades.importing import Imported
from bladerub.extras.blades.matrices import ImportedMatrices
from bladerub.extras.blades.sections import EDGE_SHARE
from bladerub.extras.blades.settings import Source
from bladerub.settings.blade import Material

ORDERS = range(1, 13)  # engine orders whose crossings with the first frequency are stated
FREQUENCIES = (5.0, 20e3)  # Hz, of the first mode
LARGEST_LEAN = 20.0  # degrees
LEAST_STAGGER = -5.0  # degrees; above, the blade is nearly straight
FEWEST_ELEMENTS = 10  # from root to tip
LEAST_JACOBIAN_RATIO = 0.1
LARGEST_OFFSET = 0.03  # of an interface node, over the chord
DENSITIES = (10.0, 25e3)  # kg/m³ of the box around a blade, of which it fills some hundredths or all
WAVE_SPEEDS = (500.0, 30e3)  # m/s in a material, from plastics to carbon fibres, with room for the estimate
ASPECTS = (1 / 3, 15.0)  # length over the chord of the tip
HUB_RATIOS = (0.1, 0.98)  # radius of the root over that of the tip
LARGEST_TIP_SPEED = 800.0  # m/s; wheels burst
HALF_SPEED_CHANGE = (0.15, 0.35)  # a quarter, as centrifugal forces grow with the square of the speed


def mesh_report(
    source: Source, imported: Imported, built: BuiltBlade, material: Material, nominal: float | None = None
) -> dict[str, Any]:
    """Figures of a blade from a mesh or sections, and warnings, ready for JSON; SI units.

    The `nominal` speed is that of its rotor, 1/min, if it is known: a wheel bears it. ``error_eq2`` and
    ``error_reduced_model`` hold for each mode the largest relative error of the frequency over the speeds of
    the accuracy table: that of eq. (2) alone, and with the reduction.
    """
    mesh = imported.blade.mesh
    figures = {
        "file": str(origin.path(source)),
        "element": NAMES[mesh.mesh.cells.shape[1]],
        "elements": len(mesh.mesh.cells),
        **_of_blade(source, imported.blade, built, nominal),
        "elements_root_to_tip": spanwise_elements(mesh),
        "node_sets": imported.node_sets,
        "root_nodes": int(mesh.root.size),
        "tip_chord": imported.chord,
        "interface_offset": imported.interface_offset,
        "volume": imported.volume,
        "mass": imported.volume * material.density,
        "worst_jacobian": float(imported.jacobian_ratio.min()),
        "centrifugal_displacement": float(np.linalg.norm(built.static_displacement[-1], axis=1).max()),
    }
    if imported.sections:
        names = ("name", "mean_radius", "chord", "thickness", "cut_leading_edge", "cut_trailing_edge")
        rows = ((name, *sizes, *cut) for name, _, *sizes, cut in imported.sections)
        figures["sections"] = [dict(zip(names, row, strict=True)) for row in rows]
    warnings = [*_warn_of_mesh(figures, imported, source), *doubts(built.accuracy, nominal)]
    return figures | {"warnings": warnings}


def matrix_report(
    source: Source, imported: ImportedMatrices, built: BuiltBlade, nominal: float | None = None
) -> dict[str, Any]:
    """Figures and warnings, as `mesh_report`, of matrices; no ``error_eq2`` if all are at fit speeds."""
    layout = imported.blade.layout
    points = layout.mesh.mesh.points
    speeds = list(imported.blade.stiffness)
    figures = {
        "folder": str(origin.path(source)),
        **_of_blade(source, layout, built, nominal),
        "clamped_nodes": int(layout.mesh.root.size),
        "interface": points[layout.mesh.interface].tolist(),
        "length_is_measured": imported.is_rooted,
        "mass": imported.mass,
        "mass_is_whole": imported.mass_is_complete,
        "speeds": speeds,
        "omega_max": 2 * np.pi * float(built.frequency[0]) * speeds[-1],
        "wave_speed": imported.wave_speed,
        "stiffness_half_way": imported.half_speed_change,
    }
    warnings = [*_warn_of_matrices(figures, imported, source), *doubts(built.accuracy, nominal)]
    if len(speeds) == 3:
        figures["error_eq2"] = None
    return figures | {"warnings": warnings}


def _of_blade(source: Source, layout: MeshedBlade, built: BuiltBlade, nominal: float | None) -> dict:
    """Figures of the nodes, of the frequencies and of the reduced model."""
    points, table = layout.mesh.mesh.points, built.accuracy
    errors = errors_by_mode(table)
    first = table[table["mode"] == 1].sort_values("f_omega").f_fe.to_numpy()
    rpm = 60 * built.reduced.f1_hz
    leading, trailing = built.reduced.node_position[[0, -1]]
    across = (leading - trailing) @ built.reduced.tangential_direction[[0, -1]].mean(axis=0)
    extents = dict(zip("xyz", points.T, strict=True)) | {"radius": np.hypot(points[:, 1], points[:, 2])}
    return {
        "nodes": len(points),
        "unknowns": 3 * (len(points) - layout.mesh.root.size),
        "tip_nodes": int(layout.mesh.tip.size),
        "extents": {name: [float(value.min()), float(value.max())] for name, value in extents.items()},
        "length": layout.length,
        "tip_cone_degrees": origin.frame(source).downstream_x * float(np.rad2deg(layout.tip_cone)),
        "f1_hz": float(built.frequency[0]),
        # of the tip's chord to the axis, positive where its leading edge is ahead
        "tip_stagger_degrees": float(np.rad2deg(np.arctan2(across, abs(leading[0] - trailing[0])))),
        "tip_lean": tip_lean(built.reduced).tolist(),
        "crossings": [
            {"order": order, "f_omega": x, "rpm": x * rpm} for order, x in _crossings(built.reduced)
        ],
        "nominal_speed": nominal,
        "nominal_f_omega": nominal and nominal / rpm,
        "campbell_ratio": float(first[-1] / first[0]),
        "f_omega_max": built.reduced.f_omega_max,
        "lowest_frequency": float(table.f_fe.min()),
        "reduced_coordinates": len(built.reduced.mass),
        "error_eq2": errors.speed_law.tolist(),
        "error_reduced_model": errors.reduced_model.tolist(),
    }


def spanwise_elements(mesh: BladeMesh) -> int:
    """Count the element edges on the shortest path from the root to the tip."""
    cells = mesh.mesh.cells
    edges = cells[:, EDGES[cells.shape[1]]].reshape(-1, 2)
    n_nodes = len(mesh.mesh.points)
    graph = sparse.coo_array((np.ones(len(edges)), tuple(edges.T)), shape=(n_nodes, n_nodes)).tocsr()
    steps = dijkstra(graph, directed=False, indices=mesh.root, unweighted=True, min_only=True)
    return int(steps[mesh.tip].min())


def _warn_of_frame(figures: dict[str, Any], source: Source, points: np.ndarray) -> Iterator[str]:
    """Warn of a wrong unit or wrong axes by the figures of a blade and its nodes (n, 3)."""
    frame, stagger = origin.frame(source), figures["tip_stagger_degrees"]
    lean = np.rad2deg(np.arctan2(*points.mean(axis=0)[1:]))
    if not FREQUENCIES[0] <= figures["f1_hz"] <= FREQUENCIES[1]:
        yield f"its first frequency is {figures['f1_hz']:.4g} Hz: are length and material in their units?"
    if abs(lean) > LARGEST_LEAN:
        place = f"{lean:.3g} degrees about the engine axis from the radial axis {frame.radial}"
        yield f"its middle is {place}: is that the right axis, and is the origin on the engine axis?"
    if stagger < LEAST_STAGGER:
        doubt = f"has rotation = {frame.rotation} or downstream = {frame.downstream} the wrong sign?"
        lag = f"{-stagger:.3g} degrees behind its trailing edge in rotation"
        yield f"the leading edge of the tip is {lag}: {doubt}"


def _warn_of_mesh(figures: dict[str, Any], imported: Imported, source: Source) -> Iterator[str]:
    yield from _warn_of_frame(figures, source, imported.blade.mesh.mesh.points)

    # what no blade is like: a length or an angle is in another unit than the rest
    length, chord = figures["length"], figures["tip_chord"]
    root, tip = figures["extents"]["radius"]
    if not ASPECTS[0] <= length / chord <= ASPECTS[1]:
        size = f"{1e3 * length:.3g} mm long with a chord of {1e3 * chord:.3g} mm at the tip"
        yield f"it is {size}: are all lengths in one unit?"
    if not HUB_RATIOS[0] <= root / tip <= HUB_RATIOS[1]:
        radii = f"from {1e3 * root:.3g} to {1e3 * tip:.3g} mm from the engine axis"
        yield f"it reaches {radii}: are all lengths in one unit, and is the origin on the engine axis?"
    fastest, nominal = figures["f_omega_max"], figures["nominal_speed"] or 0.0
    for frequency, state, doubt in (  # of rotation, Hz
        (figures["f1_hz"] * fastest, f"reduction.f_omega_max = {fastest:g}", "radius"),
        (nominal / 60, f"{nominal:g} 1/min with a radius of {1e3 * tip:.3g} mm", "unit"),
    ):
        speed = 2 * np.pi * frequency * tip
        if speed > LARGEST_TIP_SPEED:
            cause = f"its tip moves at {speed:.0f} m/s at {state}, more than a wheel bears"
            yield f"{cause}: is its {doubt} right?"

    n_elements, offset = figures["elements_root_to_tip"], figures["interface_offset"]
    if imported.is_raised:
        yield "its elements were linear: they got mid-side nodes, but curved faces stay faceted"
    if imported.n_unused:
        yield f"{imported.n_unused} nodes of the file belong to no element and were left out"
    if n_elements < FEWEST_ELEMENTS:
        yield f"its mesh is coarse, with {n_elements} elements from root to tip: compare with a finer mesh"
    if (ratio := figures["worst_jacobian"]) < LEAST_JACOBIAN_RATIO:
        worst = np.argmin(imported.jacobian_ratio) + 1
        yield f"element {worst} is badly shaped: its Jacobian varies by a factor of {1 / ratio:.3g}"
    cut = [section for section in imported.sections if max(section.cut) > 0]
    if cut:
        share, name = max((max(section.cut) / section.chord, section.name) for section in cut)
        thin = f"where they are thinner than {EDGE_SHARE:.0%} of the section"
        extent = f"up to {share:.2%} of the chord (section {name})"
        yield f"edges of {len(cut)} of {len(imported.sections)} sections were cut off {thin}: {extent}"
    if offset > LARGEST_OFFSET * figures["tip_chord"]:
        yield f"an interface node is {1e3 * offset:.3g} mm from its place on the camber line of the tip"


def _warn_of_matrices(figures: dict[str, Any], imported: ImportedMatrices, source: Source) -> Iterator[str]:
    points = imported.blade.layout.mesh.mesh.points
    yield from _warn_of_frame(figures, source, points)
    box = np.prod(np.ptp(points, axis=0))
    if not DENSITIES[0] * box <= figures["mass"] <= DENSITIES[1] * box:
        units = f"the matrices in {source.matrix_units or 'SI'}, and the nodes in {origin.frame(source).unit}"
        yield f"its mass is {figures['mass']:.3g} kg in a box of {1e6 * box:.3g} cm³: are {units}?"
    if not WAVE_SPEEDS[0] <= imported.wave_speed <= WAVE_SPEEDS[1]:
        fault = f"waves in its material would have {imported.wave_speed:.3g} m/s, in metals 4000 to 6500"
        yield f"{fault}: are mass, stiffness and nodes in units that go together?"
    if not imported.is_rooted:
        yield f"no node is clamped in nodes.csv: set blade.length (all reach over {figures['length']:.4g} m)"
    if not HALF_SPEED_CHANGE[0] <= imported.half_speed_change <= HALF_SPEED_CHANGE[1]:
        share = f"{imported.half_speed_change:.2g} of the change from stiffness_rest to stiffness_max"
        doubt = "do the names of the files state their speeds?"
        yield f"stiffness_half shows {share}, not about a quarter: {doubt}"
    if len(figures["speeds"]) == 3:
        yield "the error of eq. (2) is not known at the three speeds of its fit: add stiffness_at_<f_omega>"


def _crossings(blade: ReducedBlade) -> Iterator[tuple[int, float]]:
    """Find the normalised speeds at which `ORDERS` cross the first frequency up to ``f_omega_max``."""

    def above(f_omega: float, order: int) -> float:
        return order * f_omega - float(reduced_frequencies(blade, f_omega, 1)[0]) / blade.f1_hz

    fastest = blade.f_omega_max
    for order in ORDERS:
        if above(fastest, order) >= 0:
            yield order, float(scipy.optimize.brentq(above, 0.0, fastest, args=(order,), xtol=1e-9))
