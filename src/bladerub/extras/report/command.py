"""``bladerub report``: a finished study on one page, in rpm, mm and MPa."""

import argparse
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bladerub.cli import inputs
from bladerub.cli.inputs import refused
from bladerub.config.read import LaidOver
from bladerub.extras.records import record
from bladerub.io.errors import BadInput

if TYPE_CHECKING:
    from bladerub.extras.report.results import Results

_MOST_COATINGS = 6


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = inputs.add_command(
        commands,
        "report",
        report,
        blade=False,
        help="write a page that says at which rpm the blade is in trouble, and with which coating",
        description="Read a finished study and write one HTML file: the worst speeds of each coating, how "
        "sure that is, and what other coatings of the study change. Nothing is simulated.",
    )
    text = "the page (default: report.html in the results folder)"
    parser.add_argument("-o", "--output", type=Path, help=text, metavar="FILE")
    text = f"coatings with maps, at most {_MOST_COATINGS} (default: worst, best, and those with a history)"
    parser.option("--coating", text, nargs="+", default=[], metavar="NAME")


def report(options: argparse.Namespace) -> None:
    """Write the page, and print where it is and which coating is the worst."""
    config = inputs.read_config(options)
    folder = inputs.study_folder() / config.results
    path = options.output or folder / "report.html"
    if path.is_dir():
        raise BadInput(f"--output {path}: is a folder, must be a file")
    inputs.require_writable("--output", path)

    from bladerub.extras.report import answers, page, results
    from bladerub.io import atomic

    if missing := [path for path in results.files(config, folder) if not path.exists()]:
        made_with = LaidOver(options.config) if options.config else record.read(folder)
        target = missing[0].relative_to(inputs.study_folder()).as_posix()
        command = f"snakemake -j2 {record.as_arguments(made_with) if made_with else ''}".strip()
        raise BadInput(f"{target} is missing: the study is not finished; run {command}")
    with refused(ValueError):
        finished = results.read(config, folder)
    shown = _chosen(options.coating, finished) or answers.shown(finished, _MOST_COATINGS)
    with atomic.writing(path) as stream:
        stream.write(page.build(finished, shown, path.absolute().parent))
    coatings = list(finished.coatings.index)
    figures = {"page": str(path), "bytes": path.stat().st_size, "coatings": coatings}
    line = f"{path}: {figures['bytes'] / 1e6:.1f} MB; the coating with the highest peak is {coatings[0]}"
    inputs.show(options, figures, lambda _: line)


def _chosen(names: list[str], finished: "Results") -> list[str]:
    """Return the coatings of ``--coating``, each once."""
    for name in names:
        if name not in finished.cases:
            nearest = ", ".join(get_close_matches(name, finished.cases, cutoff=0))
            raise BadInput(f"--coating {name}: must be one that bladerub status lists, such as {nearest}")
    if len(names) > _MOST_COATINGS:
        raise BadInput(f"--coating: {len(names)} names; must be {_MOST_COATINGS} or fewer")
    return list(dict.fromkeys(names))
