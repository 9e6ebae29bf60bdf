"""Tables as other programs and people write them: their cells as text, by the line of the file.

The first line that is neither empty nor a comment names the columns; what follows a ``#`` is a comment. Of
semicolons, tabs, commas and white space, the first that this line has separates the cells, in all lines.
Numbers may have decimal commas unless commas separate the cells, and exponents as Fortran writes them
(``1.0D+02``). Every row must have as many cells as there are columns, so that no cell gets into the column
beside its own: that is checked where a column is taken, so that a line that does not name the columns is told
first. Tables of our own are those of `bladerub.io.tables`.
"""

import csv
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bladerub.settings import units

LARGEST_FILE = 100_000_000  # bytes
UNITS = {name: float(size) for name, size in units.UNITS["length"].items()}  # m
ANGLE_UNITS = {name: float(size) for name, size in units.UNITS["angle"].items()}  # rad
_SEPARATORS = {";": "semicolons", "\t": "tabs", ",": "commas", None: "white space"}
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eEdD][-+]?\d+)?", re.ASCII)
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}", re.ASCII)
_COMMENT = re.compile(r"#(?!N/?[AV]\b|[A-Z/0]+[!?]).*")  # but an error of a spreadsheet, as #DIV/0!
_TWO_NUMBERS = re.compile(r"[-+]?\d*\.\d{2,}([eEdD][-+]?\d+)?[-+]?\d*\.\d", re.ASCII)
_STATED_SEPARATOR = re.compile(r"sep=(.)")  # the first line of a CSV, in some spreadsheets


class Cells(NamedTuple):
    """A table as text."""

    names: list[str]  # of the columns, as the file has them
    rows: dict[int, list[str]]  # cells by the line of the file, counted from 1
    header: int  # the line that names the columns
    separator: str  # of the cells, in words

    def require(self, *names: str) -> None:
        """Check that there are columns `names`, in small letters; a ValueError names those that are not."""
        columns = [column.lower() for column in self.names]
        missing = [name for name in names if name not in columns]
        if missing:
            bare = {re.split(r"\s*[\[(]", column)[0] for column in columns}
            cure = "; no unit may stand behind a name" if bare.issuperset(missing) else ""
            rule = f"line {self.header} must name {', '.join(names)}, separated as the cells below"
            raise ValueError(f"has no column {', '.join(missing)}; {rule} ({self.separator} here){cure}")

    def column(self, name: str) -> list[str]:
        """Return the cells of a column (in any case); ValueError names a line with too many or too few."""
        lower = [column.lower() for column in self.names]
        if lower.count(name.lower()) > 1:
            raise ValueError(f"line {self.header}: has the column {name.lower()} twice")
        for line, row in self.rows.items():
            if len(row) != len(lower):
                fault = f"has {len(row)} cells, must have {len(lower)} as the header has"
                raise ValueError(f"line {line}: {fault} (separated by {self.separator}{self._cure(row)})")
        index = lower.index(name.lower())
        return [row[index] for row in self.rows.values()]

    def numbers(self, name: str, empty: float = np.nan) -> np.ndarray:
        """Return the numbers (n_rows,) of a column, `empty` for empty cells; ValueError names a bad line."""
        numbers, cells = [], self.column(name)
        for line, cell in zip(self.rows, cells, strict=True):
            text = self._with_point(cell)
            number = float(re.sub("[dD]", "e", text)) if _NUMBER.fullmatch(text) else np.nan
            numbers.append(number if text else empty)
            if not np.isfinite(numbers[-1]):
                fault = f"{name} = {cell[:40] or 'nothing'}, must be a finite number"
                raise ValueError(f"line {line}: {fault}{self._cure([cell])}")
        if self.separator != "commas" and any("," in cell for cell in cells):
            self._check_marks()
        return np.array(numbers, float)

    def _check_marks(self) -> None:
        """Refuse commas that separate thousands, or may do so."""
        cells = [(line, cell) for line, row in self.rows.items() for cell in row]
        numbers = [(line, cell) for line, cell in cells if _NUMBER.fullmatch(cell.replace(",", "."))]
        points = [(line, cell) for line, cell in numbers if "." in cell]
        commas = [(line, cell) for line, cell in numbers if "," in cell]
        if points and commas:
            (line, cell), (other_line, other) = points[0], commas[0]
            rule = "all numbers must have the same decimal mark, and none between thousands"
            raise ValueError(f"line {line} has {cell} and line {other_line} {other}; {rule}")
        if commas and all(_THOUSANDS.fullmatch(cell) for _, cell in commas):
            (line, cell), doubt = commas[0], "with a decimal comma, or one between thousands?"
            cure = f"Write {cell.replace(',', '.')} or {cell.replace(',', '')}"
            raise ValueError(f"line {line} has {cell}: {doubt} {cure}")

    def _with_point(self, cell: str) -> str:
        return cell if self.separator == "commas" else cell.replace(",", ".")

    def _cure(self, row: list[str]) -> str:
        """Say what a row has, or a cell: decimal commas, or two numbers, as Fortran fills its columns."""
        if self.separator == "commas" and len(row) > len(self.names):
            return "; with decimal commas, separate the cells by semicolons"
        for cell in row if len(row) == 1 or self.separator == "white space" else ():
            if _TWO_NUMBERS.match(self._with_point(cell)):
                return f'; "{cell[:40]}" holds two numbers: columns of fixed width need a blank between them'
        return ""


def read(path: Path) -> Cells:
    """Read a table; raises ValueError if the file cannot be read, is no text in UTF-8 or has no rows."""
    content = _lines(path)
    if not content:
        raise ValueError("is empty")
    header, *lines = content
    stated = _STATED_SEPARATOR.fullmatch(content[header])
    if stated and lines:
        header, *lines = lines
    marks = [stated[1]] if stated else [mark for mark in _SEPARATORS if mark and mark in content[header]]
    separator = next((mark for mark in marks if mark in _SEPARATORS), None)
    names = _split(content[header], separator)
    while not names[-1]:  # a spreadsheet writes its empty columns, and rows, too
        names.pop()
    names = [name or f"column {number}" for number, name in enumerate(names, 1)]
    rows = {}
    for line in lines:
        row = _split(content[line], separator)
        while len(row) > len(names) and not row[-1]:
            row.pop()
        rows[line] = row
    if not rows:
        raise ValueError("has no rows below the names of its columns")
    return Cells(names, rows, header, _SEPARATORS[separator])


def _lines(path: Path) -> dict[int, str]:
    """Lines with content, without comments, by number; none whose cells are all empty, as ``;;;``."""
    try:
        if not path.is_file():
            raise ValueError("there is no such file")
        if path.stat().st_size > LARGEST_FILE:
            raise ValueError(f"is larger than {LARGEST_FILE / 1e6:g} MB, no table is")
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        text = "\0"
    except OSError as error:
        raise ValueError(f"cannot be read ({error.strerror})") from error
    if "\0" in text:
        raise ValueError("is not text in UTF-8; save it as such (in a spreadsheet: CSV UTF-8)")
    bare = {number: _COMMENT.sub("", line).strip(" ") for number, line in enumerate(text.split("\n"), 1)}
    return {number: line for number, line in bare.items() if line.strip(' \t;,"')}


def _split(line: str, separator: str | None) -> list[str]:
    """Cells of a line; a cell in quotes may hold the separator."""
    if separator is None:
        return [cell.strip('"') for cell in line.split()]
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=separator, skipinitialspace=True))]
    except csv.Error as error:
        raise ValueError(f'"{line[:40]}": {error}') from error
