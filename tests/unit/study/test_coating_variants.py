import dataclasses

import pandas as pd
import pytest

from bladerub.io import tables
from bladerub.study import divergence, grid, peak_table
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import CoatingCase
from bladerub.study.plan import coating_plan
from bladerub.study.variants import of_case, plain

PLAIN = CoatingCase("2nd", 2.0, 0.5, 0.0)
OWN = {"damping_ratio": 1e-3, "layer_thickness": 4e-3, "interference": 4e-4}
VARIANT = PLAIN.with_own(**OWN)


@pytest.fixture
def maps(make_map):
    return [
        make_map(PLAIN, {4: (0.31, 1e-4), 6: (0.2, 2e-4)}),
        make_map(VARIANT, {4: (0.3, 5e-4), 6: (0.2, 6e-4)}),
    ]


def test_lists_of_an_entry_stand_for_all_combinations(config):
    entry = {"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.0]}
    config["coatings"] = [entry, entry | {"damping_ratio": [1e-3, 2e-3], "interference": [3e-4, 4e-4]}]
    cases = grid.coating_cases(config)
    assert cases[0] == PLAIN
    assert [case.variant for case in cases[1:]] == [f"xi0.00{x}_d0.000{d}" for x in (1, 2) for d in (3, 4)]
    assert grid.case_from_name(config, cases[2].name) == cases[2]
    run = {"casing": "2nd", "E": 2, "K": 0.5, "theta": 0, "damping_ratio": 1e-3, "interference": 3e-4}
    config["analysis"]["histories"] = [run | {"f_omega": 0.19}]
    assert [grid.keeps_history(config, case, 0.19) for case in cases] == [False, True, False, False, False]


def test_a_variant_changes_its_own_runs_alone(config):
    config["contact"]["scale"] = {"length": 2.0, "modulus": 1.0, "time": 1.0}
    before, after = (grid.run_spec(config, case, 0.19) for case in (PLAIN, VARIANT))
    assert (after.damping_ratio, after.coating.thickness, after.casing.interference) == (1e-3, 8e-3, 8e-4)
    parts = [pd.json_normalize(dataclasses.asdict(spec)).iloc[0].to_dict() for spec in (before, after)]
    changed = {name for name, value in parts[0].items() if parts[1][name] != value}
    assert changed == {"damping_ratio", "coating.thickness", "casing.interference"}
    keys = [coating_plan(config, case).runs[0].key("blade") for case in (PLAIN, VARIANT)]
    assert keys[0] != keys[1]


def test_tables_tell_variants_from_the_plain_coating(config, maps, tmp_path):
    for table in (peak_table.table, divergence.table):
        assert "variant" not in table(config, maps[:1])
        tables.write(tmp_path / "table.csv", table(config, maps), {})
        read = tables.read(tmp_path / "table.csv")
        assert read.columns[-1] == "variant"
        for case in (PLAIN, VARIANT):
            rows = of_case(read, case)
            assert len(rows) == len(read) / 2
            assert set(rows.variant.fillna("")) == {case.variant}
        pd.testing.assert_frame_equal(plain(read), plain(table(config, maps[:1])), check_dtype=False)
    found = {"peaks": peak_table.table(config, maps), "divergence": divergence.table(config, maps)}
    evidence = Evidence(config, found | {"rom_accuracy": None}, maps)
    assert evidence.peak(PLAIN, 6, "amplitude") == pytest.approx(2e-4)  # judged without variants
