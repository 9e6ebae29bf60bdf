from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from bladerub.blade.accuracy import ACCURACY_COLUMNS, accuracy_table
from bladerub.blade.frequencies import reduced_frequencies
from bladerub.extras import blade_comparison
from bladerub.io.tables import described_columns

SPEEDS = (0.0, 0.2, 0.4)


@pytest.fixture
def built(blade):
    """The blade of the tests as it would be built: moved by 0.1 mm, its model off by a part for each mode."""
    coupled = blade.stiffness_0 + 0.1 * blade.stiffness_0[0, 0]
    blade = replace(blade, stiffness_0=coupled, stiffness_1=3 * coupled)
    exact = {speed: reduced_frequencies(blade, speed, 7) for speed in SPEEDS}
    off = 1 + 1e-3 * np.arange(1, 8)
    accuracy = accuracy_table(blade, {s: f / off for s, f in exact.items()}, exact)
    assert list(accuracy.columns) == ACCURACY_COLUMNS
    moved = np.zeros((3, 5, 3))
    moved[-1, 2] = (0.6e-4, 0.0, 0.8e-4)
    return SimpleNamespace(reduced=blade, accuracy=accuracy, static_displacement=moved)


def test_the_figures_of_a_blade_are_those_of_its_model(built):
    table = blade_comparison.blades({"this": built, "reference": built})
    assert list(table.columns) == blade_comparison.BLADE_COLUMNS
    assert set(table.columns) <= described_columns().keys()
    figures = table[table.blade == "this"].set_index("number").value
    f1, f2 = reduced_frequencies(built.reduced, 0.0, 2)
    assert figures.f1 == pytest.approx(f1 / 1.001)
    assert figures.f2_over_f1 == pytest.approx(f2 / f1 * 1.001 / 1.002)
    assert figures.stiffening == pytest.approx(np.sqrt(1 + 3 * 0.4**2))
    assert figures.error_modes_1_to_6 == pytest.approx(6e-3)
    assert figures.error_mode_7 == figures.error_eq2 == pytest.approx(7e-3)
    assert figures.centrifugal_displacement == pytest.approx(1e-4)
    assert figures.coordinates == 24
    assert (table.value[table.blade == "reference"].to_numpy() == figures.to_numpy()).all()


def test_the_compliance_is_that_of_springs_under_their_shares_of_the_force(blade):
    springs = np.diag(np.repeat(np.arange(1.0, 9.0), 3)) * 1e6  # the same in all directions of a node
    expected = np.mean(1 / (8 * np.arange(1.0, 9.0) * 1e6))
    measured = blade_comparison.radial_compliance(replace(blade, stiffness_0=springs))
    assert measured == pytest.approx(expected, rel=1e-12)


def test_runs_are_compared_at_the_common_speeds(config, case, make_map):
    one = make_map(case, {4: (0.3, 1e-3)}, f_omega=[0.1, 0.25, 0.3], lobes=[2, 4, 5], growth=[0.0, 0.0, 0.1])
    other = make_map(case, {4: (0.3, 1e-3)}, f_omega=[0.1 + 1e-13, 0.2, 0.3], lobes=[2, 3, 4])
    table = blade_comparison.runs(config, [(one, other)], (0.1, 0.2))
    assert list(table.columns) == blade_comparison.RUN_COLUMNS
    assert set(table.columns) <= described_columns().keys()
    assert list(table.f_omega) == [0.1, 0.3]
    assert list(table.lobes) == [2, 5]
    assert list(table.reference_lobes) == [2, 4]
    assert list(table.divergent) == [False, True]
    assert not table.reference_divergent.any()
    assert table.worn_depth_share.to_numpy() == pytest.approx(1e-4 / 0.1, rel=1e-5)
    assert table.reference_worn_depth_share.to_numpy() == pytest.approx(1e-4 / 0.2, rel=1e-5)
    assert (table.casing == case.casing).all()
