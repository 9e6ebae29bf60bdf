"""What to know of a blade from matrices before its study, and what to be wary of."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from bladerub.blade.build import BuiltBlade
from bladerub.blade.sources.matrices import ImportedMatrices
from bladerub.blade.sources.origin import MatrixSource
from bladerub.blade.sources.report import EQ2_ERROR, MODES, extents, of_errors, of_frame, of_reduction

DENSITIES = (10.0, 25e3)  # kg/m³ of the box around a blade, of which it fills some hundredths or all
HALF_WAY = (0.15, 0.35)  # centrifugal forces go with the square of the speed: a quarter


def report(source: MatrixSource, imported: ImportedMatrices, built: BuiltBlade) -> dict[str, Any]:
    """Figures of an imported and reduced blade, ready for JSON; SI units, warnings in words.

    As `bladerub.blade.sources.report.report`; ``error_eq2`` is none where the files are of no speeds but
    those of the fit, at which eq. (2) is exact.
    """
    layout = imported.blade.layout
    speeds = list(imported.blade.stiffness)
    figures = {
        "folder": str(source.folder),
        "nodes": len(layout.mesh.mesh.points),
        "unknowns": imported.blade.mass.shape[0],
        "clamped_nodes": int(layout.mesh.root.size),
        "tip_nodes": int(layout.mesh.tip.size),
        "interface": layout.mesh.mesh.points[layout.mesh.interface].tolist(),
        "extents": extents(layout.mesh.mesh.points),
        "length": layout.length,
        "length_is_measured": imported.is_rooted,
        "tip_cone_degrees": source.frame.downstream_x * float(np.rad2deg(layout.tip_cone)),
        "mass": imported.mass,
        "mass_is_whole": imported.mass_is_whole,
        "speeds": speeds,
        "omega_max": 2 * np.pi * float(built.frequency[0]) * speeds[-1],
        "stiffness_half_way": imported.half_way,
        **of_reduction(built),
    }
    warnings = list(_warnings(figures, imported, source))
    if len(speeds) == 3:
        figures["error_eq2"] = None
    return figures | {"warnings": warnings}


def _warnings(figures: dict[str, Any], imported: ImportedMatrices, source: MatrixSource) -> Iterator[str]:
    yield from of_frame(figures, source.frame, imported.lean)
    box = np.prod(np.ptp(imported.blade.layout.mesh.mesh.points, axis=0))
    if not DENSITIES[0] * box <= figures["mass"] <= DENSITIES[1] * box:
        yield (
            f"it weighs {figures['mass']:.3g} kg in a box of {1e6 * box:.3g} cm³: are the matrices in "
            f"{source.matrix_units}, and the nodes in {source.frame.unit}?"
        )
    if not imported.is_rooted:
        yield (
            f"no node is clamped in nodes.csv: its length is not known, its nodes reach over "
            f"{figures['length']:.4g} m; set blade.length"
        )
    if not HALF_WAY[0] <= figures["stiffness_half_way"] <= HALF_WAY[1]:
        yield (
            f"to stiffness_half the stiffness changes by {figures['stiffness_half_way']:.2g} of its change "
            "to stiffness_max, not by about a quarter: are the files of the speeds that they are named after?"
        )
    if len(figures["speeds"]) == 3:
        yield (
            "the files are of the three speeds of the fit only, where eq. (2) is exact: its error between "
            "them is not known; add stiffness_at_<f_omega>"
        )
    eq2 = max(figures["error_eq2"][:MODES])
    if eq2 > EQ2_ERROR:
        yield (
            f"eq. (2) is up to {100 * eq2:.2g} % off in the first {MODES} modes: lower reduction.f_omega_max"
        )
    yield from of_errors(figures)
