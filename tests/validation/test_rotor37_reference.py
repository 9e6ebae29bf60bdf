"""The reference numbers of NASA Rotor 37, computed again on a coarser mesh, and with another material.

The published first frequency: 856 to 859 Hz (Piollet, Nyssen and Batailly, J. Sound Vib. 460, 2019, 114878,
and the works that use their blade).
"""

import copy

import pandas as pd
import pytest

from bladerub.blade.build import build
from bladerub.extras.rotor37 import direct, numbers, reference
from bladerub.extras.verification import impact
from bladerub.extras.verification.compare import compare
from bladerub.io.folders import BENCHMARKS

KNOWN = BENCHMARKS / "rotor37"
impact._march.enable_caching()  # as in tests/unit/extras/verification/test_impact.py: one of both compiles it


@pytest.fixture
def compared(tmp_path):
    """Compute the numbers on the coarser mesh, with so many times the stiffness, and compare them."""

    def table(stiffness=1.0):
        config = copy.deepcopy(reference.plan()["mesh"])
        config["blade"]["material"]["young_modulus"] *= stiffness
        blade = build(config).reduced
        numbers.of_blade(config, blade).to_csv(tmp_path / "blade.csv", index=False)
        direct.numbers(direct.runs(config, blade)).to_csv(tmp_path / "direct.csv", index=False)
        return compare(tmp_path, KNOWN)

    return table


def test_a_fresh_calculation_on_a_coarser_mesh_agrees(compared):
    table = compared()
    assert table.table.unique().tolist() == ["blade", "direct"]
    assert len(table) > 40
    assert table[~table.agrees].empty


@pytest.mark.nightly
def test_five_per_cent_of_stiffness_are_noticed(compared):
    table = compared(stiffness=1.05)
    different = set(table[~table.agrees].number)
    assert {"f1_rest", "f1_nominal", "rest_mu0.order_4"} <= different


def test_the_first_frequency_is_the_published_one():
    blade = pd.read_csv(KNOWN / "blade.csv").set_index("number")
    assert 0.995 * 856 < blade.value["f1_rest"] < 1.005 * 859
