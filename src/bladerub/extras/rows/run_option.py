"""``bladerub run --blades N``: a row of blades in place of the single one."""

import argparse
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from bladerub.cli import inputs
from bladerub.cli.inputs import quantity
from bladerub.cli.run_option import RunOption
from bladerub.extras.bounds import require
from bladerub.io.errors import BadInput, format_value

if TYPE_CHECKING:
    from bladerub.api.blade import Blade
    from bladerub.api.planned import StudyRun
    from bladerub.api.run import Run
    from bladerub.settings.study import Config

_SETTINGS = ("length_scatter", "frequency_scatter", "coupling", "seed")
_OF_BLADES = {
    "blade": ("blade", 1, "d"),
    "length, µm": ("length", 1e6, ".1f"),
    "frequency, %": ("frequency", 100, ".2f"),
    "peak, mm": ("peak", 1e3, ".4f"),
    "amplitude, mm": ("amplitude", 1e3, ".4f"),
    "worn, cm³": ("worn_volume", 1e6, ".3f"),
}
"""Columns of the table of a row, with the name of the figure, its factor and format."""


class RowOption(RunOption):
    """The number of blades, and their scatter."""

    def add_to(self, parser: inputs.Parser) -> None:
        """Add ``--blades`` and what describes them."""
        text = "so many blades, at even angles, that rub on one coating"
        parser.option("--blades", text, int, metavar="N")
        text = "standard deviation of their tip radii, m or '20 µm' (default 0)"
        parser.option("--length-scatter", text, quantity, metavar="S")
        text = "standard deviation of their natural frequencies, relative (default 0)"
        parser.option("--frequency-scatter", text, quantity, metavar="S")
        text = "springs of the disk between neighbours over the stiffness of the first mode (default 0: none)"
        parser.option("--coupling", text, inputs.number, metavar="C")
        parser.option("--seed", "of the draws of the blades, 0 or more (default 1)", int, metavar="N")

    def check(self, options: argparse.Namespace, config: "Config") -> None:
        """Convert the scatters; refuse settings without blades, and numbers that cannot be."""
        from bladerub.config.quantities import in_typed_unit, key_at, number, references

        for name in ("length_scatter", "frequency_scatter"):
            typed = getattr(options, name)
            with inputs.refused(ValueError, because=f"--{name.replace('_', '-')} = {format_value(typed)}: "):
                plain = number(path := f"rotor.{name}", typed, references(config))
                most = key_at(path).ends[1]
                if isinstance(plain, float) and plain > most:
                    raise ValueError(in_typed_unit(f"must be at most {most:g}", typed, plain))
                setattr(options, name, plain)
        for name, value in _settings(options).items():
            option = f"--{name.replace('_', '-')} = {value:g}"
            if options.blades is None:
                raise BadInput(f"{option}: goes with --blades only")
            if not (math.isfinite(value) and value >= 0):
                raise BadInput(f"{option}: must be 0 or more")
        require(options, blades=(1, int(key_at("rotor.blades").bounds["le"])))

    def arguments(self, options: argparse.Namespace) -> dict[str, Any]:
        """Draw the row."""
        if options.blades is None:
            return {}

        from bladerub.extras.rows.study import drawn

        settings = _settings(options)
        with inputs.refused(ValueError):
            return {"row": drawn(options.blades, settings.pop("seed", 1), **settings)}

    def figures(
        self, options: argparse.Namespace, planned: "StudyRun", blade: "Blade", run: "Run"
    ) -> dict[str, Any]:
        """Return the blades of a row, which may be that of the config, and the one that vibrates most."""
        if not len(run.blades):
            return {}
        return {"blade": run.attributes["blade"], "blades": run.blades.reset_index().to_dict("records")}

    def in_words(self, figures: Mapping[str, Any]) -> list[str]:
        """Write a line for each blade; a mark at those that left the displacement limit."""
        if "blades" not in figures:
            return []
        title = f"a row of {len(figures['blades'])}, above blade {figures['blade']}, which vibrates most:"
        rows = [tuple(_OF_BLADES)]
        for blade in figures["blades"]:
            cells = [f"{factor * blade[name]:{form}}" for name, factor, form in _OF_BLADES.values()]
            rows.append((*cells[:-1], cells[-1] + (" unbounded" if blade["unbounded"] else "")))
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        aligned = ((f"{cell:>{width}}" for cell, width in zip(row, widths, strict=True)) for row in rows)
        return [title, *map("  ".join, aligned)]


def _settings(options: argparse.Namespace) -> dict[str, Any]:
    return {name: value for name in _SETTINGS if (value := getattr(options, name)) is not None}
