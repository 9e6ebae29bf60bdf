"""``bladerub check-law``: whether a law of the elements does what a law must."""

import argparse
from operator import attrgetter
from typing import Any

from bladerub.cli import inputs
from bladerub.cli.inputs import refused
from bladerub.extras.bounds import require
from bladerub.extras.law_reading import law_of
from bladerub.extras.law_settings import PARAMETER, law_entry, law_parameters
from bladerub.io.errors import BadInput


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = inputs.add_command(
        commands,
        "check-law",
        check_law,
        blade=False,
        help="check a law of the abradable elements",
        description="Press elements of the study's coatings, of least and greatest E and K, by a law along "
        "random histories of depth. Name lost and created energy, negative wear, what is no number, and a "
        "force that falls as the depth grows or disagrees with its stiffness; then compile the law with the "
        "time loop. The exit code is 1 if there is a problem.",
    )
    text = "Python file of a law, which is run, or the name of a law of the package"
    parser.add_argument("law", metavar="LAW", help=text)
    text = "parameter of the law, SI units or with its unit; once for each of them"
    parser.option("--parameter", text, **PARAMETER)
    parser.option("--seed", "of the histories, 0 or more (default 0)", int, metavar="N", default=0)


def check_law(options: argparse.Namespace) -> int:
    """Check the law that the command line names, and print what is wrong."""
    config = inputs.read_config(options)
    require(options, seed=(0, 2**32 - 1))
    values = law_parameters("--parameter", options.parameter)

    from bladerub.extras.verification.element_law import check_law as check
    from bladerub.study.grid import coating_cases, run_spec

    with refused(ValueError):
        law = law_of(law_entry(options.law, values))
    cases = [case for case in coating_cases(config) if not case.is_rigid]
    if not cases:
        raise BadInput("coatings: have no abradable layer; a law needs one")
    extremes = {end(cases, key=modulus) for modulus in map(attrgetter, "EK") for end in (min, max)}
    coatings = [run_spec(config, case, 0.2).coating for case in cases if case in extremes]
    report = check(law, coatings, options.seed)
    problems = [{"what": what, "where": place} for what, place in report.problems.items()]
    figures = {"law": law.label, "histories": report.histories, "problems": problems}
    inputs.show(options, figures, _in_words)
    return 1 if report.problems else 0


def _in_words(figures: dict[str, Any]) -> str:
    head = f"{figures['law']}: {figures['histories']} histories"
    if not figures["problems"]:
        return f"{head}, no problem; it compiles with the time loop"
    problems = (f"\n- {problem['what']} ({problem['where']})" for problem in figures["problems"])
    return f"{head}, {len(figures['problems'])} kinds of problem; values in SI units{''.join(problems)}"
