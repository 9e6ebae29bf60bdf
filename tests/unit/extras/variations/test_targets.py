import itertools
from dataclasses import replace
from operator import attrgetter

import numpy as np
import pandas as pd
import pytest
from study_fixtures import changed

from bladerub.extras.variations.targets import measure
from bladerub.extras.variations.verdicts import SETTINGS, STUDY, margins, side_by_side, variations
from bladerub.study import divergence, peaks
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import CoatingCase, speeds
from bladerub.study.maps import write_map
from bladerub.study.paper import CRITICAL, SOFT, STRAIGHT, TILTED, WORN

SPEEDS = np.unique(np.append(np.round(np.arange(0.02, 0.4001, 0.004), 6), [0.19, 0.197]))


@pytest.fixture
def measured(config):
    def of(*maps):
        tables = {"peaks": peaks.table(config, maps), "divergence": divergence.table(config, maps)}
        evidence = Evidence(config, tables | {"rom_accuracy": None}, maps)
        return measure(evidence, [f"C{number}" for number in range(1, 13)])

    return of


@pytest.fixture
def hat(make_map):
    return lambda case, f4=0.311, Y4=2e-3, f6=0.1985, Y6=1e-3, **more: make_map(
        case, {4: (f4, Y4), 6: (f6, Y6)}, f_omega=SPEEDS, **more
    )


def test_a_peak_lies_between_the_speeds_of_the_grid_and_moduli_give_rise_step_and_spread(measured, hat):
    found = measured(hat(SOFT), hat(CRITICAL, Y4=4e-3, Y6=0.5e-3))
    assert found["f4_soft"] == pytest.approx(0.311, abs=5e-4)
    assert found["f6_soft"] == pytest.approx(0.1985, abs=1e-3)
    assert found["Y4_critical"] == pytest.approx(np.log(2), abs=1e-6)
    assert found["Y6_critical"] == pytest.approx(-np.log(2), abs=1e-6)
    f4 = {(1.1, 0.1): 0.3, (1.1, 0.5): 0.312, (1.1, 5): 0.308, (0.11, 0.1): 0.296}
    f4 |= {(21.0, 0.1): 0.33, (21.0, 5): 0.29, (0.1, 0.1): 0.28}  # outside the paper, as of the claims
    Y4 = {(0.11, 0.1): 1e-3, (21.0, 0.1): 9e-3}
    maps = [hat(CoatingCase("2nd", E, K, 0.0), f4=f, Y4=Y4.get((E, K), 2e-3)) for (E, K), f in f4.items()]
    found = measured(*maps)
    assert found["f4_rise"] == pytest.approx(0.008, abs=2e-4)
    assert found["f4_step"] == pytest.approx(-0.004, abs=2e-4)
    assert found["f4_spread"] == pytest.approx(0.004, abs=2e-4)
    assert found["Y4_spread"] == pytest.approx(2 / 3, abs=1e-3)


def test_growth_counts_above_the_limit_of_the_study_and_an_unbounded_run_counts_as_growing(measured, hat):
    growth = np.where(SPEEDS == 0.19, 0.05, 0.0)
    status = np.where(SPEEDS == 0.197, "unbounded", "completed")
    found = measured(hat(TILTED, growth=growth, f6=0.19), hat(STRAIGHT, status=status, f6=0.197))
    growths = [found[f"growth_C11{part}"] for part in "agbcd"]
    assert growths == pytest.approx([0.04, 0.04, 0.1, -0.01, -0.01])


def test_worn_lobes_and_maxima_of_the_casing_with_two_and_five_diameters(measured, hat, make_map):
    lobes = np.where(SPEEDS <= 0.08, 5, np.where(SPEEDS < 0.12, 10, np.where(SPEEDS > 0.36, 4, 5)))
    worn = make_map(WORN, {5: (0.262, 2e-3), 4: (0.381, 1e-3)}, f_omega=SPEEDS, lobes=lobes)
    found = measured(worn)
    lobes = [found[name] for name in ("five_0_0.08", "five_0.24_0.34", "harmonic_10_0.1", "harmonic_4_0.38")]
    assert lobes == pytest.approx([1, 1, 1, 1])
    assert found["wear_0.26"] == pytest.approx(0.262, abs=1e-3)
    assert found["wear_0.38"] == pytest.approx(0.381, abs=1e-3)
    assert found["offset_0.26"] == pytest.approx(0, abs=1e-6)
    for lobes, share in ((6, 1.0), (4, -1.0), (2, 0.0)):  # those of the casing are no rivals
        found = measured(hat(TILTED, lobes=lobes, f6=0.19))
        assert (found["six_C11e"], found["six_C11k"]) == pytest.approx((share, share), abs=1e-6)


YOUNG = [0.11, 0.2, 0.5, 1.1, 2.0, 5.0, 20.0]
HARDENING = [0.1, 0.5, 1.0, 5.0]


@pytest.fixture
def study(config):
    return changed(config, speeds={"start": 0.02, "stop": 0.4, "step": 0.01, "extra": [0.197, 0.206]})


@pytest.fixture
def maps(study, make_map):
    """Y4 is greatest at (1.1, 0.5), but between the even speeds it is greatest at (2, 1)."""
    f_omega = np.array(speeds(study))
    made = []
    for E, K in itertools.product(YOUNG, HARDENING):
        height = 1e-3 if (E, K) == (1.1, 0.5) else 2e-3 if (E, K) == (2.0, 1.0) else 0.5e-3
        f_peak = 0.32 if (E, K) != (2.0, 1.0) else 0.325
        coating = make_map(CoatingCase("2nd", E, K, 0.0), {4: (f_peak, height), 6: (0.2, 1e-4)}, f_omega)
        if (E, K) == (2.0, 1.0):  # a line narrower than the step
            coating.spectrum_amplitude[np.abs(coating.f_omega - 0.33) > 1e-9, 40] = 1e-7
        made.append(coating)
    return made


def test_speeds_and_moduli_are_dropped_but_not_those_that_are_named(study, maps):
    varied = variations(study, maps)
    variant = replace(maps[0], case=replace(maps[0].case, variant="xi0.001"))
    assert variations(study, [*maps, variant])[STUDY] == (study, maps)  # of coatings alone
    _, (twice, *_) = varied["speed step 0.02"]
    expected = np.union1d(np.arange(0.02, 0.4001, 0.02), [0.19, 0.197, 0.206])
    np.testing.assert_allclose(twice.f_omega, expected)
    chosen = np.isin(np.round(maps[0].f_omega, 6), np.round(expected, 6))
    np.testing.assert_array_equal(twice.spectrum_amplitude, maps[0].spectrum_amplitude[chosen])
    assert twice.angle is maps[0].angle
    for name, values in vars(twice).items():
        if name not in ("case", "angle", "spectrum_order"):
            assert len(values) == expected.size, name
    young = {coating.case.E for coating in varied["without E = 0.2, 5"][1]}
    assert young == set(YOUNG) - {0.2, 5.0}
    assert {coating.case.K for coating in varied["without K = 0.1, 5"][1]} == {0.5, 1.0}
    for name, (key, value) in SETTINGS.items():
        (config, of_all), setting = varied[name], attrgetter(key)
        assert setting(config.analysis) == value != setting(study.analysis)
        assert config.replaced(f"analysis.{key}", setting(study.analysis)) == study
        assert of_all == maps


def test_a_table_has_every_claim_in_every_variation(study, maps, tmp_path):
    for coating in maps:
        write_map(tmp_path / f"{coating.case.name}.h5", coating, {})
    accuracy = [(f, mode, 1e-4) for f in (0.0, 0.4) for mode in range(1, 11)]
    pd.DataFrame(accuracy, columns=["f_omega", "mode", "relative_error"]).to_csv(tmp_path / "a.csv")
    table = margins(study, sorted(tmp_path.glob("*.h5")), tmp_path / "a.csv")
    holds = side_by_side(table, by="variation")
    assert list(holds.columns) == list(variations(study, maps))
    # the narrow peak at 0.33 is on no speed of the thinned grid
    assert holds.loc["C6a", STUDY] == "no"
    assert holds.loc["C6a", "speed step 0.02"] == "yes"
    assert holds.loc["C1a"].eq("yes").all()
    # what the study can tell all can, but those on K up to 0.1 without it
    assert holds.drop(columns="without K = 0.1, 5").notna().all(axis=None)
    assert set(holds.index[holds["without K = 0.1, 5"].isna()]) == {"C8a", "C8b", "C9d", "C9e"}
