"""``bladerub benchmark``: how fast the time loop is on this machine."""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

from bladerub.cli import inputs
from bladerub.cli.errors import InputError


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = commands.add_parser(
        "benchmark",
        help="measure how fast the time loop is on this machine",
        description="March the same two revolutions of the study's blade from rest with a plain NumPy loop, "
        "with that loop compiled by numba, and with the loop of the study: once with contact in a third "
        "of the steps, once vibrating freely. Medians of rounds that take turns, on one core.",
        epilog="Fractions of peak: useful operations a second over those of a loop of products and sums in "
        "the same vectors. Useful are, in a step made by itself, 39 a mode (recurrence, damping loss, "
        "displacement of the tip); in a leap over many free steps, however many, 61 a mode (the same "
        "over the leap, mean and bound of its way); with contact 32 more a mode (forces on the modes), a "
        "response of the 16 displacements to the 16 forces, 69 a bar under the tip (force once, wear and its "
        "ledger) and 60 a node: comparisons, repeated attempts at the forces and filled-up vectors are not. "
        "Seconds a run: drawn runs of the study at its step. The study's minutes are those of its "
        "simulations alone, without those that are repeated longer.",
    )
    parser.set_defaults(command=benchmark)
    inputs.add_to(parser)
    parser.add_argument("--rounds", default=5, type=int, metavar="N", help="how often to measure (default 5)")
    parser.add_argument(
        "--cores", type=int, metavar="C", help="cores for the estimate of the study (default: all there are)"
    )
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")


def benchmark(options: argparse.Namespace) -> None:
    """Measure, and print the figures.

    Raises
    ------
    ConfigError
        If the config is at fault.
    InputError
        If an option is.
    """
    config = inputs.read_config(options)
    inputs.require(options, rounds=(1, 1000), cores=(1, 1_000_000))
    if all(entry.get("coating") == "rigid" for entry in config["coatings"]):
        raise InputError("coatings: must have an abradable one, whose rub is what is measured")
    _, blade = inputs.read_blade(options, config)

    from bladerub.benchmark.measure import benchmark as measure

    figures = measure(blade, config, options.rounds, options.cores, _tell)
    print(json.dumps(figures, indent=2) if options.json else _in_words(figures))


def _tell(stage: str) -> None:
    print(f"bladerub benchmark: {stage}", file=sys.stderr)


def _in_words(figures: dict[str, Any]) -> str:
    rates = figures["steps_per_second"]
    lines = [
        f"{figures['modes']} modes, contact in {figures['contact_share']:.0%} of the steps or none, "
        f"medians of {figures['rounds']} rounds",
        "",
        f"{'million steps a second':<30}{'contact':>12}{'free':>12}",
        *(
            f"{words:<30}{rates[loop]['contact'] / 1e6:>12.3g}{rates[loop]['free'] / 1e6:>12.3g}"
            for loop, words in (
                ("numpy", "NumPy"),
                ("numba", "the same compiled by numba"),
                ("production", "loop of the study"),
            )
        ),
        f"{'times NumPy':<30}{figures['ratio_to_numpy']:>12.3g}{figures['ratio_to_numpy_free']:>12.3g}",
        f"{'times numba':<30}{figures['ratio_to_numba']:>12.3g}{figures['ratio_to_numba_free']:>12.3g}",
        f"{'fraction of peak':<30}{figures['fraction_of_peak_contact']:>12.2f}"
        f"{figures['fraction_of_peak_free']:>12.2f}",
        "",
        f"peak: {figures['peak_flops'] / 1e9:.3g} billion operations a second",
        f"a run of the study: {figures['seconds_per_run']:.3g} s; {figures['runs']} runs on "
        f"{figures['cores']} cores: {figures['study_minutes']:.3g} minutes",
    ]
    return "\n".join(lines)
