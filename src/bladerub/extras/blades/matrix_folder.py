"""A folder with the matrices of a blade: its files and their formats."""

import io
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple
from zipfile import ZipFile

import numpy as np
from scipy import sparse
from scipy.io import mminfo, mmread

from bladerub.blade.linear import MOST_UNKNOWNS
from bladerub.extras import cells
from bladerub.extras.blades.origin import FARTHEST, refuse_content
from bladerub.extras.cells import Cells
from bladerub.numerics.lanes import FEWEST_NODES, MOST_NODES

SUFFIXES = (".mtx", ".npz")
NODES = "nodes.csv"
MASS = "mass"
FIT = ("stiffness_rest", "stiffness_half", "stiffness_max")  # at the speeds of the fit
AT_SPEED = "stiffness_at_"  # another normalised speed follows
_BYTES = 16  # of an entry: its value and its place
_ENTRIES_IN_A_ROW = 400  # on average; quadratic hexahedra have 180
_ENTRIES_OF_DENSE = 5 * 10**7  # as many may be there in any matrix
LARGEST = 1e100  # entry; penalties have 1e20 or so, and beyond 1e154 squares overflow
_SMALL = 1000  # bytes, of the head of an array
_IN_NUMBERS = b"0123456789+-.eEdD \t\r\nnNaAiIfFtTyY"  # and in nan, inf, infinity
_CONVERTED = "docs/how-to/bring_a_blade.md has the script that converts"
SYMMETRY = 1e-8  # largest difference of two entries that must be equal, over the largest entry
_POSITION = ("x", "y", "z")
_MARKS = {"interface": MOST_NODES, "clamped": 1, "tip": 1}  # largest value of each


class Nodes(NamedTuple):
    """The content of ``nodes.csv``."""

    points: np.ndarray  # (n_nodes, 3), in the unit and axes of the file
    interface: np.ndarray  # (8,), rows of the interface nodes, leading to trailing edge
    clamped: np.ndarray  # rows that are marked so
    tip: np.ndarray


def files(folder: Path) -> dict[str, Path]:
    """Find matrices and list of nodes, by name without suffix; a ValueError says which is missing."""
    if not folder.is_dir():
        raise ValueError("there is no such folder")
    speed_names = {path.stem for path in folder.glob(f"{AT_SPEED}*") if path.suffix in SUFFIXES}
    paths = {}
    for name in (MASS, *FIT, *sorted(speed_names)):
        matches = [path for suffix in SUFFIXES if (path := folder / f"{name}{suffix}").is_file()]
        if len(matches) > 1:
            raise ValueError(f"holds both {name}.mtx and {name}.npz")
        if not matches:
            ccx = [path.name for path in sorted(folder.iterdir()) if path.suffix in (".mas", ".sti", ".dof")]
            hint = f"; {_CONVERTED} {', '.join(ccx)} of CalculiX" if ccx else ""
            raise ValueError(f"holds no {name}.mtx or {name}.npz{hint}")
        (paths[name],) = matches
    if not (folder / NODES).is_file():
        raise ValueError(f"holds no {NODES}")
    return paths | {"nodes": folder / NODES}


def speeds(names: Mapping[str, Path], fit: Sequence[float]) -> dict[float, str]:
    """Find the stiffness at each normalised speed, ascending; a ValueError names one without such a speed."""
    names_by_speed = dict(zip(fit, FIT, strict=True))
    rule = f"between 0 and reduction.f_omega_max = {fit[-1]:g}, and none that another file has"
    for name in names:
        if name.startswith(AT_SPEED):
            text = name.removeprefix(AT_SPEED)
            speed = float(text) if re.fullmatch(r"\d*\.?\d+", text) else None
            if speed is None or not fit[0] < speed < fit[-1] or speed in names_by_speed:
                raise ValueError(f"{names[name].name}: must be named after its normalised speed, {rule}")
            names_by_speed[speed] = name
    return dict(sorted(names_by_speed.items()))


def read_nodes(path: Path) -> Nodes:
    """Read ``nodes.csv``; a ValueError names the line."""
    table = cells.read(path)
    table.require(*_POSITION, "interface")
    names = [name.lower() for name in table.names]
    lines = list(table.rows)
    points = np.stack([table.numbers(name) for name in _POSITION], axis=1)
    if (outliers := (abs(points) > FARTHEST).any(axis=1)).any():
        largest = abs(points[outliers.argmax()]).max()
        raise ValueError(f"line {lines[outliers.argmax()]}: has {largest:.3g}, must be {FARTHEST:g} or less")
    number, clamped, tip = (_marks(table, name) if name in names else np.zeros(len(lines)) for name in _MARKS)
    n_nodes = max(int(number.max(initial=0)), FEWEST_NODES)
    for position in range(1, n_nodes + 1):
        if (count := np.count_nonzero(number == position)) != 1:
            counted = f"{count} nodes have" if count else "no node has"
            raise ValueError(f"{counted} interface = {position}; each of 1 to {n_nodes} must be there once")
    interface = np.argsort(number, kind="stable")[-n_nodes:]  # all others are 0
    if (held := (number > 0) & (clamped > 0)).any():
        raise ValueError(f"line {lines[held.argmax()]}: an interface node must not be clamped")
    return Nodes(points, interface, np.flatnonzero(clamped), np.flatnonzero(tip))


def _marks(table: Cells, name: str) -> np.ndarray:
    marks = table.numbers(name, empty=0.0)
    rule = f"must be a whole number from 0 to {_MARKS[name]}, or nothing"
    for line, mark in zip(table.rows, marks, strict=True):
        if mark not in range(_MARKS[name] + 1):
            raise ValueError(f"line {line}: {name} = {mark:g}: {rule}")
    return marks


def read_matrix(path: Path) -> sparse.csc_array:
    """Read a real symmetric matrix of Matrix Market or of `scipy.sparse`, or raise ValueError."""
    is_text = path.suffix == ".mtx"
    try:
        rows, columns, size = _size_of_text(path) if is_text else _size_of_archive(path)
        limit = max(_ENTRIES_IN_A_ROW * rows, _ENTRIES_OF_DENSE) * _BYTES
        if rows == columns and rows <= MOST_UNKNOWNS and size <= limit:
            raw = mmread(_numbers_of(path), spmatrix=False) if is_text else sparse.load_npz(path)
            if hasattr(raw, "check_format"):
                raw.check_format(full_check=True)  # scipy reads past the arrays of what does not pass
    except Exception as error:  # readers of foreign files raise all kinds of errors
        refuse_content(path, error)
    if rows != columns:
        raise ValueError(f"is {rows} x {columns}; must be square")
    if rows > MOST_UNKNOWNS:
        raise ValueError(f"is {rows} x {rows}; must have {MOST_UNKNOWNS} rows or fewer")
    if size > limit:
        need, cap = size / 1e9, limit / 1e9
        raise ValueError(f"takes {need:.2g} GB of memory for {rows} rows; must take {cap:.2g} GB or less")
    if raw.dtype.kind not in "iuf":
        raise ValueError(f"holds numbers of the type {raw.dtype}; must be real")
    entries = sparse.coo_array(raw)
    matrix = sparse.csc_array(entries, dtype=float)  # adds up entries that are there twice
    if is_text and matrix.nnz < entries.nnz:
        raise ValueError("has entries twice; with the word symmetric it must hold one triangle only")
    _check_symmetry(matrix)
    return (matrix + matrix.T) / 2


def _size_of_text(path: Path) -> tuple[int, int, int]:
    """Rows, columns and size in memory (bytes) by the head of a Matrix Market file."""
    with path.open(encoding="utf-8", errors="replace") as stream:
        first = stream.readline().strip()
    if not first.startswith("%%MatrixMarket"):
        numbers = re.fullmatch(r"(\d+,\s*\d+,\s*\d+,\s*\d+,|\d+\s+\d+\s)\s*[-+.\w]+", first)
        if first.startswith("**") or numbers:
            kind = "COORDINATE" if numbers and "," not in first else "MATRIX INPUT"
            raise ValueError(f"it is of Abaqus, FORMAT={kind}; {_CONVERTED} it")
        raise ValueError(f"it begins with {first[:40]!r}; must begin with %%MatrixMarket")
    rows, columns, entries, _, field_name, _ = mminfo(path)
    if field_name == "pattern":
        raise ValueError("it holds places of entries (pattern), and no numbers")
    return rows, columns, _BYTES * entries


def _numbers_of(path: Path) -> io.BytesIO:
    """Return a Matrix Market file with exponents that have an E; scipy passes over what follows a number."""
    content = path.read_bytes()
    end_of_comments = [*re.finditer(rb"(?m)^%.*\n", content)][-1].end()
    body = content[end_of_comments:]
    if odd := body.translate(None, _IN_NUMBERS):
        place = body.index(odd[:1])
        line = content.count(b"\n", 0, end_of_comments + place) + 1
        raise ValueError(f"line {line} has {odd[:1].decode('latin-1')!r}; must hold numbers with a point")
    return io.BytesIO(content[:end_of_comments] + body.translate(bytes.maketrans(b"dD", b"eE")))


def _size_of_archive(path: Path) -> tuple[int, int, int]:
    """Rows, columns and size in memory (bytes) by the heads in an archive, which may be packed densely."""
    with ZipFile(path) as archive:
        unpacked = {entry.filename: entry.file_size for entry in archive.infolist()}
    if unpacked.get("shape.npy", 0) > _SMALL:
        raise ValueError("its shape has more than two numbers")
    with np.load(path) as content:
        rows, columns = (int(number) for number in content["shape"])
        for name in {"indices", "indptr", "row", "col", "offsets"}.intersection(content.files):
            if content[name].dtype.kind not in "iu":
                raise ValueError(f"its {name} are {content[name].dtype}, must be whole numbers")
    return rows, columns, sum(unpacked.values()) - len(unpacked) * _SMALL


def _check_symmetry(matrix: sparse.csc_array) -> None:
    entries = matrix.tocoo()
    outliers = np.flatnonzero(~(np.abs(entries.data) < LARGEST))
    if outliers.size:
        place, value = _entry(entries, outliers[0]), entries.data[outliers[0]]
        raise ValueError(f"its entry {place} is {value:g}; must be a finite number below {LARGEST:g}")
    apart = (matrix - matrix.T).tocoo()
    if apart.nnz and np.abs(apart.data).max() > SYMMETRY * np.abs(entries.data).max():
        if len({*np.sign(entries.col - entries.row)}) < 3:
            raise ValueError("holds one triangle only; must hold both, or say symmetric in a .mtx file")
        worst = int(np.argmax(np.abs(apart.data)))
        off = f"{abs(apart.data[worst]):.3g} off its mirror image"
        raise ValueError(f"is not symmetric: its entry {_entry(apart, worst)} is {off}")


def _entry(matrix: sparse.coo_array, index: int) -> str:
    return f"({matrix.row[index] + 1}, {matrix.col[index] + 1})"
