"""Config files: YAML read with the place of every value, and laid over one another.

A file can extend others (key ``extend``): they are read first, and it is laid over them. Files are read with
bounds, so that none of them can run code, fill the memory or take for ever.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from bladerub.config.errors import UNKNOWN, ConfigError, Fault, Place, key_path, shown

LARGEST_FILE = 1_000_000
"""Bytes of a config file."""

MOST_VALUES = 100_000
"""Values in a config file, those of an alias counted wherever it stands."""

LONGEST_VALUE = 1000
"""Characters of one value or key."""

DEEPEST = 32
"""Levels of mappings and lists in one another."""

MOST_EXTENDED = 20
"""Files that are read because one extends the other."""

COMMAND_LINE = Place("--config")

_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+")
_TAGS = {yaml.MappingNode: "tag:yaml.org,2002:map", yaml.SequenceNode: "tag:yaml.org,2002:seq"}
_TEXT = "tag:yaml.org,2002:str"


class Marked(NamedTuple):
    """A value of a config and its place.

    Parameters
    ----------
    content : object
        A `dict` of `Marked` by key, a `list` of them, or a plain value.
    place : Place
        Where it stands; that of a mapping is where it was last added to.
    """

    content: Any
    place: Place


def compose(*paths: str | Path, command_line: Mapping[str, Any] | None = None) -> Marked:
    """Read YAML files, each laid over those before it, and the values of the command line over them all.

    Parameters
    ----------
    paths : path-like
        The files; each is laid over those that it extends.
    command_line : mapping, optional
        What ``snakemake --config`` was given; below the top, Snakemake leaves numbers as text. A key
        ``extend`` names files as seen from the working directory.

    Raises
    ------
    ConfigError
        If a file is missing, is not YAML, not a mapping or beyond bounds; names the file and the line.
    """
    layers = [read(path) for path in paths]
    if command_line:
        layers.append(extended(mark(_from_text(command_line), COMMAND_LINE)))
    whole = Marked({}, UNKNOWN)
    for layer in layers:
        whole = lay_over(whole, layer)
    return whole


def lay_over(base: Marked, overlay: Marked) -> Marked:
    """Change `base` by what `overlay` holds, into a copy: mappings merge, all else is replaced."""
    if not isinstance(base.content, dict) or not isinstance(overlay.content, dict):
        return overlay
    merged = dict(base.content)
    for key, value in overlay.content.items():
        merged[key] = lay_over(merged[key], value) if key in merged else value
    return Marked(merged, overlay.place)


def mark(value: Any, place: Place) -> Marked:
    """Give `value` and all that is in it the same place."""
    if isinstance(value, Mapping):
        return Marked({str(key): mark(entry, place) for key, entry in value.items()}, place)
    if isinstance(value, list):
        return Marked([mark(entry, place) for entry in value], place)
    return Marked(value, place)


def plain(marked: Marked) -> Any:
    """Return the values alone."""
    if isinstance(marked.content, dict):
        return {key: plain(entry) for key, entry in marked.content.items()}
    if isinstance(marked.content, list):
        return [plain(entry) for entry in marked.content]
    return marked.content


def places(marked: Marked) -> dict[str, Place]:
    """Return the place of every value, by its path as `bladerub.config.errors.key_path` writes it."""
    return {key_path(parts): place for parts, place in _walk(marked, ()) if parts}


def _walk(marked: Marked, parts: tuple) -> Iterator[tuple[tuple, Place]]:
    yield parts, marked.place
    inner = marked.content
    pairs = inner.items() if isinstance(inner, dict) else enumerate(inner) if isinstance(inner, list) else ()
    for part, entry in pairs:
        yield from _walk(entry, (*parts, part))


def read(path: str | Path, key: str | None = None) -> Marked:
    """Read one YAML file and those that it extends.

    Parameters
    ----------
    path : path-like
        The file.
    key : str, optional
        The key of the config that names it, told if the file cannot be read.

    Raises
    ------
    ConfigError
        As for `compose`.
    """
    path = Path(path)
    asked, said = (UNKNOWN, f"{key} = {shown(str(path))}: ") if key else (Place(_name(path)), "")
    return _extended(_read(path, asked, said), [], (os.path.realpath(path),))


def extended(layer: Marked) -> Marked:
    """Lay the mapping `layer` over the files that its key ``extend`` names.

    Raises
    ------
    ConfigError
        As for `compose`; the place is that of the name which is at fault.
    """
    return _extended(layer, [], ())


def _extended(layer: Marked, opened: list[Path], chain: tuple[str, ...]) -> Marked:
    if not isinstance(layer.content, dict) or "extend" not in layer.content:
        return layer
    whole = Marked({}, layer.place)
    for name in _names(layer.content["extend"]):
        folder = Path(name.place.source).parent if name.place.line else Path()
        path, said = folder / name.content, f"extend = {shown(name.content)}: "
        real = os.path.realpath(path)
        if real in chain:
            raise ConfigError([Fault(name.place, f"{said}these files extend each other in a circle")])
        opened.append(path)
        if len(opened) > MOST_EXTENDED:
            raise ConfigError([Fault(name.place, f"{said}must not lead to more than {MOST_EXTENDED} files")])
        base = _extended(_read(path, name.place, said), opened, (*chain, real))
        whole = lay_over(whole, base)
    own = {key: value for key, value in layer.content.items() if key != "extend"}
    return lay_over(whole, Marked(own, layer.place))


def _names(entry: Marked) -> list[Marked]:
    names = entry.content if isinstance(entry.content, list) else [entry]
    for name in names:
        is_file = isinstance(name.content, str) and re.fullmatch(r"[^\0]+\.ya?ml", name.content)
        if not is_file or "://" in name.content:
            right = "the path of a .yaml file, or a list of such, as seen from the file that says so"
            raise ConfigError([Fault(name.place, f"extend = {shown(plain(name))}: must be {right}")])
    return names


def _name(path: Path) -> str:
    """Write `path` as seen from the working directory, if it is below that."""
    path = Path(os.path.abspath(path))
    return str(path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path)


def _read(path: Path, asked: Place, said: str) -> Marked:
    """Read one YAML file; that it cannot be read is told at the place that `asked` for it."""
    try:
        about = os.stat(path)
        if not stat.S_ISREG(about.st_mode):
            kind = "is a folder" if stat.S_ISDIR(about.st_mode) else "is not a regular file"
            raise ConfigError([Fault(asked, f"{said}{kind}, must be a YAML file")])
        if about.st_size > LARGEST_FILE:
            raise ConfigError([Fault(asked, f"{said}is larger than {LARGEST_FILE / 1e6:g} MB, no config is")])
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise ConfigError([Fault(asked, f"{said}cannot be read ({error.strerror})")]) from error
    except UnicodeDecodeError as error:
        raise ConfigError([Fault(asked, f"{said}is not text in UTF-8")]) from error
    source = _name(path)
    try:
        marked = _Loader(text).read(source)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = mark.line + 1 if mark else _line_of(text, getattr(error, "position", None))
        problem = getattr(error, "problem", None) or getattr(error, "reason", None) or str(error)
        fault = Fault(Place(source, line), f"not valid YAML ({' '.join(problem.split())})")
        raise ConfigError([fault]) from error
    if not isinstance(marked.content, dict):
        problem = "must hold keys at its top level, such as those of config/config.yaml"
        raise ConfigError([Fault(Place(source), problem)])
    return marked


def _line_of(text: str, position: int | None) -> int:
    return 0 if position is None else text.count("\n", 0, position) + 1


class _Loader(yaml.SafeLoader):
    """Reads one document into `Marked` values; a key given twice and what is beyond bounds are faults."""

    def __init__(self, text: str):
        super().__init__(text)
        self._depth = self._n_nodes = self._n_values = 0

    def read(self, source: str) -> Marked:
        node = self.get_single_node()
        return Marked(None, Place(source)) if node is None else self._marked(node, source, 1)

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node:
        self._depth += 1
        self._n_nodes += 1
        self._check(self._depth, self._n_nodes, self.peek_event().start_mark)
        node = super().compose_node(parent, index)
        self._depth -= 1
        return node

    def _marked(self, node: yaml.Node, source: str, depth: int) -> Marked:
        self._n_values += 1
        self._check(depth, self._n_values, node.start_mark)
        place = Place(source, node.start_mark.line + 1)
        if isinstance(node, yaml.ScalarNode):
            return Marked(self.scalar(node), place)
        if node.tag != _TAGS[type(node)]:
            raise _problem(f"the tag {shown(node.tag)} is not for configs", node)
        if isinstance(node, yaml.SequenceNode):
            return Marked([self._marked(entry, source, depth + 1) for entry in node.value], place)
        content: dict[str, Marked] = {}
        for key_node, entry in node.value:
            key = self._key(key_node)
            if key in content:
                raise _problem(f"{key_path([key])} is given twice", key_node)
            value = self._marked(entry, source, depth + 1)
            content[key] = value._replace(place=Place(source, key_node.start_mark.line + 1))
        return Marked(content, place)

    @staticmethod
    def _check(depth: int, number: int, mark: yaml.Mark) -> None:
        if depth > DEEPEST:
            problem = f"more than {DEEPEST} levels in one another"
        elif number > MOST_VALUES:
            problem = f"more than {MOST_VALUES} values, aliases counted wherever they stand"
        else:
            return
        raise yaml.MarkedYAMLError(problem=problem, problem_mark=mark)

    @staticmethod
    def _key(node: yaml.Node) -> str:
        if not isinstance(node, yaml.ScalarNode):
            raise _problem("a key must be text", node)
        if len(node.value) > LONGEST_VALUE:
            raise _problem(f"a key of more than {LONGEST_VALUE} characters", node)
        if node.tag != _TEXT:
            raise _problem(f"a key must be text, write {shown(node.value)}", node)
        return node.value

    def scalar(self, node: yaml.ScalarNode) -> Any:
        if len(node.value) > LONGEST_VALUE:
            raise _problem(f"a value of more than {LONGEST_VALUE} characters", node)
        try:
            value = self.construct_object(node)
        except yaml.YAMLError:
            raise
        except Exception as error:  # the text may not hold what its tag or its form promises
            raise _problem(f"{shown(node.value)} is no {node.tag.rsplit(':', 1)[-1]}", node) from error
        return _number(value) if isinstance(value, str) else value


def _problem(problem: str, node: yaml.Node) -> yaml.MarkedYAMLError:
    return yaml.MarkedYAMLError(problem=problem, problem_mark=node.start_mark)


def _number(text: str) -> float | str:
    """Read numbers such as 1e-3, which YAML 1.1 leaves as text."""
    return float(text) if _NUMBER.fullmatch(text) else text


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
