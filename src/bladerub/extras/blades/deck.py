"""Decks of Abaqus and CalculiX as blocks: a keyword with its parameters, and the lines below it.

Comments are left out, files of ``*INCLUDE`` and of the parameter ``INPUT`` are read where they are named, as
seen from the folder of the deck. Keywords and names of parameters are in capitals; a keyword line that ends
with a comma goes on in the next line.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

MOST_FILES = 100
_ENCODING = {"encoding": "utf-8-sig", "errors": "replace"}


class Line(NamedTuple):
    """A line of data."""

    text: str
    place: str  # for messages: its number, with the file if that is included

    def cells(self) -> list[str]:
        """Cells between commas, without the empty one behind a comma at the end."""
        cells = [cell.strip().strip('"') for cell in self.text.split(",")]
        return cells if cells[-1] else cells[:-1]


class Block(NamedTuple):
    """A keyword and what belongs to it."""

    keyword: str  # with its star, as ``*SOLID SECTION``
    parameters: dict[str, str]  # without quotes, empty where there is no equals sign
    place: str
    lines: list[Line]


def number(text: str) -> float:
    """Read a number, whose exponent may have a D; empty is 0. Raises ValueError."""
    return float(re.sub("[dD]", "e", text)) if text else 0.0


def blocks(path: Path) -> list[Block]:
    """Read the blocks of the deck at `path`; a ValueError names the line of a file that is not there."""
    content: list[Block] = []
    for line in _lines(path, path.parent, (path.resolve(),)):
        if line.text.startswith("*"):
            keyword, parameters = _head(line.text)
            if keyword != "*INCLUDE":
                content.append(Block(keyword, parameters, line.place, []))
        elif content:
            content[-1].lines.append(line)
    return content


def included(path: Path) -> list[str]:
    """List the files that the deck at `path` reads, relative to its folder; raises ValueError as `blocks`."""
    lines = _lines(path, path.parent, (path.resolve(),))
    parameters = [_head(line.text)[1] for line in lines if line.text.startswith("*")]
    return list(dict.fromkeys(names["INPUT"] for names in parameters if "INPUT" in names))


def _head(text: str) -> tuple[str, dict[str, str]]:
    """Keyword and parameters of a keyword line."""
    keyword, *words = text.split(",")
    pairs = (word.partition("=") for word in words if word.strip())
    parameters = {" ".join(key.upper().split()): value.strip().strip('"') for key, _, value in pairs}
    return "*" + " ".join(keyword.strip("* ").upper().split()), parameters


def _lines(path: Path, folder: Path, chain: tuple[Path, ...]) -> Iterator[Line]:
    """Yield keyword lines, each whole in one, and lines of data; below a keyword those of its ``INPUT``."""
    prefix = f"{path.name}, " if len(chain) > 1 else ""
    head = ""
    with path.open(**_ENCODING) as stream:
        for count, raw in enumerate(stream, 1):
            text = raw.strip()
            if not text or text.startswith("**"):
                continue
            if not head and not text.startswith("*"):
                yield Line(text, f"{prefix}line {count}")
                continue
            head = f"{head} {text}" if head else text
            if head.endswith(","):
                continue
            line, head = Line(head, f"{prefix}line {count}"), ""
            yield line
            if (name := _head(line.text)[1].get("INPUT")) is not None:
                inner = folder / name
                if not inner.is_file():
                    raise ValueError(
                        f"{line.place}: it includes {name}, which is not in the folder of the deck"
                    )
                if inner.resolve() in chain or len(chain) >= MOST_FILES:
                    raise ValueError(f"{line.place}: it includes {name}, which includes itself")
                yield from _lines(inner, folder, (*chain, inner.resolve()))
