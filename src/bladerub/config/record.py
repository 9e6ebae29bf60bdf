"""Which config made the results: the files laid over the study's own, and the values of the command line."""

import json
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from bladerub.io import atomic
from bladerub.io.folders import CONFIG

FILE = "config.json"
"""Name of the record in the results folder."""


@dataclass(frozen=True)
class Record:
    """What was laid over the config of the study."""

    files: Sequence[str]  # in order, relative to the folder of the study
    command_line: Mapping[str, Any] = field(default_factory=dict)  # what ``snakemake --config`` was given

    def __str__(self) -> str:
        values = [f"{key}={value}" for key, value in self.command_line.items()]
        return f"--config {' '.join([*self.files, *values])}"

    def as_arguments(self) -> str:
        """Write it as options of snakemake."""
        files = ["--configfile", *self.files] if self.files else []
        values = ["--config", *(f"{key}={json.dumps(value)}" for key, value in self.command_line.items())]
        return shlex.join([*files, *(values if self.command_line else [])])


def write(results: str | Path, files: Sequence[str | Path], command_line: Mapping[str, Any]) -> None:
    """Record in the folder `results` what its results are made with, in the folder of the study."""
    folder = Path.cwd()
    paths = [path.relative_to(folder) if path.is_relative_to(folder) else path for path in map(Path, files)]
    laid_over = [path.as_posix() for path in paths if path != CONFIG]
    text = json.dumps(asdict(Record(laid_over, dict(command_line))), indent=2)
    with atomic.writing(Path(results) / FILE) as stream:
        stream.write(text + "\n")


def read(results: Path) -> Record | None:
    """Read the record of the folder `results`: None if it has none, or a damaged one."""
    from pydantic import TypeAdapter  # `bladerub --help` does without

    try:
        record = TypeAdapter(Record).validate_json((results / FILE).read_bytes())
    except (OSError, ValueError):
        return None
    return record if record.files or record.command_line else None
