"""Tables of blade sections as text: which file is one, the names of its columns and the cells of its rows.

Nothing here takes time to import, so that a wrong table is refused at once.
"""

import re
from pathlib import Path
from typing import NamedTuple

from bladerub.blade.sources import origin

POINTS = ("x1", "y1", "z1", "x2", "y2", "z2")
CYLINDRICAL = ("z", "r", "theta1", "theta2")
_LOOKED_THROUGH = 50  # lines, for names below a title
_SEPARATORS = {";": "semicolons", ",": "commas", None: "white space"}


class Cells(NamedTuple):
    """Cells of a table, as text."""

    names: list[str]  # of the columns, in small letters
    rows: dict[int, list[str]]  # by the line of the file
    form: list[str]  # the columns that are read: section and those of the form that the table has


def read(path: Path) -> Cells:
    """Read the cells of all rows; a ValueError names the line or says what is no table of sections."""
    origin.check_file(path)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        text = "\0"
    if "\0" in text:
        raise ValueError("is not text in UTF-8")
    bare = {number: line.split("#")[0].strip() for number, line in enumerate(text.splitlines(), 1)}
    content = {number: line for number, line in bare.items() if line}
    if not content:
        raise ValueError("is empty")
    header, *lines = content
    separator = next((mark for mark in _SEPARATORS if mark and mark in content[header]), None)
    cells = {line: [cell.strip(' "') for cell in content[line].split(separator)] for line in content}
    names = [name.lower() or f"column {number}" for number, name in enumerate(cells.pop(header), 1)]
    try:
        wanted = ["section", *_form(set(names))]
    except ValueError as error:
        what = f"line {header} must name the columns; cells separated by {_SEPARATORS[separator]}"
        raise ValueError(f'{error} ({what}: "{content[header][:60]}"{_likely_names(content)})') from error
    if separator != ",":
        cells = {line: [cell.replace(",", ".") for cell in row] for line, row in cells.items()}
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise ValueError(f"line {header}: has the column {', '.join(sorted(twice))} twice")
    if not lines:
        raise ValueError("has no rows below the names of its columns")
    for line, row in cells.items():
        if len(row) != len(names):
            raise ValueError(f"line {line}: has {len(row)} cells, must have {len(names)} as the header has")
    return Cells(names, cells, wanted)


def _likely_names(content: dict[int, str]) -> str:
    """Point out a line below the first that seems to name the columns, as in files with a title."""
    for line, text in list(content.items())[1:_LOOKED_THROUGH]:
        words = re.sub(r"(?<=[a-z]) (?=[12]\b)", "", text.lower().replace(",", " ").replace(";", " ")).split()
        if any(len(set(form).intersection(words)) >= len(form) - 1 for form in (POINTS, CYLINDRICAL)):
            return f', and not line {line}: "{text[:60]}"'
    return ""


def _form(columns: set[str]) -> tuple[str, ...]:
    """Choose the form that `columns` belong to."""
    known = [form for form in (POINTS, CYLINDRICAL) if columns.issuperset(form)]
    if len(known) == 1 and "section" in columns:
        return known[0]
    both = f"section, {', '.join(POINTS)} or section, {', '.join(CYLINDRICAL)}"
    if len(known) == 2:
        raise ValueError(f"has the columns of both forms; must have either {both}")
    near = max((POINTS, CYLINDRICAL), key=lambda form: len(columns.intersection(form)))
    form = ("section", *(known[0] if known else near))
    missing = [name for name in form if name not in columns]
    wanted = ", ".join(form) if len(missing) < len(form) else both
    raise ValueError(f"has no column {', '.join(missing)}; must have {wanted}")
