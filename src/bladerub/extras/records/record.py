"""Which config made the results: the files laid over the study's own, and the values of the command line."""

import argparse
import json
import shlex
import sys
from pathlib import Path
from typing import Any

from bladerub.config.read import LaidOver, load, read_with_notes
from bladerub.io import atomic
from bladerub.io.errors import BadInput
from bladerub.io.folders import CONFIG
from bladerub.settings.study import Config

FILE = "config.json"
"""Name of the record in the results folder."""


def in_words(laid_over: LaidOver) -> str:
    """Write it as an option of the commands."""
    values = [f"{key}={value}" for key, value in laid_over.command_line.items()]
    return f"--config {' '.join([*laid_over.files, *values])}"


def as_arguments(laid_over: LaidOver) -> str:
    """Write it as options of snakemake."""
    files = ["--configfile", *laid_over.files] if laid_over.files else []
    values = [f"{key}={json.dumps(value)}" for key, value in laid_over.command_line.items()]
    return shlex.join([*files, *(["--config", *values] if values else [])])


def write(results: str | Path, laid_over: LaidOver) -> None:
    """Record in the folder `results` what its results are made with, in the folder of the study."""
    folder = Path.cwd()
    files = map(Path, laid_over.files)
    paths = [path.relative_to(folder) if path.is_relative_to(folder) else path for path in files]
    others = [path.as_posix() for path in paths if path != CONFIG]
    text = json.dumps({"files": others, "command_line": dict(laid_over.command_line)}, indent=2)
    with atomic.writing(Path(results) / FILE) as stream:
        stream.write(text + "\n")


def read(results: Path) -> LaidOver | None:
    """Read the record of the folder `results`: None if it has none, or a damaged one."""
    from pydantic import TypeAdapter  # `bladerub --help` does without

    try:
        laid_over = TypeAdapter(LaidOver).validate_json((results / FILE).read_bytes())
    except (OSError, ValueError):
        return None
    return laid_over if any(laid_over) else None


def notes(results: str, laid_over: LaidOver) -> list[str]:
    """Say which config `results` were made with, where nothing is laid over that of the study."""
    if made_with := _made_with(results, laid_over):
        return [f"{results} was made with {as_arguments(made_with)}; this is the study without it"]
    return []


def start(workflow: Any, results: str, laid_over: LaidOver) -> None:
    """Record the config of new results; `BadInput` for targets that would mix with results of another one."""
    targets = set(workflow.dag_settings.targets) - {"all"}
    if targets and (made_with := _made_with(results, laid_over)):
        raise BadInput(
            f"{' '.join(sorted(targets))}: add {as_arguments(made_with)}, as {results} was made, "
            f"or --configfile {CONFIG} to compute that study first"
        )
    planned = workflow.dag.needrun_jobs()
    if any(Path(results) in Path(file).parents for job in planned for file in job.output):
        write(results, laid_over)


def _made_with(results: str, laid_over: LaidOver) -> LaidOver | None:
    """Read what was laid over where nothing is now; None if a file of it is not there any more."""
    made_with = None if any(laid_over) else read(Path(results))
    return made_with if made_with and all(Path(file).is_file() for file in made_with.files) else None


def read_config(options: argparse.Namespace, base: Path, folder: Path) -> tuple[Config, list[str]]:
    """Read the config `base` of a study in its `folder`, with what made its results over it, and notes."""
    settings = load(base)
    results = settings.get("results")
    made_with = read(folder / results) if isinstance(results, str) else None
    if made_with is None:
        config, notes = read_with_notes(base)
        if others := _other_results(config, folder):
            print(f"bladerub {options.name}: with {base}, without results; others: {others}", file=sys.stderr)
        return config, notes
    files = [folder / file for file in made_with.files]
    for file in files:
        if not file.is_file():
            raise BadInput(
                f"{file}: there is no such file, and {results}/{FILE} names it; "
                f"name a config with --config FILE, {base} for the study without it"
            )
    print(f"bladerub {options.name}: with {in_words(made_with)}, as the results were made", file=sys.stderr)
    config, notes = read_with_notes(base, *files, command_line=made_with.command_line)
    law = getattr(config.contact.plugged("law"), "file", None)
    named_law = settings["contact"].get("law", {}).get("file")
    if law not in (None, named_law) and not getattr(options, "trust", True):
        raise BadInput(
            f"{config.results}/{FILE} names the law {law}, a program that this would execute: "
            "read it, then add --trust, or name the config yourself with --config FILE"
        )
    return config, notes


def _other_results(config: Config, folder: Path) -> str:
    """Write the options that name the configs of other results; empty where this config has results."""
    if (folder / config.results / "runs").exists():
        return ""
    files = (file for place in ("*", "*/*") for file in folder.glob(f"{place}/{FILE}"))
    records = filter(None, (read(file.parent) for file in files))
    return " or ".join(in_words(made_with) for made_with in records if not made_with.command_line)
