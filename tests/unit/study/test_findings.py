import itertools
import logging

import numpy as np
import pandas as pd
import pytest

from bladerub.study import divergence, findings, peaks
from bladerub.study.findings.evidence import Evidence, read_rom_accuracy
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import read_map, write_map

YOUNG = [0.11, 0.2, 0.5, 1.1, 1.5, 2.0, 5.0, 11.0, 20.0]
HARDENING = [0.05, 0.1, 0.5, 1.0, 5.0, 10.0]
SPEEDS = np.round([*np.arange(0.02, 0.4001, 0.01), 0.197], 6)
SPEEDS.sort()
WORN = CoatingCase("2nd5nd", 11.0, 0.5, 0.0)

PAPER_IDS = {
    *("C1a", "C1b", "C2a", "C2b", "C2c", "C2d", "C3a", "C3b", "C3c", "C3d", "C4a", "C4b", "C4c"),
    *("C5a", "C5b", "C5c", "C6a", "C6b", "C6c", "C7a", "C7b", "C8a", "C8b"),
    *("C9a", "C9b", "C9c", "C9d", "C9e", "C10a", "C10b", "C10c", "C10d"),
    *(f"C11{part}" for part in "abcdefghijkl"),
    "C12a",
}


def _height(E, K):
    """Y4 and Y6 over (E, K), up to a factor, as in Figs. 11 and 13."""
    if K <= 0.1:
        return 0.31 if E == 1.1 else 0.3
    other = {(0.5, 0.5): 0.9, (1.5, 1.0): 0.8}.get((E, K), 0.6)
    return {0.5: 1.0, 1.0: 0.85, 5.0: 0.88, 10.0: 0.7}[K] if E == 1.1 else other


def paper_peaks():
    rows = []
    for E, K in itertools.product(YOUNG, HARDENING):
        shift = 0.002 * HARDENING.index(K)
        for order, f_peak in ((4, 0.30), (6, 0.193)):
            rows.append(("2nd", E, K, 0.0, order, f_peak + shift, 1e-3 * _height(E, K), "theta"))
    table = pd.DataFrame(rows, columns=peaks.COLUMNS)
    soft = (table.E == 0.11) & (table.K == 0.5)
    table.loc[soft, "f_peak"] = table.loc[soft, "order"].map({4: 0.31, 6: 0.21})
    others = [
        ("2nd", 2.0, 0.5, 0.15, 4, 0.295, 5e-4, "theta"),
        ("2nd", 2.0, 0.5, 0.15, 6, 0.19, 5e-4, "theta"),
        ("2nd", np.inf, np.inf, 0.0, 4, 0.312, 5.5e-4, "coulomb"),
        ("2nd", np.inf, np.inf, 0.0, 6, 0.205, 5.5e-4, "coulomb"),
    ]
    return pd.concat([table, pd.DataFrame(others, columns=peaks.COLUMNS)], ignore_index=True)


def paper_divergence():
    rows = []
    for (theta, own), f_omega in itertools.product(((0.0, 0.197), (0.15, 0.19)), (0.19, 0.197)):
        growth = 0.03 if f_omega == own else 0.0
        rows.append(
            {
                "casing": "2nd",
                "E": 2.0,
                "K": 0.5,
                "theta": theta,
                "f_omega": f_omega,
                "growth_per_revolution": growth,
                "saturating": False,
                "divergent": growth > 0.01,
                "lobes": 6,
                "growth_low": growth - 0.01,
                "growth_high": growth + 0.01,
                "revolutions": 60 if growth else 20,
                "status": "completed",
                "law": "theta",
                "wear_harmonic": 2,
                "wear_harmonic_share": 0.6,
            }
        )
    return pd.DataFrame(rows, columns=divergence.COLUMNS)


def paper_rom_accuracy():
    rows = [(f, mode, 1e-4 * mode) for f in (0.0, 0.2, 0.4) for mode in range(1, 11)]
    return pd.DataFrame(rows, columns=["f_omega", "mode", "relative_error"])


@pytest.fixture
def paper(config, make_map):
    """A study that shows all that the paper states: tables and maps, to be spoilt by the tests."""
    lobes = np.full(SPEEDS.size, 7)
    lobes[(SPEEDS <= 0.08) | ((SPEEDS >= 0.24) & (SPEEDS <= 0.34))] = 5
    lobes[np.isclose(SPEEDS, 0.1)] = 10
    lobes[np.isclose(SPEEDS, 0.38)] = 4
    crossings = {k: (1 / np.sqrt(k**2 - 3), 1e-3 / k) for k in range(4, 13)}
    maps = [
        make_map(WORN, {5: (0.26, 1e-3), 4: (0.38, 2e-3)}, SPEEDS, lobes=lobes),
        make_map(CoatingCase("2nd", 0.11, 0.5, 0.0), {4: (0.31, 1e-4), 6: (0.21, 1e-4)}, SPEEDS),
        make_map(CoatingCase("2nd", 1.1, 0.5, 0.0), crossings, SPEEDS),
    ]
    tables = {"rom_accuracy": paper_rom_accuracy(), "peaks": paper_peaks(), "divergence": paper_divergence()}
    return config, tables, {coating.case.name: coating for coating in maps}


@pytest.fixture
def judge():
    def judged(config, tables, maps):
        return findings.judge(Evidence(config, tables, maps.values())).set_index("id")

    return judged


def test_the_rigid_casing_takes_no_part_in_the_claims_on_E_and_K(paper, judge):
    table = paper[1]["peaks"]
    table.loc[np.isinf(table.E), ["amplitude", "f_peak"]] = [1.0, 0.02]
    judged = judge(*paper)
    assert list(judged[judged.holds != "yes"].index) == ["C12a"]
    assert "of 54 cells" in judged.claim["C6a"]


def test_a_small_study_leaves_out_what_it_cannot_tell_and_logs_it(paper, judge, caplog):
    config, tables, maps = paper
    few = tables["peaks"].E.isin([0.11, 1.1, 2.0]) & tables["peaks"].K.isin([0.1, 0.5])
    holed = few & ~((tables["peaks"].E == 2.0) & (tables["peaks"].K == 0.1))  # not a full product
    tables = {**tables, "peaks": tables["peaks"][holed], "divergence": tables["divergence"].iloc[:0]}
    del maps[WORN.name]
    with caplog.at_level(logging.WARNING):
        judged = judge(config, tables, maps)
    out = {id_ for id_ in PAPER_IDS if id_.startswith(("C2", "C3", "C11"))} | {"C6c", "C12a"}
    assert set(judged.index) == PAPER_IDS - out
    assert "left out: C2a: five worn lobes" in caplog.text
    assert "coating 2nd5nd_E11_K0.5_theta0 is not in the study" in caplog.text
    assert "(E, K) = (1.1, 5) is not in the study" in caplog.text
    assert "C12b" in caplog.text
    assert len(caplog.records) == len(out) + 1


def test_the_table_is_read_from_the_files_of_a_study(paper, tmp_path):
    config, tables, maps = paper
    for name, coating in maps.items():
        write_map(tmp_path / f"{name}.h5", coating, {})
    for name, table in tables.items():
        table.to_csv(tmp_path / f"{name}.csv", index=False)
    table = findings.table(
        config,
        maps=map(read_map, tmp_path.glob("*.h5")),
        peaks_path=tmp_path / "peaks.csv",
        divergence_path=tmp_path / "divergence.csv",
        rom_accuracy=read_rom_accuracy(tmp_path / "rom_accuracy.csv"),
    )
    # f6 of the straight coating at K = 0.5 is 0.197, of the tilted one 0.19: as in Figs. 17 and 18
    columns = ["id", "claim", "paper", "measured", "unit", "holds", "margin"]
    assert list(table.columns) == [*columns, "measured_by_harmonic", "holds_by_harmonic"]
    assert set(table.id) == PAPER_IDS
    assert set(table.holds) == {"yes"}
