r"""Numbers and verdicts that Markdown pages quote from tables.

A number stands between two comments, the first of which holds its source:
``<!-- = findings('C1a').measured | fixed(2) -->0.39<!-- / -->``. A sentence that rests on verdicts carries
them: ``<!-- C6a C6c: partly -->``. Both are invisible on the rendered page. An expression is of Jinja. A
table is called with the values of its first columns and answers with the one row that has them; its `column`
lists a column for the filters ``sum``, ``max`` and ``min``, over the rows that have the values it is given.
Its `commit` is that of the program that computed it. Its `rows` are the table as pandas has it, for what
these cannot say; the filter ``table`` writes such rows as a table of Markdown, between lines that hold
nothing but the comments. It may be told which columns, how each is written, and under which heading:
``table('E', 'error:percent(2) = error, %')``.
A pipe in a row of a Markdown table is written ``\|``, since it would end the cell.
"""

import difflib
import math
import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache, partial
from pathlib import Path
from typing import Any

import pandas as pd
from jinja2 import Environment, StrictUndefined, TemplateError, meta

from bladerub.io import tables
from bladerub.io.folders import BENCHMARKS

MARK = re.compile(r"<!-- (?:= (?P<source>.+?)|(?P<end>/)) -->")
VERDICT = re.compile(r"<!-- (?P<claims>C\d+[a-z]?(?: C\d+[a-z]?)*): (?P<verdict>yes|partly|no) -->")


class PageError(ValueError):
    """A page cannot be rendered; the message names page and line."""


class Table:
    """A table as expressions of pages see it."""

    def __init__(self, name: str, rows: pd.DataFrame, origin: Mapping[str, str]) -> None:
        self.name, self.rows = name, rows
        self.commit = origin.get("provenance_git_commit", "")[:7]

    def __call__(self, *key: Any) -> dict[str, Any]:
        """Return the one row whose first columns are `key`, with its numbers as numbers."""
        rows = self._select(dict(zip(self.rows.columns, key, strict=False)))
        if len(rows) != 1:
            raise LookupError(f"{self.name}{key}: {len(rows)} rows")
        return {column: _number(value) for column, value in rows.iloc[0].items()}

    def count(self, **values: Any) -> int:
        """Count the rows that have `values` in the columns of these names; a list holds alternatives."""
        return len(self._select(values))

    def column(self, column: str, **values: Any) -> list[Any]:
        """Return `column` of the rows that `count` counts."""
        return list(self._select(values)[column])

    def _select(self, values: Mapping[str, Any]) -> pd.DataFrame:
        rows = self.rows
        for column, value in values.items():
            rows = rows[rows[column].isin(value if isinstance(value, list) else [value])]
        return rows


def read_tables(folder: Path) -> dict[str, Table]:
    """Read the snapshots in `folder`, and the reference numbers, as ``rotor37_direct``."""
    paths = {path.stem: path for path in folder.glob("*.csv")}
    paths |= {f"{path.parent.name}_{path.stem}": path for path in BENCHMARKS.glob("*/*.csv")}
    return {name: Table(name, tables.read(path), tables.read_origin(path)) for name, path in paths.items()}


def pages_of(root: Path) -> list[Path]:
    """Return the pages of the repository at `root` that may quote numbers: those written by hand."""
    folders = ("explanation", "how-to", "reference", "tutorials")
    return [
        root / "README.md",
        *(root / "docs" / f"{name}.md" for name in ("laws", "rotor", "rotor37")),
        *(page for name in folders for page in sorted((root / "docs" / name).glob("*.md"))),
    ]


def render(text: str, page: str, data: Mapping[str, Table]) -> str:
    """Return `text` with each number replaced by the value of its source.

    Raises `PageError`, which names page and line, for a bad expression or a missing comment.
    """
    pieces, position, opened = [], 0, None
    for mark in MARK.finditer(text):
        place = f"{page}:{_line(text, mark.start())}"
        if bool(mark["end"]) != bool(opened):
            raise PageError(
                f"{place}: {'no number begins' if mark['end'] else 'the number before has no end'}"
            )
        if mark["end"]:
            pieces.append(_value(opened["source"].replace("\\|", "|"), data, place))
        else:
            pieces.append(text[position : mark.end()])
        position, opened = (mark.start(), None) if mark["end"] else (mark.end(), mark)
    if opened:
        raise PageError(f"{page}:{_line(text, opened.start())}: the number has no end <!-- / -->")
    return "".join([*pieces, text[position:]])


def differences(text: str, page: str, data: Mapping[str, Table]) -> list[str]:
    """Name page, line and text of each stale number and each changed verdict; raise as `render`."""
    problems, lines = [], text.split("\n")
    for first, end, replacement in _changes(lines, render(text, page, data).split("\n")):
        for number in range(first, max(end, first + 1)):
            new = replacement[number - first] if number - first < len(replacement) else "no such line"
            problems.append(f"{page}:{number + 1}: stale number, now: {new}")
    for number, old in enumerate(lines, 1):
        for mark in VERDICT.finditer(old):
            try:
                verdicts = {claim: data["findings"](claim)["holds"] for claim in mark["claims"].split()}
            except LookupError as error:
                raise PageError(f"{page}:{number}: {error}") from error
            changed = [
                f"{claim} is {verdict}" for claim, verdict in verdicts.items() if verdict != mark["verdict"]
            ]
            if changed:
                problems.append(
                    f"{page}:{number}: written for {mark['verdict']}, {', '.join(changed)}: {old}"
                )
    return problems


def _changes(old: list[str], new: list[str]) -> Iterator[tuple[int, int, list[str]]]:
    """List the ranges of lines of `old` that differ, with the lines of `new` in their place."""
    if len(old) == len(new):
        yield from ((index, index + 1, [new[index]]) for index, line in enumerate(old) if line != new[index])
        return
    matcher = difflib.SequenceMatcher(None, old, new, autojunk=False)
    for tag, first, end, start, stop in matcher.get_opcodes():
        if tag != "equal":
            yield first, end, new[start:stop]


def _value(source: str, data: Mapping[str, Table], place: str) -> str:
    try:
        names, evaluate = _compiled(source)
        if missing := names - {*data}:
            raise LookupError(f"docs/data has no {', '.join(sorted(missing))}.csv")
        return str(evaluate(**data))
    except (TemplateError, LookupError, TypeError, ValueError) as error:
        raise PageError(f"{place}: {source}: {error}") from error


@cache
def _compiled(source: str) -> tuple[set[str], Callable[..., Any]]:
    """Return the tables that the expression `source` quotes, and the function that evaluates it."""
    environment = Environment(undefined=StrictUndefined, autoescape=False)
    environment.filters |= {**_FORMS, "table": _table}
    names = meta.find_undeclared_variables(environment.parse(f"{{{{ {source} }}}}"))
    return names - {*environment.globals}, environment.compile_expression(source, undefined_to_none=False)


def _line(text: str, position: int) -> int:
    return text.count("\n", 0, position) + 1


def _number(value: Any) -> Any:
    try:
        return float(value)
    except (TypeError, ValueError):
        return value


def _fixed(value: float, digits: int = 0) -> str:
    return f"{value:.{digits}f}"


def _percent(value: float, digits: int = 0) -> str:
    return f"{100 * value:.{digits}f}"


def _mm(value: float, digits: int = 1) -> str:
    return f"{1000 * value:.{digits}f}"


def _significant(value: float, digits: int = 3) -> str:
    return f"{value:.{digits}g}"


def _degrees(value: float, digits: int = 1) -> str:
    return f"{math.degrees(value):.{digits}f}"


_FORMS = {"fixed": _fixed, "percent": _percent, "mm": _mm, "degrees": _degrees, "significant": _significant}
"""Filters that write a number with so many digits."""
_COLUMN = re.compile(
    rf"(?P<name>\w+)(?::(?P<form>{'|'.join(_FORMS)})\((?P<digits>\d)\))?(?: = (?P<heading>.+))?"
)


def _table(rows: pd.DataFrame, *columns: str) -> str:
    """Write `rows` as a table of Markdown; what is missing leaves its cell empty.

    Each of `columns` is a name, perhaps with a filter and a heading: ``wear:mm(2) = wear, mm``. Without them
    all are written as they are.
    """
    layout = [_column(column) for column in columns] or [(name, str, name) for name in rows.columns]
    cells = [["" if pd.isna(value) else write(value) for value in rows[name]] for name, write, _ in layout]
    lines = [[heading for *_, heading in layout], ["---"] * len(layout), *zip(*cells, strict=True)]
    return "\n" + "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _column(text: str) -> tuple[str, Callable[[Any], str], str]:
    """Return name of the column, what writes a value of it, and its heading."""
    parts = _COLUMN.fullmatch(text)
    if not parts:
        raise ValueError(f"{text}: must be a column, with filter and heading as in 'wear:mm(2) = wear, mm'")
    form = partial(_FORMS[parts["form"]], digits=int(parts["digits"])) if parts["form"] else str
    return parts["name"], form, parts["heading"] or parts["name"]
