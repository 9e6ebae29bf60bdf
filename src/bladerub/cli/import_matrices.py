"""The part of ``bladerub import`` that looks at a folder of matrices."""

from __future__ import annotations

from typing import Any

from bladerub.blade.model import ReducedBlade
from bladerub.blade.sources.origin import MatrixSource


def look(source: MatrixSource, config: dict[str, Any]) -> tuple[dict[str, Any], ReducedBlade]:
    """Import and reduce the matrices of `source`; return the figures and the reduced blade.

    Raises
    ------
    BadInput
        If the folder cannot be used as a blade.
    """
    from bladerub.blade.build import reduce_given
    from bladerub.blade.sources.matrices import import_matrices
    from bladerub.blade.sources.report import matrix_report

    reduction = config["reduction"]
    imported = import_matrices(
        source, reduction["f_omega_max"], reduction["accuracy_modes"], reduction["modes_per_speed"]
    )
    built = reduce_given(imported.blade, config)
    return matrix_report(source, imported, built), built.reduced


def in_words(figures: dict[str, Any]) -> list[str]:
    """Say what the figures are, a line each."""
    millimetres = {name: [1e3 * end for end in ends] for name, ends in figures["extents"].items()}
    measured = "" if figures["length_is_measured"] else " that its nodes reach over"
    whole = "" if figures["mass_is_whole"] else " without that of the clamped nodes, whose rows are not there"
    first, last = (figures["interface"][at] for at in (0, -1))
    speeds = ", ".join(f"{speed:g}" for speed in figures["speeds"])
    rom = max(figures["error_reduced_model"][:6])
    if figures["error_eq2"] is None:
        eq2 = "eq. (2) is exact at the speeds of the files"
    else:
        eq2 = f"eq. (2) is up to {100 * max(figures['error_eq2'][:6]):.2g} % off"
    return [
        f"matrices            {figures['nodes']} nodes, {figures['unknowns']} unknowns",
        *(f"{name:<19} {low:.4g} to {high:.4g} mm" for name, (low, high) in millimetres.items()),
        f"length              {1e3 * figures['length']:.4g} mm{measured}, cone at the tip "
        f"{figures['tip_cone_degrees']:.4g} degrees",
        f"clamped and tip     {figures['clamped_nodes']} and {figures['tip_nodes']} nodes",
        f"interface           from {_place(first)} to {_place(last)} mm, leading to trailing edge",
        f"mass                {figures['mass']:.4g} kg{whole}",
        f"speeds              f_omega = {speeds}; the highest is {figures['omega_max']:.6g} rad/s",
        f"first frequency     {figures['f1_hz']:.6g} Hz, times {figures['campbell_ratio']:.4g} at f_omega = "
        f"{figures['f_omega_max']:g}",
        f"reduced model       {figures['reduced_coordinates']} coordinates; in six modes {eq2}, with the "
        f"reduction {100 * rom:.2g} %",
    ]


def _place(point: list[float]) -> str:
    return "(" + ", ".join(f"{1e3 * x:.4g}" for x in point) + ")"
