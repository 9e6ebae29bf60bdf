from collections import Counter
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from bladerub.config.errors import ConfigError
from bladerub.extras.plots.rotor import rotor
from bladerub.extras.rotor import summary
from bladerub.extras.rotor.plan import Combination, Patterns, Plan, read_plan
from bladerub.io.folders import ROOT
from bladerub.study.grid import CoatingCase

CASE = CoatingCase("2nd", 1.1, 0.5, 0.0)


def test_draws_are_those_of_their_number_whatever_the_others_and_a_plan_may_have_units(config, tmp_path):
    plan = read_plan(ROOT / "config" / "rotor.yaml", config)
    combination = Combination(CASE, 0.346, 4, 5e-5, 0.005)
    runs = plan.runs(config, combination.name).runs
    assert not any(run.follow for run in runs)
    assert runs[0].n_blades == 4
    assert len(runs) == plan.draws[combination]
    assert len({run.determinants for run in runs}) == len(runs)
    twice = plan.row(Combination(CASE, 0.346, 4, 1e-4, 0.005), 7)
    for one, other in zip(runs[7].row.blades, twice.blades, strict=True):
        assert other.length == pytest.approx(2 * one.length)
        assert other.frequency == one.frequency
    assert plan.row(Combination(CASE, 0.346, 4, coupling=0.01), 0).disk is not None
    assert runs[0].row.disk is None
    text = (ROOT / "config" / "rotor.yaml").read_text()
    assert "length_scatter: [5.0e-5]" in text
    (tmp_path / "plan.yaml").write_text(text.replace("length_scatter: [5.0e-5]", "length_scatter: [50 µm]"))
    assert read_plan(tmp_path / "plan.yaml", config) == plan


@pytest.mark.parametrize(
    ("typed", "instead", "problem"),
    [
        ("casing: 2nd, E: 20, K: 0.5", "casing: 3rd, E: 20, K: 0.5", 'groups.harder.casing = "3rd": must be'),
        ("[0.2, 0.344]", "[0.2, 0.9]", r"groups.harder.f_omega\[1\] = 0.9: must be at most"),
        ("[0.2, 0.344]", "[0.2, 0.200001]", "groups.harder.f_omega: 0.2 and 0.200001 would both be"),
    ],
)
def test_a_plan_is_of_casings_and_speeds_of_the_study(config, tmp_path, typed, instead, problem):
    text = (ROOT / "config" / "rotor.yaml").read_text()
    assert typed in text
    (tmp_path / "plan.yaml").write_text(text.replace(typed, instead))
    with pytest.raises(ConfigError, match=rf"plan.yaml:\d+: {problem}"):
        read_plan(tmp_path / "plan.yaml", config)


def test_the_distribution_of_known_draws():
    values = np.random.default_rng(1).permutation(np.arange(1, 200) / 100)
    harmonic = np.where(np.arange(199) < 150, 2, 4)
    status = np.where(np.arange(199) < 20, "unbounded", "completed")
    names = [*summary.WHAT, *summary.MEASURED, "draw", "divergent", "lobes", "energy_residual"]
    draws = pd.DataFrame(dict.fromkeys(names, 1.0) | {"longest_share": np.nan}, index=range(199))
    draws = draws.assign(casing="2nd", status=status, amplification=values, wear_harmonic=harmonic)
    found = summary.combinations(draws).iloc[0]
    assert found.amplification_median == pytest.approx(1.0)
    assert (found.amplification_p05, found.amplification_p95) == pytest.approx((0.109, 1.891))
    assert (found.rows, found.unbounded_rows) == (199, 20)
    assert (found.wear_harmonic, found.wear_harmonic_rows) == (2, 150)
    assert np.isnan(found.longest_share_median)
    # order statistics 86 and 114 of 199 hold the median with 95 %
    assert (found.amplification_low, found.amplification_high) == pytest.approx((0.86, 1.14))
    assert list(summary.combinations(summary.first_half(draws.head(1)))) == summary.COLUMNS


def test_rows_that_leave_the_limit_before_the_first_look_are_counted(config, monkeypatch):
    early = SimpleNamespace(unbounded=(1,))
    monkeypatch.setattr("bladerub.extras.rows.row.simulate_row", lambda *described: early)
    followed = Counter({Combination(CASE, 0.346, 4, 5e-5): 3})
    plan = Plan(1, Counter(), Counter(), followed, Patterns.model_construct(harmonic=4, interval=2))
    (drift,) = summary.drifts(summary.patterns(config, None, plan)).to_dict("records")
    assert (drift["rows"], drift["followed_rows"]) == (3, 0)
    assert np.isnan(drift["pattern_drift_median"])
    assert rotor(plan, pd.DataFrame()).texts  # of no rows


def test_the_pattern_that_a_row_wears_is_looked_at_every_few_revolutions(config, blade):
    followed, looks = (
        Counter({Combination(CASE, 0.2, 2, 5e-5): 1}),
        Patterns.model_construct(harmonic=2, interval=9),
    )
    table = summary.patterns(config, blade, Plan(1, Counter(), Counter(), followed, looks))
    assert table.revolution.tolist() == [9, 18]
    assert (table.pattern_depth > 1e-9).all()


@pytest.mark.parametrize("rate", [0.08, -0.08])
def test_the_drift_of_lobes_that_turn_evenly_is_their_rate(rate):
    angle = np.arange(240) * (2 * np.pi / 240)

    def worn(lobe):
        """Three lobes, one of them at `lobe`, on an even ground and a strong other harmonic."""
        return 2e-3 + 1e-4 * np.cos(3 * (angle - lobe)) + 1e-3 * np.cos(2 * angle)

    revolution = np.arange(1, 41)  # turns by more than the distance of two lobes
    parts = np.array([summary.component(angle, worn(0.3 + rate * at), 3) for at in revolution])
    assert np.abs(parts) == pytest.approx(1e-4)
    lobe = summary.lobe_angle(parts, 3)
    assert np.diff(lobe) == pytest.approx(rate)
    assert summary.drift_rate(revolution, lobe, np.abs(parts)) == pytest.approx(rate)
