"""``bladerub report``: a finished study on one page, in rpm, mm and MPa."""

import argparse
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bladerub.cli import inputs
from bladerub.cli.inputs import InputError, refused
from bladerub.config import record

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
        description="Read tables, maps and blade of a finished study and write one HTML file: the worst "
        "speeds of each coating, Campbell diagram, divergence, how sure that is, and what other coatings of "
        "the study change. Nothing is simulated.",
    )
    text = "the page (default: report.html in the results folder)"
    parser.add_argument("-o", "--output", type=Path, help=text, metavar="FILE")
    text = (
        f"coatings whose maps are shown, at most {_MOST_COATINGS} (default: the worst, the best, and those "
    )
    parser.option("--coating", f"{text}with a history)", nargs="+", default=[], metavar="NAME")


def report(options: argparse.Namespace) -> None:
    """Write the page, and print its first sentence and where it is."""
    config = inputs.read_config(options)
    folder = inputs.study_folder() / config["results"]
    path = options.output or folder / "report.html"
    inputs.require_writable("output", path)

    from bladerub.extras.report import answers, page, results
    from bladerub.io import atomic

    _require(results.files(config, folder), folder, options.config)
    with refused(ValueError):
        finished = results.read(config, folder)
    shown = _chosen(options.coating, finished) or answers.shown(finished, _MOST_COATINGS)
    with atomic.writing(path) as stream:
        stream.write(page.build(finished, shown, path.absolute().parent))
    figures = {
        "answer": answers.overview(finished)[0],
        "page": str(path),
        "bytes": path.stat().st_size,
        "coatings": list(finished.coatings.index),
    }
    inputs.show(options, figures, lambda shown: f"{shown['answer']}\n{path}: {shown['bytes'] / 1e6:.1f} MB")


def _require(files: list[Path], folder: Path, overlays: list[str]) -> None:
    """Refuse a study that is not finished: name the first missing file and what makes it."""
    missing = [path for path in files if not path.exists()]
    if missing:
        made_with = record.Record(overlays) if overlays else record.read(folder)
        arguments = f" {made_with.as_arguments()}" if made_with else ""
        target = missing[0].relative_to(inputs.study_folder()).as_posix()
        others = f" (and {len(missing) - 1} more)" if len(missing) > 1 else ""
        command = f"snakemake -j2{'' if others else f' {shlex.quote(target)}'}{arguments}"
        raise InputError(f"{target}{others} is missing: the study is not finished; run {command}")


def _chosen(names: list[str], finished: "Results") -> list[str]:
    """Return the coatings of ``--coating``, each once."""
    if unknown := [name for name in names if name not in finished.cases]:
        raise InputError(f"--coating {unknown[0]}: is no coating of the study; bladerub status lists them")
    if len(names) > _MOST_COATINGS:
        raise InputError(f"--coating: {len(names)} names; must be {_MOST_COATINGS} or fewer")
    return list(dict.fromkeys(names))
