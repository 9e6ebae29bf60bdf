"""``bladerub verify``: how accurate the study is, by runs drawn from it."""

import argparse
from pathlib import Path
from typing import Any

from bladerub.api.display import bar
from bladerub.cli import inputs
from bladerub.cli.inputs import refused
from bladerub.extras.bounds import require
from bladerub.io.errors import BadInput

_MEASURES = {"wear_l2": "wear (L2)", "peak": "spectral peak", "revolution_peak": "revolution peak"}
_STATISTICS = {"median": "median", "p95": "95 %", "max": "worst"}


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = inputs.add_command(
        commands,
        "verify",
        verify,
        help="measure the error of runs drawn from the study",
        description="Draw runs from all coatings and speeds of the study, and repeat each with a time step "
        "four times finer. The relative differences in wear profile (L2), largest spectral amplitude and "
        "peaks of the revolutions are the error of the run. Each is also compared with the paper's scheme at "
        "a fine step. Runs with an error above 1 % are listed. One is flagged as sensitive if runs whose "
        "starts differ by a ten-thousandth of a millimetre or less spread at least half as much. In a row of "
        "blades, the largest difference of a peak is related to the largest peak of its blades.",
        epilog="Speed-up at equal error: the paper's scheme has an error proportional to its step, "
        "measured against the study's scheme with finer steps, in wear (in the spectral peak where nothing "
        "wears). The cost of that scheme at the step at which this is the error of the study's run (at most "
        "0.7 of its largest stable step) is divided by the cost of the study's run. The figure is the median "
        "over runs that are not sensitive and where the error of the paper's scheme shrinks with its step.",
    )
    inputs.add_trust_to(parser)
    parser.option("--sample", "how many runs", int, required=True, metavar="N")
    parser.option("--seed", "decides which; 0 or more", int, required=True, metavar="S")
    text = "draw from the runs that tables and claims rest on, such as the peaks, by the maps"
    parser.add_argument("--peaks", action="store_true", help=text)
    text = "draw from the rows of blades of a plan, such as config/rotor.yaml, instead"
    parser.option("--rows", text, Path, metavar="PLAN")
    text = "runs at once (default 1); they slow each other down, so that costs are less exact with more"
    parser.option("--jobs", text, int, default=1, metavar="J")


def verify(options: argparse.Namespace) -> None:
    """Verify the runs that the command line asks for, and print the distribution of their errors."""
    config = inputs.read_config(options)
    require(options, seed=(0, 2**63), jobs=(1, 1000))
    if options.rows and options.peaks:
        raise BadInput(f"--rows = {options.rows}: not with --peaks, which are of single blades")

    from bladerub.extras.study_runs import StudyRun, important_runs, study_runs
    from bladerub.extras.verification.verify import draw, summary, verify_runs

    if options.rows:
        from bladerub.extras.rotor.plan import read_plan

        plan = read_plan(options.rows, config)
        runs = [
            StudyRun(member.case, member.f_omega, plan.row(member, number), f"{member.name}/{number:04d}")
            for member, draws in plan.draws.items()
            for number in range(draws)
        ]
    elif options.peaks:
        runs = important_runs(config, inputs.study_folder() / config.results / "maps")
    else:
        runs = study_runs(config)
    with refused(ValueError, because=f"--sample = {options.sample}: "):
        runs = draw(runs, options.sample, options.seed)
    blade, config = inputs.read_blade(options, config)
    fastest = max(run.f_omega for run in runs)
    if fastest > blade.reduced.f_omega_max:
        raise BadInput(
            f"f_omega = {fastest:g}: the speeds of the study must be at most "
            f"{blade.reduced.f_omega_max:g} (normalised), the highest of {blade.path}"
        )
    with refused(ValueError):
        runs_done = verify_runs(blade.reduced, config, runs, options.jobs)
        done = bar(len(runs), "run", False if options.json else None, iterable=runs_done)
        verified = sorted(done, key=lambda one: one.run.name)
    inputs.warn_of_residual(options, max(run.energy_residual for run in verified))
    inputs.show(options, {"seed": options.seed, "jobs": options.jobs} | summary(verified), _in_words)


def _in_words(figures: dict[str, Any]) -> str:
    paper, beyond, n = figures["against_paper_scheme"], figures["beyond"], figures["n"]
    seconds, speedup = figures["seconds"], figures["speedup_at_equal_error"]
    rows = [("against a step 4 times finer", *_STATISTICS.values())]
    rows += [(words, *_shown(figures[key]), f"  {figures['worst'][key]}") for key, words in _MEASURES.items()]
    rows += [("energy residual", *_shown(figures["energy_residual"])), ("",)]
    rows.append(("against the paper's scheme", *_STATISTICS.values()))
    for distributions, words in ((paper, ""), (paper["uncertainty"], ", its own error")):
        rows += [(f"{name}{words}", *_shown(distributions[key])) for key, name in _MEASURES.items()]
    lines = [
        f"{n} runs, seed {figures['seed']}",
        "",
        *(inputs.row(38, *row).rstrip() for row in rows),
        "",
        f"within 1 % in wear and spectral peak: {figures['within_1_percent']:.1%} of the runs",
        f"seconds a run: {seconds['study']:.3g}, finer {seconds['finer']:.3g}, "
        f"paper's scheme {seconds['paper']:.3g}, finer {seconds['paper_finer']:.3g}"
        + (f" ({figures['jobs']} runs at once: not exact)" if figures["jobs"] > 1 else ""),
        f"speed-up at equal error: {'none' if speedup is None else f'{speedup:.3g}'} "
        f"(median of {n - figures['left_out']} of {n} runs)",
        "",
        inputs.row(38, "beyond 1 %", "wear", "peak", "revolution") if beyond else "beyond 1 %: none",
    ]
    for entry in beyond:
        spread = entry["spread"]
        note = spread and f"neighbours {', '.join(_percent(spread[key]) for key in _MEASURES)}"
        note = f"sensitive: {note}" if entry["sensitive"] else note or ""
        errors = (_percent(entry[key]) for key in _MEASURES)
        lines.append(inputs.row(38, entry["name"], *errors, f"  {note}").rstrip())
    return "\n".join(lines)


def _shown(distribution: dict[str, float | None]) -> list[str]:
    return [_percent(distribution[key]) for key in _STATISTICS]


def _percent(value: float | None) -> str:
    return "unbounded" if value is None else f"{100 * value:.3g} %"
