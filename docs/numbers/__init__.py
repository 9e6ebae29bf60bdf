"""Numbers that pages quote by name: ``{{ peak_rigid }}`` on a page is what the module of its name says here.

The module of the page of a study, ``studies/<name>/README.md``, is ``numbers.py`` beside it. A module has a
function, ``numbers(tables)``, which returns the text for each name. ``tables["peaks"]`` is the table of this
name in ``docs/data``, or in the folder ``data`` of a study, as pandas reads it; a name with slashes is a
table elsewhere in the repository. A text may be a whole table (`table`), alone on its line of the page. As an
extension of Sphinx this package makes the texts MyST substitutions of their page.
"""

import importlib.util
import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

import pandas as pd

from bladerub.io import tables as files

FOLDER = Path(__file__).parent
ROOT = FOLDER.parents[1]
_SYMBOLS = {"theta": "θ", "f_omega": "f_Ω"}


def data_folders(root: Path = ROOT) -> list[Path]:
    """Return the folders of tables that pages quote: that of the documents, and those of studies."""
    return [root / "docs" / "data", *sorted(root.glob("studies/**/data"))]


class Tables(dict[str, pd.DataFrame]):
    """Tables of the repository at `root` by name, read when asked for; ``attrs["commit"]`` made them."""

    def __init__(self, root: Path = ROOT) -> None:
        super().__init__()
        self.root = root

    def path(self, name: str) -> Path:
        """Return the file of the table `name`."""
        folders = [self.root] if "/" in name else data_folders(self.root)
        paths = [folder / f"{name}.csv" for folder in folders]
        return next((path for path in paths if path.exists()), paths[0])

    def __missing__(self, name: str) -> pd.DataFrame:
        path = self.path(name)
        self[name] = files.read(path)
        if files.description_path(path).exists():
            self[name].attrs["commit"] = files.read_origin(path)["provenance_git_commit"][:7]
        return self[name]


def module_of(page: str) -> Path:
    """Return the file of the numbers of a page: ``docs/…/<page>.md``, or ``studies/…/<page>/README.md``."""
    return next(ROOT.glob(f"studies/**/{page}/numbers.py"), FOLDER / f"{page}.py")


def numbers_of(page: str, tables: Tables) -> dict[str, str]:
    """Return the text for each name that a page may quote."""
    spec = importlib.util.spec_from_file_location(f"numbers_of_{page}", module_of(page))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.numbers(tables)


def rows(table: pd.DataFrame, **values: Any) -> pd.DataFrame:
    """Return the rows that have `values` in the columns of these names; a list holds alternatives."""
    for column, value in values.items():
        table = table[table[column].isin(value if isinstance(value, list) else [value])]
    return table


def row(table: pd.DataFrame, **values: Any) -> pd.Series:
    """Return the one row that has `values` in the columns of these names."""
    chosen = rows(table, **values)
    if len(chosen) != 1:
        raise LookupError(f"{len(chosen)} rows with {values}")
    return chosen.iloc[0]


def peak(peaks: pd.DataFrame, E: float, K: float, order: int = 4, theta: float = 0.0) -> pd.Series:
    """Return the row of one coating on the casing of two nodal diameters, for one engine order."""
    return row(peaks, casing="2nd", E=E, K=K, theta=theta, order=order)


def fixed(value: float, digits: int = 0) -> str:
    """Write a number with so many decimals; raise `ValueError` for none."""
    if pd.isna(value):
        raise ValueError("no number")
    return f"{float(value):,.{digits}f}"


def percent(share: float, digits: int = 0) -> str:
    """Write a share in per cent, without the sign."""
    return fixed(100 * float(share), digits)


def mm(length: float, digits: int = 1) -> str:
    """Write a length in millimetres, of one in metres."""
    return fixed(1e3 * float(length), digits)


def decimals(digits: int) -> Callable[[float], str]:
    """Return what writes a number with so many decimals, for a column of a table."""
    return lambda value: fixed(value, digits)


def span(values: pd.Series, write: Callable[[float], str]) -> str:
    """Write the ends of a range of numbers."""
    return f"{write(values.min())} to {write(values.max())}"


def headings(*columns: str) -> dict[str, str]:
    """Head columns of a `table` by their names, or by the symbols that these stand for."""
    return {column: _SYMBOLS.get(column, column) for column in columns}


def table(
    rows: pd.DataFrame | Mapping[str, Any] | Sequence[Mapping[str, Any]],
    columns: Mapping[str, str | tuple[str, Callable[[Any], str]]] | None = None,
) -> str:
    """Write `rows` as a table of Markdown, with `columns`: the heading of each, and what writes its values.

    Without `columns` all are written as they are. What is missing leaves its cell empty.
    """
    rows, text = pd.DataFrame(rows), pd.DataFrame()
    for column, heading in (columns or {name: name for name in rows.columns}).items():
        heading, write = heading if isinstance(heading, tuple) else (heading, str)
        text[heading] = ["" if pd.isna(value) else write(value) for value in rows[column]]
    lines = [list(map(str, text.columns)), ["---"] * len(text.columns), *text.to_numpy().tolist()]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _add_front_matter(app, docname, source):
    """Put the names of a page into its front matter, where MyST looks for them."""
    page, tables = PurePosixPath(docname).name, Tables()
    if not module_of(page).exists():
        return
    front_matter = json.dumps({"substitutions": numbers_of(page, tables)}, ensure_ascii=False)
    source[0] = f"---\nmyst: {front_matter}\n---\n{source[0]}"
    for path in (module_of(page), *FOLDER.glob("*.py"), *map(tables.path, tables)):
        app.env.note_dependency(str(path))


def setup(app):
    """Register the extension."""
    app.connect("source-read", _add_front_matter)
    return {"parallel_read_safe": True}
