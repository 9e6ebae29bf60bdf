import itertools
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from bladerub.extras.variations import margins
from bladerub.extras.variations.calibration import verdicts
from bladerub.study.grid import CoatingCase, speeds
from bladerub.study.maps import write_map

YOUNG = [0.11, 0.2, 0.5, 1.1, 2.0, 5.0, 20.0]
HARDENING = [0.1, 0.5, 1.0, 5.0]


@pytest.fixture
def study(config):
    config["speeds"] = {"start": 0.02, "stop": 0.4, "step": 0.01, "extra": [0.197, 0.206]}
    return config


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


@pytest.fixture
def varied(study, maps):
    return margins.variations(study, maps)


def test_speeds_and_moduli_are_dropped_but_not_those_that_are_named(varied, study, maps):
    variant = replace(maps[0], case=replace(maps[0].case, variant="xi0.001"))
    assert margins.variations(study, [*maps, variant])[margins.STUDY].maps == maps  # of coatings alone
    twice = varied["speed step 0.02"].maps[0]
    expected = np.union1d(np.arange(0.02, 0.4001, 0.02), [0.19, 0.197, 0.206])
    np.testing.assert_allclose(twice.f_omega, expected)
    chosen = np.isin(np.round(maps[0].f_omega, 6), np.round(expected, 6))
    np.testing.assert_array_equal(twice.spectrum_amplitude, maps[0].spectrum_amplitude[chosen])
    assert twice.angle is maps[0].angle
    for name, values in vars(twice).items():
        if name not in ("case", "angle", "spectrum_order"):
            assert len(values) == expected.size, name
    young = {coating.case.E for coating in varied["without E = 0.2, 5"].maps}
    assert young == set(YOUNG) - {0.2, 5.0}
    assert {coating.case.K for coating in varied["without K = 0.1, 5"].maps} == {0.5, 1.0}


@pytest.mark.parametrize(("name", "choice"), margins.SETTINGS.items())
def test_settings_are_varied_one_at_a_time(varied, study, name, choice):
    part, key, value = choice
    config, maps = varied[name]
    assert config["analysis"][part][key] == value != study["analysis"][part][key]
    config["analysis"][part][key] = study["analysis"][part][key]
    assert config == study
    assert maps == varied[margins.STUDY].maps


def test_a_table_has_every_claim_in_every_variation(study, maps, tmp_path):
    for coating in maps:
        write_map(tmp_path / f"{coating.case.name}.h5", coating, {})
    accuracy = [(f, mode, 1e-4) for f in (0.0, 0.4) for mode in range(1, 11)]
    pd.DataFrame(accuracy, columns=["f_omega", "mode", "relative_error"]).to_csv(tmp_path / "a.csv")
    table = margins.table(study, sorted(tmp_path.glob("*.h5")), tmp_path / "a.csv")
    assert list(table.columns) == margins.COLUMNS
    holds = verdicts(table, by="variation")
    assert list(holds.columns) == list(margins.variations(study, maps))
    # the narrow peak at 0.33 is on no speed of the thinned grid
    assert holds.loc["C6a", margins.STUDY] == "no"
    assert holds.loc["C6a", "speed step 0.02"] == "yes"
    assert holds.loc["C1a"].eq("yes").all()
    # what the study can tell all can, but those on K up to 0.1 without it
    assert holds.drop(columns="without K = 0.1, 5").notna().all(axis=None)
    assert set(holds.index[holds["without K = 0.1, 5"].isna()]) == {"C8a", "C8b", "C9d", "C9e"}
    assert {"C1a", "C1b", "C6a", "C6b", "C7a", "C7b", "C8a", "C9a"} <= set(holds.index)
