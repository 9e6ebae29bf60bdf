"""Digests of the package's own sources: results and machine code are valid for the code that made them."""

import ast
import hashlib
import json
import re
from collections.abc import Iterable, Set
from functools import cache
from pathlib import Path

from bladerub.io.folders import PACKAGE

COMPUTING = {"blade", "contact", "study"}  # subpackages whose code determines numbers


def files_behind(*modules: str) -> list[str]:
    """List the source files of modules and of what they import, directly or not, from their own subpackages.

    Snakemake does not follow imports. What is computed in other subpackages reaches a rule by the files that
    it reads. Extras compute with the core themselves: of theirs, imports from `COMPUTING` are followed, too.
    Modules are named below ``bladerub``, such as ``"study.maps"``. The paths are sorted, and those of the
    repository if it is the working directory.
    """
    repository = PACKAGE.parents[1]
    further = COMPUTING if any(module.startswith("extras.") for module in modules) else set()
    names = ((path, path.relative_to(repository)) for path in _paths_behind(modules, further))
    return sorted((name if name.is_file() else path).as_posix() for path, name in names)


def digest_behind(*modules: str) -> str:
    """Digest the sources of modules and of what they import, from their own subpackages alone."""
    return source_digest(_paths_behind(modules))


def _paths_behind(modules: Iterable[str], further: Set[str] = frozenset()) -> set[Path]:
    subpackages = {module.partition(".")[0] for module in modules} | further
    paths, queue = set(), list(modules)
    while queue:
        path = _path_of(queue.pop())
        if path not in paths:
            paths.add(path)
            queue += [name for name in _imports(path) if name.partition(".")[0] in subpackages]
    return paths


@cache
def _path_of(module: str) -> Path:
    path = PACKAGE.joinpath(*module.split("."))
    package = path / "__init__.py"
    return package if package.is_file() else path.with_suffix(".py")


# Whole files are not parsed: every call of snakemake reads some two hundred of them
_IMPORT = re.compile(r"^([ \t]*)(from bladerub\.[\w.]+ import (?:\([^)]*\)|.*))$", re.M)
_EXTRA = re.compile(r"\bextras(?:\.\w+)+")


def extras_behind(*sources: str) -> set[str]:
    """Name folders and modules of `bladerub.extras` that sources name, or what these import at their top."""
    names = {name for source in sources for name in _EXTRA.findall(source)}
    seen: set[str] = set()
    while new := names - seen:
        seen |= new
        for path in filter(Path.is_file, map(_path_of, new)):
            source = path.read_text(encoding="utf-8")
            names |= {name for name, is_at_top in _named_in(source) if is_at_top}
    return {name.split(".")[1] for name in names if name.startswith("extras.")}


@cache
def _imports(path: Path) -> tuple[str, ...]:
    return imports_in(path.read_text(encoding="utf-8"))


def imports_in(source: str) -> tuple[str, ...]:
    """Modules of this package that a source imports, wherever in it."""
    return tuple(name for name, _ in _named_in(source) if _path_of(name).is_file())


@cache
def _named_in(source: str) -> tuple[tuple[str, bool], ...]:
    """Name modules of this package, or objects of them, that a source imports, and whether at its top."""
    names: list[tuple[str, bool]] = []
    for indent, statement in _IMPORT.findall(source):
        (node,) = ast.parse(statement).body
        base = node.module.removeprefix("bladerub.")
        names += [(name, not indent) for name in (base, *(f"{base}.{alias.name}" for alias in node.names))]
    return tuple(names)


@cache
def digest_of(*names: str) -> str:
    """Digest files of the package, and those of Python in folders, by their paths in it."""
    paths = [PACKAGE / name for name in names]
    return source_digest(file for path in paths for file in ([path] if path.suffix else path.rglob("*.py")))


def source_digest(paths: Iterable[Path]) -> str:
    """Digest sources of the package, named by their paths in it, but not what only describes a config."""
    digest = hashlib.sha256()
    for path in sorted(path for path in paths if path.name != "settings.py"):
        # universal newlines: a checkout with other line ends is the same source
        entry = [path.relative_to(PACKAGE).as_posix(), path.read_text(encoding="utf-8")]
        digest.update(json.dumps(entry).encode())
    return digest.hexdigest()
