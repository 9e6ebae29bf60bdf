"""Where a blade comes from, as the config says it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from bladerub.blade.sources.frame import Frame
from bladerub.io.sources import ROOT

MATRIX_UNITS = {"SI": 1.0, "mm-tonne": 1e3, "inch-lbf": 4.4482216152605 / 0.0254}
"""By the name of a system of units with the second in it: N/m of its stiffness, and as well kg of its mass.

The two are one number in every such system, so frequencies do not tell when the wrong one is named.
"""
TABLE_SUFFIXES = (".csv", ".txt", ".dat")
"""Files that end so are tables of sections, all others meshes."""

_OF_A_MESH = ("root_set", "tip_set")


@dataclass(frozen=True)
class Source:
    """Where a blade comes from, as ``blade.source`` of the config says.

    Parameters
    ----------
    file : Path
        The mesh (`bladerub.blade.sources.mesh_file`) or table of sections
        (`bladerub.blade.sources.section_table`).
    frame : Frame
        Its unit and axes.
    root_set, tip_set : str or None
        Names of the node sets; found by which way the surface looks where they are not given.
    tip_cone : float or None
        Half angle (degrees) of the flow path at the tip, positive where it widens downstream; fitted to the
        tip where it is not given.
    angle_unit : str or None
        Of the angles in a table of sections, one of `bladerub.blade.sources.frame.ANGLE_UNITS`; rad where it
        is not given.

    Raises
    ------
    ValueError
        If something is given that a file of this kind has no use for.
    """

    file: Path
    frame: Frame = field(default_factory=Frame)
    root_set: str | None = None
    tip_set: str | None = None
    tip_cone: float | None = None
    angle_unit: str | None = None

    def __post_init__(self):
        useless = _OF_A_MESH if self.is_table else ("angle_unit",)
        for name in useless:
            if getattr(self, name) is not None:
                kind = "mesh" if self.is_table else "table of sections"
                raise ValueError(
                    f"{name} = {getattr(self, name)}: goes with a {kind}, not with {self.file.name}"
                )

    @property
    def is_table(self) -> bool:
        """Whether the file is a table of sections, which is meshed here, by ``blade.mesh`` of the config."""
        return self.file.suffix.lower() in TABLE_SUFFIXES

    @classmethod
    def from_config(cls, source: Mapping[str, Any]) -> Source:
        """Read the ``blade.source`` block of the config; its file is relative to the repository."""
        return cls(
            ROOT / source["file"],
            _frame(source),
            *(source.get(name) for name in ("root_set", "tip_set", "tip_cone", "angle_unit")),
        )


@dataclass(frozen=True)
class MatrixSource:
    """Where the matrices of a blade come from, as ``blade.source`` of the config says.

    Parameters
    ----------
    folder : Path
        With the files (`bladerub.blade.sources.matrix_folder`).
    frame : Frame
        Unit of the nodes' coordinates, and axes of nodes and matrices.
    matrix_units : str
        One of `MATRIX_UNITS`.
    omega_max : float or None
        Speed of ``stiffness_max``, rad/s, to be held against ``reduction.f_omega_max`` where it is given.
    tip_cone : float or None
        As in `Source`.
    """

    folder: Path
    frame: Frame = field(default_factory=Frame)
    matrix_units: str = "SI"
    omega_max: float | None = None
    tip_cone: float | None = None

    @classmethod
    def from_config(cls, source: Mapping[str, Any]) -> MatrixSource:
        """Read the ``blade.source`` block of the config; its folder is relative to the repository."""
        given = {name: source[name] for name in ("matrix_units", "omega_max", "tip_cone") if name in source}
        return cls(ROOT / source["matrices"], _frame(source), **given)


_OF_MATRICES_ONLY = ("matrix_units", "omega_max")
_OF_FILES_ONLY = ("file", "angle_unit", *_OF_A_MESH)


def read(source: Mapping[str, Any]) -> Source | MatrixSource:
    """Read the ``blade.source`` block of the config.

    Raises
    ------
    ValueError
        If it names not one of ``file`` and ``matrices``, or keys do not go together; begins with the key.
    """
    if "matrices" in source:
        astray, kind = [key for key in _OF_FILES_ONLY if key in source], MatrixSource
    elif "file" in source:
        astray, kind = [key for key in _OF_MATRICES_ONLY if key in source], Source
    else:
        raise ValueError("file: missing; must be given, or matrices in its place")
    if astray:
        other = "matrices" if kind is MatrixSource else "file"
        raise ValueError(f"{astray[0]} = {source[astray[0]]}: must not be given beside {other}")
    return kind.from_config(source)


def files(source: Mapping[str, Any]) -> list[str]:
    """List the files that the ``blade.source`` block of the config names, as seen from where that is.

    Raises
    ------
    ValueError
        If a file of a folder of matrices is missing.
    """
    if "matrices" not in source:
        return [source["file"]]
    from bladerub.blade.sources import matrix_folder  # brings pandas, which no command needs to begin

    found = matrix_folder.files(MatrixSource.from_config(source).folder)
    return [os.path.join(source["matrices"], path.name) for path in found.values()]


def _frame(source: Mapping[str, Any]) -> Frame:
    return Frame(**{entry.name: source[entry.name] for entry in fields(Frame) if entry.name in source})
