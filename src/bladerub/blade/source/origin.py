"""Where a blade comes from, as the config says it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from bladerub.blade.source.frame import Frame
from bladerub.config import ROOT


@dataclass(frozen=True)
class Source:
    """Where a blade comes from, as ``blade.source`` of the config says.

    Parameters
    ----------
    file : Path
        The mesh (`bladerub.blade.source.mesh_file`).
    frame : Frame
        Its unit and axes.
    root_set, tip_set : str or None
        Names of the node sets; found by which way the surface looks where they are not given.
    tip_cone : float or None
        Half angle (degrees) of the flow path at the tip, positive where it widens downstream; fitted to the
        tip where it is not given.
    """

    file: Path
    frame: Frame = field(default_factory=Frame)
    root_set: str | None = None
    tip_set: str | None = None
    tip_cone: float | None = None

    @classmethod
    def from_config(cls, source: Mapping[str, Any]) -> Source:
        """Read the ``blade.source`` block of the config; its file is relative to the repository."""
        layout = {entry.name: source[entry.name] for entry in fields(Frame) if entry.name in source}
        return cls(
            ROOT / source["file"],
            Frame(**layout),
            *(source.get(name) for name in ("root_set", "tip_set", "tip_cone")),
        )
