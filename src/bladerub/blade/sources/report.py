"""What to know of an imported blade before its study, and what to be wary of."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

from bladerub.blade.accuracy import errors_by_mode
from bladerub.blade.build import BuiltBlade
from bladerub.blade.elasticity import Material
from bladerub.blade.mesh import BladeMesh
from bladerub.blade.model import ReducedBlade
from bladerub.blade.refinement import MODES
from bladerub.blade.sources.frame import Frame
from bladerub.blade.sources.imported import Imported
from bladerub.blade.sources.origin import Source
from bladerub.blade.sources.section_profile import EDGE_SHARE, Profile
from bladerub.blade.surface import EDGES, NAMES

FREQUENCIES = (5.0, 20e3)  # Hz, of their first mode
BEHIND = 5.0  # degrees; less is a straight blade
COARSE = 10  # elements from root to tip
EQ2_ERROR = 0.01
REDUCED_ERROR = 0.02


def report(source: Source, imported: Imported, built: BuiltBlade, material: Material) -> dict[str, Any]:
    """Figures of an imported and reduced blade, ready for JSON; SI units, warnings in words.

    ``error_eq2`` and ``error_reduced_model`` hold for each mode the largest relative error of the frequency
    over the speeds of the accuracy table: that of eq. (2) alone, and with the reduction.
    """
    mesh = imported.blade.mesh
    moved = np.linalg.norm(built.static_displacement[-1], axis=1).max()
    figures = {
        "file": str(source.file),
        "element": NAMES[mesh.mesh.cells.shape[1]],
        "elements": len(mesh.mesh.cells),
        "nodes": len(mesh.mesh.points),
        "unknowns": 3 * (len(mesh.mesh.points) - mesh.root.size),
        "elements_root_to_tip": spanwise_elements(mesh),
        "node_sets": imported.node_sets,
        "root_nodes": int(mesh.root.size),
        "tip_nodes": int(mesh.tip.size),
        "extents": extents(mesh.mesh.points),
        "length": imported.blade.length,
        "tip_chord": imported.chord,
        "tip_cone_degrees": source.frame.downstream_x * float(np.rad2deg(imported.blade.tip_cone)),
        "interface_offset": imported.interface_offset,
        "volume": imported.volume,
        "mass": imported.volume * material.density,
        "worst_jacobian": float(imported.jacobian_ratio.min()),
        "centrifugal_displacement": float(moved),
        **of_reduction(built),
    }
    if imported.sections:
        figures["sections"] = [
            {
                "name": section.name,
                "mean_radius": section.radius,
                "chord": section.chord,
                "thickness": section.thickness,
                "cut_leading_edge": section.cut[0],
                "cut_trailing_edge": section.cut[1],
            }
            for section in imported.sections
        ]
    return figures | {"warnings": list(_warnings(figures, imported, source))}


def of_reduction(built: BuiltBlade) -> dict[str, Any]:
    """Figures of the frequencies and of the reduced model, of a blade from wherever."""
    table = built.accuracy
    errors = errors_by_mode(table)
    first = table[table["mode"] == 1].sort_values("f_omega").f_fe.to_numpy()
    return {
        "f1_hz": float(built.frequency[0]),
        "tip_stagger_degrees": _stagger(built.reduced),
        "campbell_ratio": float(first[-1] / first[0]),
        "f_omega_max": built.reduced.f_omega_max,
        "lowest_frequency": float(table.f_fe.min()),
        "reduced_coordinates": len(built.reduced.mass),
        "error_eq2": errors.speed_law.tolist(),
        "error_reduced_model": errors.reduced_model.tolist(),
    }


def _stagger(blade: ReducedBlade) -> float:
    """Angle (degrees) of the tip's chord to the axis, positive where its leading edge is ahead."""
    leading, trailing = blade.node_position[[0, -1]]
    across = (leading - trailing) @ blade.tangential_direction[[0, -1]].mean(axis=0)
    return float(np.rad2deg(np.arctan2(across, abs(leading[0] - trailing[0]))))


def spanwise_elements(mesh: BladeMesh) -> int:
    """Count the element edges on the shortest way from the root to the tip."""
    cells = mesh.mesh.cells
    edges = cells[:, EDGES[cells.shape[1]]].reshape(-1, 2)
    n_nodes = len(mesh.mesh.points)
    ways = sparse.coo_array((np.ones(len(edges)), tuple(edges.T)), shape=(n_nodes, n_nodes)).tocsr()
    ways.data[:] = 1
    steps = dijkstra(ways, directed=False, indices=mesh.root, unweighted=True, min_only=True)
    return int(steps[mesh.tip].min())


def extents(points: np.ndarray) -> dict[str, list[float]]:
    """Give the ends of the ranges of the coordinates and of the radius of `points` (n, 3), m."""
    radius = np.hypot(points[:, 1], points[:, 2])
    return {
        name: [float(values.min()), float(values.max())]
        for name, values in (
            ("x", points[:, 0]),
            ("y", points[:, 1]),
            ("z", points[:, 2]),
            ("radius", radius),
        )
    }


def _warnings(figures: dict[str, Any], imported: Imported, source: Source) -> Iterator[str]:
    yield from of_frame(figures, source.frame, imported.lean)
    if imported.is_raised:
        yield "its elements were linear; they got nodes in the middle of straight edges; faces stay faceted"
    if imported.n_unused:
        yield f"{imported.n_unused} nodes of the file are in no element and were left out"
    if figures["elements_root_to_tip"] < COARSE:
        yield (
            f"its mesh is coarse: {figures['elements_root_to_tip']} elements from root to tip; check that "
            "the frequencies hold with a finer one"
        )
    if figures["worst_jacobian"] < 0.1:
        yield (
            f"element {np.argmin(imported.jacobian_ratio) + 1} is badly shaped: its Jacobian varies by a "
            f"factor of {1 / figures['worst_jacobian']:.3g}"
        )
    yield from _of_edges(imported.sections)
    if figures["interface_offset"] > 0.03 * figures["tip_chord"]:
        yield (
            f"an interface node is {1e3 * figures['interface_offset']:.3g} mm from its place on the camber "
            "line of the tip: its mesh is coarse there"
        )
    eq2 = max(figures["error_eq2"][:MODES])
    if eq2 > EQ2_ERROR:
        yield (
            f"eq. (2) is up to {100 * eq2:.2g} % off in the first {MODES} modes: rotation moves the blade by "
            f"{1e3 * figures['centrifugal_displacement']:.3g} mm; give reduction.tolerance, or lower "
            "reduction.f_omega_max"
        )
    yield from of_errors(figures)


def _of_edges(sections: tuple[Profile, ...]) -> Iterator[str]:
    cut = [section for section in sections if max(section.cut) > 0]
    if cut:
        worst = max(cut, key=lambda section: max(section.cut) / section.chord)
        most = max(worst.cut)
        yield (
            f"edges of {len(cut)} of {len(sections)} sections were cut off where they are thinner than "
            f"{EDGE_SHARE:.0%} of the section: up to {1e3 * most:.3g} mm, {most / worst.chord:.2%} of the "
            f"chord (section {worst.name})"
        )


def of_frame(figures: dict[str, Any], frame: Frame, lean: float) -> Iterator[str]:
    """Warn of slips of unit and axes; the middle of the blade is `lean` (rad) off its radial axis."""
    if not FREQUENCIES[0] <= figures["f1_hz"] <= FREQUENCIES[1]:
        yield f"its first frequency is {figures['f1_hz']:.4g} Hz: are length and material in their units?"
    if abs(lean) > np.deg2rad(20):
        yield (
            f"its middle is {np.rad2deg(lean):.3g} degrees about the engine axis from the radial axis "
            f"{frame.radial}: is that axis, and is the origin on the engine axis?"
        )
    if figures["tip_stagger_degrees"] < -BEHIND:
        yield (
            f"the leading edge of the tip is behind its trailing edge in rotation, by a stagger of "
            f"{-figures['tip_stagger_degrees']:.3g} degrees; that of a compressor blade is ahead: has "
            f"rotation = {frame.rotation} or downstream = {frame.downstream} the wrong sign?"
        )


def of_errors(figures: dict[str, Any]) -> Iterator[str]:
    """Warn of a reduced model that does not follow, and of a blade that is unstable."""
    eq2, reduced = (max(figures[name][:MODES]) for name in ("error_eq2", "error_reduced_model"))
    if reduced > max(REDUCED_ERROR, 1.5 * eq2):
        yield (
            f"the reduced model is up to {100 * reduced:.2g} % off in the first {MODES} modes: give "
            "reduction.tolerance, or raise reduction.modes_per_speed"
        )
    if figures["lowest_frequency"] <= 0:
        yield "a mode is unstable within the range of speeds"
