import numpy as np
import pytest

from bladerub.extras.variations.targets import measure
from bladerub.study import divergence, peak_table
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import CoatingCase
from bladerub.study.paper import CRITICAL, SOFT, STRAIGHT, TILTED, WORN

SPEEDS = np.unique(np.append(np.round(np.arange(0.02, 0.4001, 0.004), 6), [0.19, 0.197]))


@pytest.fixture
def measured(config):
    """Measure all targets on the given maps."""

    def of(*maps):
        tables = {"peaks": peak_table.table(config, maps), "divergence": divergence.table(config, maps)}
        evidence = Evidence(config, tables | {"rom_accuracy": None}, maps)
        return measure(evidence, [f"C{number}" for number in range(1, 13)])

    return of


@pytest.fixture
def hat(make_map):
    """A map with peaks of order 4 and 6 between the speeds of the grid."""

    def make(case, f4=0.311, Y4=2e-3, f6=0.1985, Y6=1e-3, **more):
        return make_map(case, {4: (f4, Y4), 6: (f6, Y6)}, f_omega=SPEEDS, **more)

    return make


def test_a_peak_lies_between_the_speeds_of_the_grid(measured, hat):
    found = measured(hat(SOFT), hat(CRITICAL, Y4=4e-3, Y6=0.5e-3))
    assert found["f4_soft"] == pytest.approx(0.311, abs=5e-4)
    assert found["f6_soft"] == pytest.approx(0.1985, abs=1e-3)
    assert found["Y4_critical"] == pytest.approx(np.log(2), abs=1e-6)
    assert found["Y6_critical"] == pytest.approx(-np.log(2), abs=1e-6)


def test_growth_counts_above_the_limit_of_the_study_and_an_unbounded_run_counts_as_growing(measured, hat):
    growth = np.where(SPEEDS == 0.19, 0.05, 0.0)
    status = np.where(SPEEDS == 0.197, "unbounded", "completed")
    found = measured(hat(TILTED, growth=growth, f6=0.19), hat(STRAIGHT, status=status, f6=0.197))
    assert found["growth_C11a"] == pytest.approx(0.04)
    assert found["growth_C11g"] == pytest.approx(0.04)
    assert found["growth_C11b"] == pytest.approx(0.1)
    assert found["growth_C11c"] == pytest.approx(-0.01)
    assert found["growth_C11d"] == pytest.approx(-0.01)


@pytest.mark.parametrize(("lobes", "share"), [(6, 1.0), (4, -1.0), (2, 0.0)])
def test_six_lobes_are_a_share_of_the_wear_and_the_casing_is_no_rival(measured, hat, lobes, share):
    found = measured(hat(TILTED, lobes=lobes, f6=0.19))
    assert found["six_C11e"] == pytest.approx(share, abs=1e-6)
    assert found["six_C11k"] == pytest.approx(share, abs=1e-6)


def test_worn_lobes_and_maxima_of_the_casing_with_two_and_five_diameters(measured, hat, make_map):
    lobes = np.where(SPEEDS <= 0.08, 5, np.where(SPEEDS < 0.12, 10, np.where(SPEEDS > 0.36, 4, 5)))
    worn = make_map(WORN, {5: (0.262, 2e-3), 4: (0.381, 1e-3)}, f_omega=SPEEDS, lobes=lobes)
    found = measured(worn)
    assert found["five_0_0.08"] == pytest.approx(1)
    assert found["five_0.24_0.34"] == pytest.approx(1)
    assert found["harmonic_10_0.1"] == pytest.approx(1)
    assert found["harmonic_4_0.38"] == pytest.approx(1)
    assert found["wear_0.26"] == pytest.approx(0.262, abs=1e-3)
    assert found["wear_0.38"] == pytest.approx(0.381, abs=1e-3)
    assert found["offset_0.26"] == pytest.approx(0, abs=1e-6)


def test_moduli_give_rise_step_and_spread(measured, hat):
    f4 = {(1.1, 0.1): 0.3, (1.1, 0.5): 0.312, (1.1, 5): 0.308, (0.11, 0.1): 0.296}
    Y4 = {(0.11, 0.1): 1e-3}
    maps = [hat(CoatingCase("2nd", E, K, 0.0), f4=f, Y4=Y4.get((E, K), 2e-3)) for (E, K), f in f4.items()]
    found = measured(*maps)
    assert found["f4_rise"] == pytest.approx(0.008, abs=2e-4)
    assert found["f4_step"] == pytest.approx(-0.004, abs=2e-4)
    assert found["f4_spread"] == pytest.approx(0.004, abs=2e-4)
    assert found["Y4_spread"] == pytest.approx(2 / 3, abs=1e-3)
