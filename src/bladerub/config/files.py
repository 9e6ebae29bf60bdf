"""Config files: YAML read with the location of every value, and laid over one another.

The limits below keep any file from running code, filling the memory or taking for ever.
"""

import os
import re
import stat
from collections.abc import Iterator, Mapping
from functools import reduce
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from bladerub.config.errors import UNKNOWN, ConfigError, Location, key_path
from bladerub.io.errors import format_value

LARGEST_FILE = 1_000_000  # bytes
MOST_VALUES = 100_000  # in a file, those of an alias counted wherever it is used
LONGEST_VALUE = 1000  # characters of a value or key
DEEPEST = 32  # levels of mappings and lists

_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+")
_FORTRAN = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[dD][-+]?\d+")
_NOT_DECIMAL = {
    "octal": re.compile(r"[-+]?0[0-7_]+"),
    "hexadecimal": re.compile(r"[-+]?0x[0-9a-fA-F_]+"),
    "binary": re.compile(r"[-+]?0b[01_]+"),
    "of base 60": re.compile(r"[-+]?[0-9][0-9_]*(:[0-5]?[0-9])+(\.[0-9_]*)?"),
}
_TEMPLATES = "__use_yte__"
_TAGS = {yaml.MappingNode: "tag:yaml.org,2002:map", yaml.SequenceNode: "tag:yaml.org,2002:seq"}


class Located(NamedTuple):
    """A value of a config and its location.

    The content is a `dict` of `Located` by key, a `list` of them, or a plain value; the location of a mapping
    is where it was last added to.
    """

    content: Any
    location: Location

    @classmethod
    def of(cls, value: Any, location: Location = UNKNOWN) -> "Located":
        """Give `value` and all that is in it the same location."""
        if isinstance(value, Mapping):
            return cls({str(key): cls.of(entry, location) for key, entry in value.items()}, location)
        if isinstance(value, list):
            return cls([cls.of(entry, location) for entry in value], location)
        is_of_numpy = type(value).__module__ == "numpy"
        return cls.of(value.tolist(), location) if is_of_numpy else cls(value, location)

    def plain(self) -> Any:
        """Return the values alone."""
        if isinstance(self.content, dict):
            return {key: entry.plain() for key, entry in self.content.items()}
        if isinstance(self.content, list):
            return [entry.plain() for entry in self.content]
        return self.content

    def merged(self, overlay: "Located") -> "Located":
        """Change a copy by what `overlay` holds: mappings merge, all else is replaced."""
        if not isinstance(self.content, dict) or not isinstance(overlay.content, dict):
            return overlay
        merged = dict(self.content)
        for key, value in overlay.content.items():
            merged[key] = merged[key].merged(value) if key in merged else value
        return Located(merged, overlay.location)

    def locations(self) -> dict[str, Location]:
        """Return the location of every value, by its path."""
        return {path: entry.location for path, entry in self.walk()}

    def walk(self, *parts: str | int) -> Iterator[tuple[str, "Located"]]:
        """Yield all that is in this, with its path behind `parts` as `key_path` writes it."""
        if isinstance(self.content, dict | list):
            pairs = self.content.items() if isinstance(self.content, dict) else enumerate(self.content)
            for part, entry in pairs:
                yield key_path((*parts, part)), entry
                yield from entry.walk(*parts, part)


def compose(
    *paths: str | Path, command_line: Mapping[str, Any] | None = None, source: str = "--config"
) -> Located:
    """Read YAML files, each laid over those before it, and the values of the command line over them all.

    `command_line` is what ``snakemake --config`` was given, below the top with numbers as text, and `source`
    what messages call it. Raises `ConfigError`, with file and line, for what is missing, no YAML, no mapping
    or beyond limits.
    """
    config = reduce(Located.merged, map(read, paths), Located({}, UNKNOWN))
    return config.merged(Located.of(_from_text(command_line or {}), Location(source)))


def read(path: str | Path, key: str | None = None, location: Location = UNKNOWN) -> Located:
    """Read one YAML file; `key` is the key that names it, if any; that it cannot be opened is reported there.

    Raises `ConfigError` as `compose`.
    """
    path = Path(path)
    absolute = Path(os.path.abspath(path))
    source = str(absolute.relative_to(Path.cwd()) if absolute.is_relative_to(Path.cwd()) else absolute)
    prefix, location = (f"{key} = {format_value(str(path))}: ", location) if key else ("", Location(source))
    try:
        about = os.stat(path)
        if not stat.S_ISREG(about.st_mode):
            kind = "is a folder" if stat.S_ISDIR(about.st_mode) else "is not a regular file"
            raise ConfigError.at(location, f"{prefix}{kind}, must be a YAML file")
        if about.st_size > LARGEST_FILE:
            raise ConfigError.at(location, f"{prefix}is larger than {LARGEST_FILE / 1e6:g} MB, no config is")
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise ConfigError.at(location, f"{prefix}cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise ConfigError.at(location, f"{prefix}is not text in UTF-8") from error
    try:
        located = _Loader(text).read(source)
    except yaml.YAMLError as error:
        if isinstance(error, yaml.reader.ReaderError):  # a character that YAML does not have
            before, problem = text[: error.position], error.reason
            line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
        else:
            line, column = error.problem_mark.line + 1, error.problem_mark.column + 1
            problem = " ".join(error.problem.split())
        what = f"not valid YAML ({problem}), column {column}"
        raise ConfigError.at(Location(source, line), what) from error
    if not isinstance(located.content, dict):
        raise ConfigError.at(Location(source), "must hold keys at its top level, as config/config.yaml does")
    if _TEMPLATES in located.content:
        reason = "is not for configs: Snakemake runs its templates"
        raise ConfigError.at(located.content[_TEMPLATES].location, f"{_TEMPLATES}: {reason}")
    return located


class _Loader(yaml.SafeLoader):
    """Reads one document into `Located` values; refuses a key given twice and what is beyond limits."""

    def __init__(self, text: str):
        super().__init__(text)
        self._depth = self._n_nodes = self._n_values = 0

    def read(self, source: str) -> Located:
        node = self.get_single_node()
        return Located(None, Location(source)) if node is None else self._located(node, source, 1)

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node:
        self._depth += 1
        self._n_nodes += 1
        _limit(self._depth, self._n_nodes, self.peek_event())
        node = super().compose_node(parent, index)
        if isinstance(node, yaml.ScalarNode) and len(node.value) > LONGEST_VALUE:
            kind = "key" if parent and index is None else "value"
            raise _error(f"a {kind} of more than {LONGEST_VALUE} characters", node)
        self._depth -= 1
        return node

    def _located(self, node: yaml.Node, source: str, depth: int) -> Located:
        self._n_values += 1
        _limit(depth, self._n_values, node)
        location = Location(source, node.start_mark.line + 1)
        if isinstance(node, yaml.ScalarNode):
            return Located(self.scalar(node), location)
        if node.tag != _TAGS[type(node)]:
            raise _error(f"the tag {format_value(node.tag)} is not for configs", node)
        if isinstance(node, yaml.SequenceNode):
            return Located([self._located(entry, source, depth + 1) for entry in node.value], location)
        content: dict[str, Located] = {}
        for key_node, entry in node.value:
            key = self._key(key_node, entry)
            if key in content:
                raise _error(f"{key_path([key])} is given twice", key_node)
            value = self._located(entry, source, depth + 1)
            content[key] = value._replace(location=Location(source, key_node.start_mark.line + 1))
        return Located(content, location)

    @staticmethod
    def _key(node: yaml.Node, entry: yaml.Node) -> str:
        if not isinstance(node, yaml.ScalarNode):
            raise _error("a key must be text", node)
        if node.tag == "tag:yaml.org,2002:merge":
            raise _error("<< is not for configs: lay one file over another, or write the keys out", node)
        if node.tag != "tag:yaml.org,2002:str":
            is_decimal = node.value.isdecimal() and entry.value == ""  # what follows the comma of 0,01
            cause = "; the decimal mark is a point" if is_decimal else ""
            raise _error(f"a key must be text, write {format_value(node.value)}{cause}", node)
        return node.value

    def scalar(self, node: yaml.ScalarNode) -> Any:
        if yaml_reading(node.value) is not None:
            return node.value  # as text, which is no number: nobody means what YAML makes of it
        try:
            value = self.construct_object(node)
        except yaml.YAMLError:
            raise
        except Exception as error:  # the text may not hold what its tag or its form promises
            raise _error(f"{format_value(node.value)} is no {node.tag.rsplit(':', 1)[-1]}", node) from error
        # YAML 1.1 leaves numbers such as 1e-3 as text
        is_plain = isinstance(value, str) and node.style is None
        return float(value) if is_plain and _NUMBER.fullmatch(value) else value


def yaml_reading(text: str) -> str | None:
    """Say what YAML 1.1 makes of a number that is not in decimals, ``16, as octal``; None of others."""
    kind = next((name for name, form in _NOT_DECIMAL.items() if form.fullmatch(text)), None)
    return kind and f"{yaml.safe_load(text)}, as {kind}"


def decimal_form(text: str) -> str | None:
    """Write a number with the exponent of Fortran, or with leading zeros, as YAML has it; None of others."""
    if _FORTRAN.fullmatch(text):
        return text.lower().replace("d", "e")
    return str(int(text)) if text.isdecimal() and text.startswith("0") else None


def _limit(depth: int, number: int, node: yaml.Node | yaml.Event) -> None:
    if depth > DEEPEST:
        raise _error(f"more than {DEEPEST} levels in one another", node)
    if number > MOST_VALUES:
        raise _error(f"more than {MOST_VALUES} values, aliases counted wherever they are used", node)


def _error(problem: str, node: yaml.Node | yaml.Event) -> yaml.MarkedYAMLError:
    return yaml.MarkedYAMLError(problem=problem, problem_mark=node.start_mark)


def _from_text(value: Any) -> Any:
    """Read text as YAML would, were it written without quotes, in all that is in `value`."""
    if isinstance(value, Mapping):
        return {key: _from_text(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [_from_text(entry) for entry in value]
    if not isinstance(value, str):
        return value
    loader = _Loader("")
    tag = loader.resolve(yaml.ScalarNode, value, (True, False))
    try:
        return loader.scalar(yaml.ScalarNode(tag, value, yaml.Mark("", 0, 0, 0, None, None)))
    except yaml.YAMLError:  # it only looks like a number or a date
        return value
