"""Config files laid over one another as Snakemake does, and checked before anything is computed."""

import json
import re
from collections.abc import Mapping, Sequence
from functools import reduce
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from bladerub import plugins
from bladerub.config.errors import UNKNOWN, ConfigError, Location, Problem, top_key
from bladerub.config.files import Located, compose
from bladerub.io.folders import ROOT

if TYPE_CHECKING:
    from bladerub.settings.study import Config

SCHEMA = ROOT / "config" / "schema.json"  # what any part of bladerub reads in a config, for editors


class LaidOver(NamedTuple):
    """What is laid over the config of a study."""

    files: Sequence[str]  # in order
    command_line: Mapping[str, Any] = {}  # what ``snakemake --config`` was given


def load(*paths: str | Path) -> dict[str, Any]:
    """Read YAML files as `bladerub.config.files.compose`, without a check of what they hold."""
    return _composed(*paths).plain()


def is_whole(path: str | Path) -> bool:
    """Return whether the file at `path` has every section of a config; raises as `load`."""
    from bladerub.settings.study import required

    return required() <= load(path).keys()


def read(*paths: str | Path, command_line: Mapping[str, Any] | None = None) -> "Config":
    """Read a config as `bladerub.config.files.compose` and `validate` it: arguments and errors are theirs."""
    return read_with_notes(*paths, command_line=command_line)[0]


def read_with_notes(
    *paths: str | Path,
    command_line: Mapping[str, Any] | None = None,
    source: str = "--config",
    is_checked: bool = False,
) -> "tuple[Config, list[str]]":
    """Read a config as `read`; return it, and a line for each thing that is worth knowing of it (``NOTES``).

    One that `is_checked`, as by the process that started this one, is not checked again and has no notes.
    """
    located = _composed(*paths, command_line=command_line, source=source)
    absent = _absent(located)
    located = Located({k: v for k, v in located.content.items() if k not in absent}, located.location)
    if is_checked:
        from bladerub.config.quantities import converted
        from bladerub.settings.study import typed

        return typed(converted(located)[0].plain()), []
    config = validate(located)
    notes = (note for list_notes in plugins.loaded("NOTES").values() for note in list_notes(config))
    return config, [*(f"{name}: left out, what reads it is not installed" for name in absent), *notes]


def vary(config: "Config", *variations: Located) -> Located:
    """Lay variations of a plan over a config, without a check."""
    parts = (part for part in variations if part.content is not None)
    return reduce(Located.merged, parts, Located.of(config.plain()))


def validate(config: Located | Mapping[str, Any], variation: str = "") -> "Config":
    """Check a config by its models and for what they cannot say, and return it.

    It is from `bladerub.config.files.compose`, or values alone, whose problems then have no file and line.
    The text of each problem begins with `variation`, the name of this variation of the study. Raises
    `ConfigError` with every problem found, one line each: location, key, value and what would be right. What
    models cannot say is checked for those sections that agree with theirs.
    """
    # it takes half a second to import, `bladerub --help` and jobs on a cluster do without
    from bladerub.config import checks, problems, quantities
    from bladerub.settings.study import required, typed

    given = config if isinstance(config, Located) else Located.of(config)
    located, texts = quantities.converted(given)
    values, locations = located.plain(), located.locations()
    texts += [*quantities.mixed(given), *problems.problems(values)]
    broken = (required() - values.keys()) | set(map(top_key, texts))
    checked = typed(values, broken)
    texts += checks.check(checked, broken)
    if texts:
        as_typed = quantities.as_typed(given, located)
        causes = [text for text in texts if problems.NOT_KNOWN not in text]
        raise ConfigError(
            Problem(location_of(text, locations), (f"{variation}: " if variation else "") + as_typed(text))
            for text in dict.fromkeys(causes or texts)
        )
    return checked


def _composed(*paths: str | Path, **command_line: Any) -> Located:
    """Lay files and the command line over the defaults of what plugs in."""
    from bladerub.settings.study import defaults

    return Located.of(defaults()).merged(compose(*paths, **command_line))


def _absent(config: Located) -> list[str]:
    """List the sections that the published schema has, and no part of this installation."""
    from bladerub.settings.study import whole

    unknown = [name for name in config.content if name not in whole().model_fields]
    if not unknown or not SCHEMA.is_file():
        return []
    published = json.loads(SCHEMA.read_text(encoding="utf-8"))["properties"]
    return [name for name in unknown if name in published]


def location_of(problem: str, locations: Mapping[str, Location], default: Location = UNKNOWN) -> Location:
    """Find the location of the key that a problem begins with, or of its innermost known group."""
    ends = (match.start() for match in re.finditer(r"[ :.[]", problem))
    keys = [problem[:end] for end in ends if problem[:end] in locations]
    return locations[keys[-1]] if keys else default
