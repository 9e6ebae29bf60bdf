import errno
import os
import random
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from bladerub.extras.chart.point import PointRow
from bladerub.extras.verification.integrity import examine
from bladerub.io import hdf5, tables
from bladerub.io.checksum import file_checksum
from bladerub.io.hdf5 import Variable
from bladerub.study.manifest import ManifestRow, confirmation_path, write_manifest
from bladerub.workflow import invocation

RUN = "runs/2nd/0.1000.h5"
MANIFEST = "runs/2nd/manifest.tsv"
MEMBER = "runs/2nd/ensemble/0.1000_1.h5"
POINT = "chart/cells/2nd.h5"


@pytest.fixture
def results(tmp_path):
    longer = confirmation_path(tmp_path / RUN)
    names = (RUN, longer.relative_to(tmp_path), MEMBER, POINT, "maps/2nd.h5", "blade/reduced_model.h5")
    values = {
        "angle": Variable(("angle",), np.linspace(0, 6, 300), "rad", "casing angle"),
        "wear": Variable(("node", "angle"), np.arange(2400.0).reshape(8, 300), "m", "worn depth"),
    }
    for name in names:
        hdf5.write(tmp_path / name, values, {"run_key": "k", "casing": "2nd"}, {"provenance_a": "b"})
    table = pd.DataFrame({"f_omega": np.linspace(0.1, 0.4, 9), "order": 3})
    tables.write(tmp_path / "tables" / "peaks.csv", table, {"a": "b"})
    for name in (RUN, MEMBER):
        path = tmp_path / name
        size, checksum = path.stat().st_size, file_checksum(path)
        rows = [ManifestRow(path.name, 0.1, "k", "completed", size, checksum=checksum)] * 3
        write_manifest(path.with_name("manifest.tsv"), rows)
    point = tmp_path / POINT
    rows = [PointRow(point.name, "k", point.stat().st_size, file_checksum(point))]
    write_manifest(tmp_path / "chart" / "columns" / "2.tsv", rows, PointRow)
    return tmp_path


KEPT = [RUN, MEMBER, POINT, MANIFEST, "chart/columns/2.tsv", "maps/2nd.h5", "blade/reduced_model.h5"]


@pytest.mark.parametrize("name", [*KEPT, "tables/peaks.csv", "tables/peaks.csv-metadata.json"])
def test_one_random_bit_is_found_wherever_it_is(results, name):
    path, draw = results / name, random.Random(name)
    whole = path.read_bytes()
    assert examine(results) == ([], [], [])
    signs = [8 * whole.find(sign) for sign in (b"file checksum", b"sha256=") if sign in whole]
    for bit in [draw.randrange(8 * len(whole)) for _ in range(15)] + signs:
        content = bytearray(whole)
        content[bit // 8] ^= 1 << bit % 8
        path.write_bytes(content)
        assert results / name.removesuffix("-metadata.json") in examine(results).damaged, bit


def test_a_whole_file_that_is_not_the_listed_one_is_damaged_and_a_missing_one_lost(results):
    hdf5.write(results / RUN, {}, {"run_key": "other"})
    (results / POINT).unlink()
    assert examine(results) == ([results / RUN] * 3, [results / POINT], [])
    path = results / "maps" / "2nd.h5"
    assert invocation.damage(path) is None
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)
    assert str(path) in invocation.damage(path)
    path.unlink()
    assert invocation.damage(path) is None


def test_what_the_system_refuses_is_not_damaged(results, monkeypatch):
    whole = Path.read_bytes

    def refused(path):
        if path.name in {Path(name).name for name in KEPT}:
            raise OSError(errno.EIO, os.strerror(errno.EIO), str(path))
        return whole(path)

    monkeypatch.setattr(Path, "read_bytes", refused)
    damaged, lost, unreadable = examine(results)
    assert (damaged, lost) == ([], [])
    assert all(any(str(results / name) in line for line in unreadable) for name in KEPT)
