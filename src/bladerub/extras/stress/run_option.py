"""``bladerub run --stress``: the largest stress of the blade in the run."""

import argparse
from collections.abc import Mapping
from dataclasses import asdict
from itertools import product
from typing import TYPE_CHECKING, Any, ClassVar

from bladerub.cli import inputs
from bladerub.cli.run import RunOption
from bladerub.io.errors import BadInput

if TYPE_CHECKING:
    from bladerub.api.run import Run
    from bladerub.settings.study import Config

_PARTS = {"static": "rotation alone", "start_up": "start-up", "last": "last revolutions"}
_KINDS = {"von_mises": "von Mises", "principal": "largest principal", "alternating": "alternating"}


class StressOption(RunOption):
    """Whether the stress is found."""

    units: ClassVar[Mapping[str, str]] = dict.fromkeys(_KINDS, "Pa")

    def add_to(self, parser: inputs.Parser) -> None:
        """Add ``--stress``."""
        text = "find the largest stress of the blade too, at start-up and in the last revolutions"
        parser.add_argument("--stress", action="store_true", help=text)

    def check(self, options: argparse.Namespace, config: "Config") -> None:
        """Refuse the stress of rows."""
        if options.stress and (getattr(options, "blades", None) is not None or config.plugged("rotor")):
            others = "not with --blades or the block rotor of the config"
            raise BadInput(f"--stress: is of a single blade; {others}")

    def arguments(self, options: argparse.Namespace) -> dict[str, Any]:
        """Ask for the stress."""
        return {"stress": True} if options.stress else {}

    def figures(self, options: argparse.Namespace, planned: Any, blade: Any, run: "Run") -> dict[str, Any]:
        """Return the stress; None if it is not known."""
        return {"stress": asdict(run.stress) if run.stress else None} if options.stress else {}

    def in_words(self, figures: Mapping[str, Any]) -> list[str]:
        """Write a line for each part of the run and kind of stress, with the place."""
        if "stress" not in figures:
            return []
        stress = figures["stress"]
        if stress is None:
            return ["stress: not known, the blade is of matrices alone or no revolution is complete"]
        lines = []
        for (part, phase), (name, kind) in product(_PARTS.items(), _KINDS.items()):
            peaks = stress[part]
            if name in peaks:
                place = ", ".join(f"{1e3 * peaks[f'{name}_{axis}']:.1f}" for axis in "xyz")
                time = f", after {peaks[f'{name}_time']:.3f} revolutions" if f"{name}_time" in peaks else ""
                lines.append((f"{kind}, {phase}", f"{peaks[name] / 1e6:.4g} MPa at ({place}) mm{time}"))
        return ["largest stress:", *inputs.aligned(lines)]
