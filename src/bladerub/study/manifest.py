"""Manifests: tables of the finished files of a job, written last, by which losses and damage are noticed."""

import csv
import io
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple, Protocol, TypeVar

from bladerub.io import atomic, checksum
from bladerub.io.errors import DamagedFile

CONFIRMATION = "confirmation"  # folder of a coating's longer runs, each named like the run that it repeats


class ListedFile(NamedTuple):
    """A file as its manifest lists it: where, of how many bytes, with which checksum of them."""

    path: Path
    bytes: int
    checksum: str

    def is_lost(self) -> bool:
        """Whether it is missing or has another size, which is known without reading it."""
        return not (self.path.is_file() and self.path.stat().st_size == self.bytes)

    def is_damaged(self) -> bool:
        """Whether it is there and a single bit of it is not as it was written."""
        return self.path.exists() and (self.is_lost() or checksum.file_checksum(self.path) != self.checksum)


class Row(Protocol):
    """A row of a manifest: a named tuple of strings and numbers."""

    file: str  # a name without folders
    _fields: tuple[str, ...]
    _field_defaults: dict[str, Any]

    def files(self, folder: Path) -> list[ListedFile]:
        """Files that the row lists; `folder` is that of the manifest."""


AnyRow = TypeVar("AnyRow", bound=Row)


class ManifestRow(NamedTuple):
    """One run in the manifest of a coating: its file next to the manifest, normalised speed, key and status.

    ``confirmation_...`` is of the longer run that shows whether its growth lasts, empty if it needs none. The
    checksums are the SHA-256 of both files. ``unconverged_steps`` are those whose contact forces did not
    converge. ``growth_key`` is `bladerub.study.plan.growth_key` of the job; older manifests lack it, and the
    ``energy_residual`` of the run.
    """

    file: str
    f_omega: float
    run_key: str
    status: str
    bytes: int
    confirmation_key: str = ""
    confirmation_bytes: int = 0
    checksum: str = ""
    confirmation_checksum: str = ""
    unconverged_steps: int = 0
    growth_key: str = ""
    energy_residual: float = 0.0

    def files(self, folder: Path) -> list[ListedFile]:
        """List the run and, if it has one, its longer run."""
        run = folder / self.file
        run_files = [ListedFile(run, self.bytes, self.checksum)]
        if self.confirmation_key:
            longer = confirmation_path(run)
            run_files.append(ListedFile(longer, self.confirmation_bytes, self.confirmation_checksum))
        return run_files


def confirmation_path(run_path: str | Path) -> Path:
    """Return where the longer run of the run at `run_path` is."""
    run_path = Path(run_path)
    return run_path.parent / CONFIRMATION / run_path.name


def lists_longer(run_path: str | Path, run_key: str) -> bool | None:
    """Return whether the manifest beside the run at `run_path` lists a longer one; None without this run."""
    path = Path(run_path)
    try:
        rows = read_manifest(path.with_name("manifest.tsv"))
    except FileNotFoundError:
        rows = []
    matches = [row for row in rows if row.file == path.name and row.run_key == run_key]
    return any(row.confirmation_key for row in matches) if matches else None


def write_manifest(path: str | Path, rows: Iterable[Row], kind: type[Row] = ManifestRow) -> None:
    """Write rows of this `kind`, tab-separated, whole or not at all; the file's checksum ends the header."""
    table = io.StringIO()
    writer = csv.writer(table, delimiter="\t", lineterminator="\n")
    writer.writerow([*kind._fields, checksum.BLANK])
    writer.writerows([*row, ""] for row in rows)
    with atomic.writing(path, "wb") as stream:
        stream.write(checksum.seal(table.getvalue().encode()))


def read_manifest(path: str | Path, kind: type[AnyRow] = ManifestRow) -> list[AnyRow]:
    """Read rows of this `kind`; older files lack the last columns. Raises `OSError`, naming the file."""
    last = 1 if checksum.is_sealed(path) else 0
    lines = Path(path).read_text(encoding="utf-8", errors="replace").splitlines(keepends=True)
    reader = csv.reader(lines, delimiter="\t")
    try:
        header = next(reader, [])
        header = header[: len(header) - last]
        absent = kind._fields[len(header) :]
        if [*header, *absent] != list(kind._fields) or not kind._field_defaults.keys() >= set(absent):
            raise DamagedFile(f"{path}: not a manifest, its header is not {' '.join(kind._fields)}")
        if not lines[-1].endswith("\n"):
            raise ValueError("breaks off")
        convert = [kind.__annotations__[name] for name in header]
        rows = []
        for texts in reader:
            row = kind(*(read(text) for read, text in zip(convert, texts[: len(texts) - last], strict=True)))
            if Path(row.file).name != row.file:  # nothing outside its folder is opened or deleted by it
                raise ValueError(f"{row.file}: not the name of a file")
            rows.append(row)
        return rows
    except (ValueError, csv.Error) as error:
        raise DamagedFile(f"{path}: not a manifest, line {reader.line_num}: {error}") from error


def listed_files(path: str | Path, kind: type[Row] = ManifestRow) -> list[ListedFile]:
    """List all files of the rows of the manifest at `path`; raises `OSError` as `read_manifest`."""
    return [file for row in read_manifest(path, kind) for file in row.files(Path(path).parent)]
