import numpy as np
import pytest

from bladerub.config.read import load, validate
from bladerub.extras.rotor import pattern
from bladerub.extras.rotor.plan import Combination, Patterns, Plan
from bladerub.io.folders import ROOT
from bladerub.study.grid import CoatingCase

ANGLE = np.arange(240) * (2 * np.pi / 240)


def worn(lobe, depth=1e-4):
    """Three lobes, one of them at `lobe`, on an even ground and a strong other harmonic."""
    return 2e-3 + depth * np.cos(3 * (ANGLE - lobe)) + 1e-3 * np.cos(2 * ANGLE)


@pytest.mark.parametrize("rate", [0.08, -0.08])
def test_the_drift_of_lobes_that_turn_evenly_is_their_rate(rate):
    revolution = np.arange(1, 41)  # turns by more than the distance of two lobes
    parts = np.array([pattern.component(ANGLE, worn(0.3 + rate * at), 3) for at in revolution])
    assert np.abs(parts) == pytest.approx(1e-4)
    lobe = pattern.lobe_angle(parts, 3)
    assert np.diff(lobe) == pytest.approx(rate)
    assert pattern.drift_rate(revolution, lobe, np.abs(parts)) == pytest.approx(rate)


@pytest.mark.slow
def test_the_depths_of_all_intervals_make_the_wear_of_the_run(blade):
    config = validate(load(ROOT / "config" / "config.yaml"))
    config["solver"]["revolutions"] = 3
    combination = Combination(CoatingCase("2nd", 1.1, 0.5, 0.0), 0.3, 2, 5e-5)
    plan = Plan(1, {}, {}, (), (), Patterns(2, 1, {combination: 2}))
    followed = pattern.table(config, blade, plan)
    assert list(followed.columns) == pattern.COLUMNS
    assert followed.groupby("draw").revolution.apply(list).tolist() == [[1, 2, 3], [1, 2, 3]]
    spec = pattern.run_spec(config, combination.case, combination.f_omega)
    whole = pattern.simulate_row(blade, spec, combination.row(1))
    first = followed[followed.draw == 0]
    parts = np.sum(first.pattern_depth * np.exp(-2j * first.pattern_angle))
    assert parts == pytest.approx(pattern.component(whole.angle, whole.wear.mean(axis=0), 2))
    summary = pattern.drifts(followed)
    assert summary[["rows", "followed_rows"]].values.tolist() == [[2, 2]]
    assert summary.pattern_drift_median[0] == pytest.approx(
        followed.drop_duplicates("draw").pattern_drift.mean()
    )
