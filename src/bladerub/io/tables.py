"""Tables as plain CSV, each with a description next to it in the form of the W3C's "CSV on the Web".

``X.csv`` is for every program that reads CSV; ``X.csv-metadata.json`` says what its columns hold, in which
units, where the table comes from, and the checksum of both (`bladerub.io.checksum`). A column means the same
in every table: ``columns.csv`` in this folder lists those of the study, with unit ``1`` for a pure or
normalised number, none for text; who writes other tables lists theirs. An entry ``Yk`` is that of ``Y4`` and
of every other engine order.
"""

import csv
import io
import json
import re
from collections import ChainMap
from collections.abc import Collection, Iterable, Mapping
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bladerub.io import atomic, checksum
from bladerub.io.errors import BadInput, DamagedFile

if TYPE_CHECKING:
    import pandas as pd

DESCRIPTION = "-metadata.json"  # behind the name of a table: its description, where the W3C looks first

_HEAD = ["column", "datatype", "unit", "description"]
_DATATYPES = ["number", "integer", "string", "boolean"]

COLUMNS_FILE = Path(__file__).with_name("columns.csv")


def write(
    path: str | Path,
    table: "pd.DataFrame",
    origin: Mapping[str, str],
    float_format: str | None = None,
    columns_files: Iterable[Path] = (),
) -> None:
    """Write `table` to `path`, without its index, and its description next to it.

    It has one observation a row; `origin` is from `bladerub.io.provenance.provenance`, `float_format` as of
    pandas. Raises `ValueError`, before anything is written, if a column is described neither in
    `COLUMNS_FILE` nor in one of `columns_files`, of its form.
    """
    path = Path(path)
    described = described_columns(*columns_files)
    description = _as_text(_description(path.name, table, described, origin))
    text = table.to_csv(index=False, float_format=float_format, lineterminator="\n")
    content = re.sub(r"(?<=[,\n])(-?)inf(?=[,\n])", r"\1INF", text).encode()  # as the W3C writes numbers
    with atomic.writing(path, "wb") as stream:
        stream.write(content)
    with atomic.writing(description_path(path), "wb") as stream:
        stream.write(checksum.seal(description, content))


def _as_text(description: Mapping[str, Any]) -> bytes:
    return f"{json.dumps(description, indent=2, ensure_ascii=False)}\n".encode()


def read(path: str | Path, columns: Collection[str] = (), separator: str = ",") -> "pd.DataFrame":
    """Read a table that has the columns `columns` and of which every row must be whole.

    Raises an `OSError` that names the file if it is missing, breaks off, is not a table, lacks a column, or
    is not as it was written with the description next to it.
    """
    import pandas as pd  # takes half a second, which jobs that draw without a table do without

    with suppress(FileNotFoundError):  # a table without a description
        check(path)
    try:
        text = Path(path).read_text(encoding="utf-8")
        if not text.endswith("\n"):
            raise DamagedFile(f"{path}: not a whole table, it breaks off in its last line")
        table = pd.read_csv(io.StringIO(text), sep=separator)
    except (UnicodeDecodeError, pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise DamagedFile(f"{path}: not a table ({str(error).strip()})") from error
    missing = [column for column in columns if column not in table.columns]
    if missing:
        raise DamagedFile(f"{path}: not the right table, {', '.join(missing)} missing")
    return table


def check(path: str | Path) -> None:
    """Raise an `OSError`, with its name, if a table or its description is absent or not as written."""
    described = description_path(path)
    try:
        json.loads(described.read_bytes())
        checksum.is_sealed(described, path)
    except (ValueError, DamagedFile) as error:
        raise DamagedFile(f"{path}: not as it was written, by the checksum in {described.name}") from error


def description_path(path: str | Path) -> Path:
    """Return where the description of the table at `path` is."""
    path = Path(path)
    return path.with_name(f"{path.name}{DESCRIPTION}")


def copy(source: str | Path, target: str | Path) -> None:
    """Copy a table, and its description, which then names the copy; raises as `check`."""
    check(source)
    content, described = Path(source).read_bytes(), json.loads(description_path(source).read_bytes())
    named = described | {"url": Path(target).name, "schema:sha256": checksum.BLANK}
    Path(target).write_bytes(content)
    description_path(target).write_bytes(checksum.seal(_as_text(named), content))


def read_origin(path: str | Path) -> dict[str, str]:
    """Read the provenance of the table at `path` from its description."""
    description = json.loads(description_path(path).read_text(encoding="utf-8"))
    return {entry["schema:name"]: entry["schema:value"] for entry in description["dc:provenance"]}


def described_columns(*columns_files: Path) -> dict[str, dict[str, Any]]:
    """Return each column's description by its `entry`, as CSV on the Web has it; `COLUMNS_FILE` first."""
    return dict(ChainMap(*map(_described, (COLUMNS_FILE, *columns_files))))


@cache
def _described(columns_file: Path) -> dict[str, dict[str, Any]]:
    described, (head, *rows) = {}, csv.reader(columns_file.read_text(encoding="utf-8").splitlines())
    right = f"must be {', '.join(_HEAD)}, the datatype one of {', '.join(_DATATYPES)}"
    for line, row in enumerate((head, *rows), 1):
        if len(row) != len(_HEAD) or (row[1] not in _DATATYPES if line > 1 else row != _HEAD):
            raise BadInput(f"{columns_file}:{line}: {','.join(row)}: {right}")
    for name, datatype, unit, description in rows:
        kind = {"base": "boolean", "format": "True|False"} if datatype == "boolean" else datatype
        about = {"datatype": kind, "dc:description": description}
        described[name] = about | ({"schema:unitText": unit} if unit else {})
    return described


def entry(column: str) -> str:
    """Return the name under which `COLUMNS_FILE` has a column: ``Yk`` for ``Y4``, most others their own."""
    return re.sub(r"(?<=^[Yf])\d+$", "k", column)


def _description(
    name: str, table: "pd.DataFrame", described: Mapping[str, dict[str, Any]], origin: Mapping[str, str]
) -> dict[str, Any]:
    unknown = [column for column in table.columns if entry(column) not in described]
    if unknown:
        raise ValueError(
            f"{name}: columns not described: {', '.join(unknown)}; describe them in {COLUMNS_FILE}, or in "
            f"{COLUMNS_FILE.name} of the folder of a study or of an extra"
        )
    columns = [{"name": column, "titles": column} for column in table.columns]
    return {
        "@context": ["http://www.w3.org/ns/csvw", {"@language": "en"}],
        "url": name,
        "schema:sha256": checksum.BLANK,
        "dc:provenance": [{"schema:name": key, "schema:value": value} for key, value in origin.items()],
        "tableSchema": {"columns": [heading | described[entry(heading["name"])] for heading in columns]},
    }
