"""``bladerub run --ensemble N``: the run from other starts, and its bands."""

import argparse
import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from bladerub.cli import inputs
from bladerub.cli.run import RunOption
from bladerub.io.errors import BadInput

if TYPE_CHECKING:
    from bladerub.api.blade import Blade
    from bladerub.api.planned import StudyRun
    from bladerub.api.run import Run
    from bladerub.settings.study import Config


class EnsembleOption(RunOption):
    """The number of further starts."""

    def add_to(self, parser: inputs.Parser) -> None:
        """Add ``--ensemble``."""
        text = "run it again from so many other starts, as the study does, and show the bands"
        parser.option("--ensemble", text, int, metavar="N")

    def check(self, options: argparse.Namespace, config: "Config") -> None:
        """Refuse ensembles without members, and those of rows."""
        if options.ensemble is None:
            return
        if options.ensemble < 1:
            raise BadInput(f"--ensemble = {options.ensemble}: must be at least 1")
        if getattr(options, "blades", None) is not None:
            raise BadInput(f"--ensemble = {options.ensemble}: not with --blades; give another --seed instead")

    def figures(
        self, options: argparse.Namespace, planned: "StudyRun", blade: "Blade", run: "Run"
    ) -> dict[str, Any]:
        """Simulate the ensemble."""
        if options.ensemble is None:
            return {}

        from bladerub.extras.ensembles.interface import simulate_ensemble

        ensemble = simulate_ensemble(blade, planned, options.ensemble, own=run, progress=sys.stderr.isatty())
        bands = ensemble.bands()
        figures = {
            "runs": len(ensemble.runs),
            "divergent_draws": float(ensemble.to_pandas().divergent.mean()),
            **bands.astype(object).where(bands.notna(), None).to_dict("index"),
        }
        return {"ensemble": figures}

    def in_words(self, figures: Mapping[str, Any]) -> list[str]:
        """Write median and band of each quantity."""
        if "ensemble" not in figures:
            return []
        ensemble = figures["ensemble"]
        rows = {
            "ensemble": f"{ensemble['runs']} runs: median, and the interval of 90 % of further starts",
            "peak displacement": _between(ensemble["peak_amplitude"], 1e3, "mm "),
            "spectral peak": _between(ensemble["spectral_peak"], 1e3, "mm "),
            "maximum wear": _between(ensemble["max_wear"], 1e3, "mm "),
            "lobes": _between(ensemble["lobes"], 1, ""),
            "growth": _between(ensemble["growth_per_revolution"], 100, "% a revolution "),
            "divergent": f"{100 * ensemble['divergent_draws']:.0f} % of the runs",
        }
        return inputs.aligned(rows.items())


def _between(band: Mapping[str, float | None], factor: float, unit: str) -> str:
    if band["low"] is None:
        return "not measurable"
    median, low, high = (f"{factor * band[end]:.4g}" for end in ("median", "low", "high"))
    return f"{median} {unit}({low} to {high})".replace("  ", " ")
