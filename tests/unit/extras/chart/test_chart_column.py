import operator
from dataclasses import replace
from functools import reduce

import pytest

from bladerub.extras.chart import column
from bladerub.extras.chart.column import determinants
from bladerub.extras.chart.plan import chart_speeds, columns
from bladerub.extras.chart.point import PointRow
from bladerub.extras.chart.table import read_points
from bladerub.io.errors import DamagedFile
from bladerub.study.cache import ARCHIVE
from bladerub.study.grid import CoatingCase
from bladerub.study.manifest import read_manifest, write_manifest

CASE = CoatingCase("2nd", 2.0, 0.5, 0.0)


@pytest.fixture
def build(few_speeds, blade, make_point, monkeypatch, tmp_path):
    """Compute the column of given K, write its manifest and return the K that the search was asked for."""
    computed = []

    def compute(config, case, *_):
        computed.append(case.K)
        return make_point(case.E, case.K)

    monkeypatch.setattr(column, "compute", compute)

    def run(K, digest="blade"):
        few_speeds["chart"] |= {"E": [2], "K": K, "theta": [0.0]}
        computed.clear()
        ((name, cases),) = columns(few_speeds).items()
        plan = column.plan_column(few_speeds, cases)
        rows = column.compute_missing(few_speeds, plan, blade, tmp_path / "cells", digest, lambda line: None)
        write_manifest(tmp_path / "columns" / f"{name}.tsv", rows, PointRow)
        return list(computed)

    return run


MANIFEST = "columns/2nd_E2_theta0.tsv"


def test_a_column_computes_what_is_not_there(few_speeds, build, tmp_path):
    manifest = tmp_path / MANIFEST
    assert build([0.5, 5]) == [0.5, 5]
    rows = read_manifest(manifest, PointRow)
    assert [row.file for row in rows] == ["2nd_E2_K0.5_theta0.h5", "2nd_E2_K5_theta0.h5"]
    assert build([0.5, 5]) == []
    assert read_manifest(manifest, PointRow) == rows
    assert build([0.5, 1, 5]) == [1]
    (tmp_path / "cells" / rows[1].file).write_bytes(b"")
    assert build([0.5, 5]) == [5]
    few_speeds["analysis"]["divergence"]["growth"] = 0.02
    assert build([5]) == [5]


def test_a_change_of_mind_costs_no_point_and_no_table_is_made_of_a_damaged_one(build, tmp_path):
    manifest = tmp_path / MANIFEST
    build([0.5, 5])
    contents = {path.name: path.read_bytes() for path in (tmp_path / "cells").glob("*.h5")}
    rows = read_manifest(manifest, PointRow)
    assert build([0.5, 5], digest="another blade") == [0.5, 5]
    assert build([0.5, 5]) == build([0.5, 5], digest="another blade") == build([0.5, 5]) == []
    assert read_manifest(manifest, PointRow) == rows
    assert {path.name: path.read_bytes() for path in (tmp_path / "cells").glob("*.h5")} == contents
    assert len(list((tmp_path / "cells" / ARCHIVE).iterdir())) == 2
    assert [point.case.K for point in read_points([manifest])] == [0.5, 5]
    path = tmp_path / "cells" / "2nd_E2_K5_theta0.h5"
    content = bytearray(path.read_bytes())
    content[-1] ^= 1
    path.write_bytes(content)
    with pytest.raises(DamagedFile, match="K5"):
        list(read_points([manifest]))
    path.unlink()
    with pytest.raises(FileNotFoundError, match="K5"):
        list(read_points([manifest]))


class TestDeterminants:
    @pytest.fixture
    def digest(self, few_speeds):
        few_speeds["chart"]["speeds"] |= {"dense_stop": 0.24, "dense_step": 0.04}
        return lambda case=CASE: determinants(few_speeds, case, chart_speeds(few_speeds))

    @pytest.mark.parametrize(
        ("keys", "value"),
        [
            (("analysis", "lobe_prominence"), 0.3),
            (("analysis", "peaks", "speed_window"), [0.8, 1.2]),
            (("analysis", "divergence", "growth"), 0.011),
            (("chart", "speeds", "refine_above"), 0.51),
            (("chart", "speeds", "dense_stop"), 0.32),
            (("speeds", "extra"), [0.197]),
            (("solver", "revolutions"), 21),
        ],
    )
    def test_a_setting_that_shapes_the_point_changes_them(self, few_speeds, digest, keys, value):
        before, section = digest(), reduce(operator.getitem, keys[:-1], few_speeds)
        section[keys[-1]] = value
        assert digest() != before

    def test_every_coating_and_source_has_its_own(self, digest, monkeypatch):
        others = [replace(CASE, E=3.0), replace(CASE, K=1.0), replace(CASE, theta=0.1)]
        others += [replace(CASE, casing="2nd5nd"), replace(CASE, law="coulomb")]
        found = {digest(case) for case in [CASE, *others]}
        for source in ("solver_digest", "chart_digest"):
            monkeypatch.setattr(column, source, lambda: "other")
            found.add(digest())
        assert len(found) == 8

    def test_what_acts_elsewhere_leaves_them(self, few_speeds, digest):
        before = digest()
        few_speeds["chart"] |= {"E": [7], "K": [8], "limits": {"wear": 1e-9}}
        few_speeds |= {"coatings": [], "results": "elsewhere", "figures": {"dpi": 50}}
        few_speeds["analysis"] |= {"max_order": 9, "histories": []}
        few_speeds["casings"]["2nd5nd"]["peak_orders"] = [5]
        assert digest() == before
        few_speeds["casings"]["2nd"]["peak_orders"] = [2]
        assert digest() != before
