"""``bladerub verify``: how accurate the study is, by runs drawn from it."""

from __future__ import annotations

import argparse
import json
from shutil import get_terminal_size
from typing import Any

from tqdm import tqdm

from bladerub.cli import inputs
from bladerub.cli.errors import InputError

_MEASURES = {"wear_l2": "wear (L2)", "peak": "spectral peak", "revolution_peak": "revolution peak"}
_STATISTICS = {"median": "median", "p95": "95 %", "max": "worst"}


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = commands.add_parser(
        "verify",
        help="measure the error of runs drawn from the study",
        description="Draw runs of the study, all coatings and speeds alike, and repeat each with a step four "
        "times finer: the relative differences in wear profile (L2), largest spectral amplitude "
        "and peaks of the revolutions are the error of the run. Each is also compared with the "
        "paper's scheme at a fine step. Runs beyond 1 % are listed, and flagged as sensitive "
        "where starts that differ by a ten-thousandth of a millimetre or less spread at least "
        "half as much.",
        epilog="Speed-up at equal error: the paper's scheme has an error proportional to its step, "
        "measured against the study's scheme with finer steps, in wear (in the spectral peak "
        "where nothing wears). What it would cost with the step at which that is the error of the "
        "study's run (at most 0.7 of its largest stable step), over what the study's run costs; "
        "the median over runs that are not sensitive, and where the error of the paper's scheme "
        "shrinks with its step.",
    )
    parser.set_defaults(command=verify)
    parser.add_argument("--sample", required=True, type=int, metavar="N", help="how many runs")
    parser.add_argument("--seed", required=True, type=int, metavar="S", help="decides which; 0 or more")
    inputs.add_to(parser)
    parser.add_argument(
        "--jobs",
        default=1,
        type=int,
        metavar="J",
        help="runs at once (default 1); they slow each other down, so that costs are less exact with more",
    )
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")


def verify(options: argparse.Namespace) -> None:
    """Verify the runs that the command line asks for, and print the distribution of their errors.

    Raises
    ------
    ConfigError
        If the config is at fault.
    InputError
        If an option is.
    """
    config = inputs.read_config(options)
    inputs.require(options, seed=(0, 2**63), jobs=(1, 1000))

    from bladerub.verification.report import report
    from bladerub.verification.verify import draw, study_runs, verify_runs

    try:
        runs = draw(study_runs(config), options.sample, options.seed)
    except ValueError as error:
        raise InputError(f"--sample = {options.sample}: {error}") from error
    blade_path, blade = inputs.read_blade(options, config)
    fastest = max(run.f_omega for run in runs)
    if fastest > blade.f_omega_max:
        raise InputError(
            f"f_omega = {fastest:g}: the speeds of the study must be at most {blade.f_omega_max:g} "
            f"(normalised), the highest of {blade_path}"
        )
    bar = tqdm(
        verify_runs(blade, config, runs, options.jobs),
        total=len(runs),
        unit="run",
        ncols=get_terminal_size().columns,
        disable=True if options.json else None,
        leave=False,
    )
    try:
        verified = list(bar)
    except ValueError as error:
        raise InputError(str(error)) from error
    figures = {"seed": options.seed, "jobs": options.jobs} | report(verified)
    print(json.dumps(figures, indent=2, allow_nan=False) if options.json else _in_words(figures))


def _in_words(figures: dict[str, Any]) -> str:
    lines = [
        f"{figures['n']} runs, seed {figures['seed']}",
        "",
        _row("against a step 4 times finer", _STATISTICS.values()),
        *(_row(words, _shown(figures[key]), figures["worst"][key]) for key, words in _MEASURES.items()),
        _row("energy residual", _shown(figures["energy_residual"])),
        "",
        _row("against the paper's scheme", _STATISTICS.values()),
    ]
    paper = figures["against_paper_scheme"]
    lines += [_row(words, _shown(paper[key])) for key, words in _MEASURES.items()]
    lines += [
        _row(f"{words}, its own error", _shown(paper["uncertainty"][key])) for key, words in _MEASURES.items()
    ]
    seconds, speedup = figures["seconds"], figures["speedup_at_equal_error"]
    lines += [
        "",
        f"within 1 % in wear and spectral peak: {figures['within_1_percent']:.1%} of the runs",
        f"seconds a run: {seconds['study']:.3g}, finer {seconds['finer']:.3g}, "
        f"paper's scheme {seconds['paper']:.3g}, finer {seconds['paper_finer']:.3g}"
        + (f" ({figures['jobs']} runs at once: not exact)" if figures["jobs"] > 1 else ""),
        f"speed-up at equal error: {'none' if speedup is None else f'{speedup:.3g}'} "
        f"(median of {figures['n'] - figures['left_out']} of {figures['n']} runs)",
        "",
        _beyond_heading(figures["beyond"]),
    ]
    lines += [_beyond_row(entry) for entry in figures["beyond"]]
    return "\n".join(lines)


def _row(words: str, cells: Any, note: str = "") -> str:
    return f"{words:<38}" + "".join(f"{cell:>12}" for cell in cells) + (f"  {note}" if note else "")


def _shown(distribution: dict[str, float | None]) -> list[str]:
    return [_percent(distribution[key]) for key in _STATISTICS]


def _percent(value: float | None) -> str:
    return "unbounded" if value is None else f"{100 * value:.3g} %"


def _beyond_heading(beyond: list[dict[str, Any]]) -> str:
    return _row("beyond 1 %", ("wear", "peak", "revolution")) if beyond else "beyond 1 %: none"


def _beyond_row(entry: dict[str, Any]) -> str:
    spread = entry["spread"]
    note = "" if spread is None else f"neighbours {', '.join(_percent(spread[key]) for key in _MEASURES)}"
    if entry["sensitive"]:
        note = f"sensitive: {note}"
    return _row(entry["name"], (_percent(entry[key]) for key in _MEASURES), note)
