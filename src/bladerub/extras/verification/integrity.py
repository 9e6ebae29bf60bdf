"""Which files of a results folder are lost, or no longer as they were written."""

import os
from pathlib import Path
from typing import NamedTuple

from bladerub import plugins
from bladerub.io import hdf5, tables
from bladerub.io.errors import DamagedFile, message_for
from bladerub.study.manifest import ManifestRow, Row, listed_files


class Faults(NamedTuple):
    """What is wrong with the files of a folder."""

    damaged: list[Path]  # read, and not as they were written
    lost_files: list[Path]  # listed by a manifest, but not there
    unreadable: list[str]  # for each file that the system refuses to read, its name, the reason and the cure


def examine(results: str | Path) -> Faults:
    """Read all HDF5 files, tables and manifests below `results`, and what these list, to their end."""
    faults = Faults([], [], [])

    def refused(error: OSError) -> None:
        faults.unreadable.append(message_for(error))

    for folder, _, names in os.walk(results, onerror=refused):
        for path in (Path(folder, name) for name in sorted(names)):
            try:
                _examine(path, faults)
            except DamagedFile:
                faults.damaged.append(_table_of(path))
            except FileNotFoundError:  # a table, which Snakemake makes again
                pass
            except OSError as error:
                refused(error)
    return faults


def _examine(path: Path, faults: Faults) -> None:
    if path.suffix == ".h5":
        hdf5.read(path)
    elif path.name.endswith(tables.DESCRIPTION):
        tables.check(_table_of(path))
    elif path.name == "manifest.tsv":
        _examine_listed(path, ManifestRow, faults)
    elif path.suffix == ".tsv" and (kind := plugins.offered("MANIFESTS").get(path.parent.name)):
        _examine_listed(path, plugins.load(kind), faults)


def _table_of(path: Path) -> Path:
    return path.with_name(path.name.removesuffix(tables.DESCRIPTION))


def _examine_listed(manifest: Path, kind: type[Row], faults: Faults) -> None:
    for file in listed_files(manifest, kind):
        try:
            if not file.path.exists():
                faults.lost_files.append(file.path)
            elif file.is_damaged():
                faults.damaged.append(file.path)
        except OSError as error:
            faults.unreadable.append(message_for(error))
