import json
import math
from dataclasses import fields, replace
from types import SimpleNamespace
from unittest.mock import Mock

import numpy as np
import pandas as pd
import pytest
from study_fixtures import CONFIG, changed

from bladerub.config.errors import ConfigError
from bladerub.config.read import validate
from bladerub.extras import study_runs
from bladerub.extras.verification import verify
from bladerub.extras.verification.compare import compare as compare_tables
from bladerub.extras.verification.differences import UNBOUNDED, Differences, differences
from bladerub.extras.verification.verify import NEIGHBOURS, StudyRun, VerifiedRun, summary
from bladerub.study.grid import CoatingCase, speeds
from bladerub.study.maps import write_map


class Solver:
    """Stands in for `simulate`: relative errors of a known law in the time step, in wear and peaks."""

    neighbour = 0.0  # relative change by any initial displacement

    def __init__(self, make_result):
        self.make_result, self.specs = make_result, []
        self.exponential = lambda step: 2e9 * step**2

    def __call__(self, blade, spec):
        self.specs.append(spec)
        passage = 1 / (spec.f_omega * blade.f1_hz * spec.coating.n_elements)
        steps = max(spec.steps_per_element, math.ceil(passage / spec.max_time_step))
        step = passage / steps
        error = (self.exponential if spec.scheme == "exponential" else lambda step: 2e4 * step)(step)
        error += self.neighbour * (spec.initial_displacement != 0)
        result = self.make_result(amplitude=1e-3 * (1 + error), depth=2e-4 * (1 + error))
        return replace(result, time_step=step, energy=SimpleNamespace(residual=1e-4))


@pytest.fixture
def solver(monkeypatch, make_result):
    monkeypatch.setattr(verify, "simulate", Solver(make_result))
    return verify.simulate


@pytest.fixture
def verified(blade, config, case, solver):
    steps = {"scheme": "exponential", "steps_per_element": 6, "max_time_step": 2e-6}
    return lambda: verify.verify_run(blade, changed(config, solver=steps), StudyRun(case, 0.19))


def test_the_important_runs_are_the_peaks_with_their_neighbours_in_speed(config, make_map, tmp_path):
    case = CoatingCase("2nd", 1.1, 0.5, 0.0)
    grid = {"start": 0.1, "stop": 0.4, "step": 0.05, "extra": []}
    config = changed(config, coatings=[{"casing": "2nd", "E": [1.1], "K": [0.5], "theta": [0]}], speeds=grid)
    coating = make_map(case, {4: (0.3, 2e-4), 6: (0.2, 5e-4)}, speeds(config))
    write_map(tmp_path / f"{case.name}.h5", coating, {})
    runs = study_runs.important_runs(config, tmp_path)
    assert {run.case for run in runs} == {case}
    np.testing.assert_allclose([run.f_omega for run in runs], [0.15, 0.2, 0.25, 0.3, 0.35])


def test_errors_of_known_order(blade, verified, solver):
    verified = verified()
    step = 1 / (0.19 * blade.f1_hz * 2000) / 7
    fine = 2e9 * step**2 / 16
    assert verified.error == pytest.approx(Differences(*3 * [15 * fine / (1 + fine)]))
    paper_step = 1 / (0.19 * blade.f1_hz * 2000) / solver.specs[-1].steps_per_element
    own = 2e4 * paper_step
    assert verified.paper_uncertainty == pytest.approx(Differences(*3 * [own / (1 + own)]))
    assert verified.against_paper == pytest.approx(Differences(*3 * [abs(16 * fine - own) / (1 + own)]))
    assert (verified.status, verified.energy_residual, verified.spread) == ("completed", 1e-4, None)
    assert not verified.is_beyond
    assert not verified.is_sensitive


def test_a_run_beyond_one_percent_is_started_again_beside_its_start(verified, solver):
    solver.exponential = lambda step: 0.032 if step > 1e-6 else 0.002
    solver.neighbour = 0.01
    found = verified()
    assert [spec.initial_displacement for spec in solver.specs[4:]] == list(NEIGHBOURS)
    assert found.is_beyond
    assert found.spread == pytest.approx(Differences(*3 * [0.01 / 1.032]))
    assert not found.is_sensitive


def test_sensitive_is_what_spreads_half_as_much_in_all_that_is_beyond():
    one, two = Differences(0.03, 0.001, 0.001), Differences(0.03, 0.02, 0.001)
    values = dict.fromkeys(field.name for field in fields(VerifiedRun))
    for error, spread, sensitive in (
        (one, Differences(0.016, 0, 0), True),
        (one, Differences(0.014, 1, 1), False),
        (two, Differences(0.016, 0.009, 0), False),
        (Differences(0.02, 0.01, 0.0), Differences(0.01, 0.0, 0.0), True),  # at the borders of both
        (one, None, False),
    ):
        assert VerifiedRun(**values | {"error": error, "spread": spread}).is_sensitive is sensitive


def test_speed_up_between_a_second_order_and_a_first_order_scheme():
    error, paper_error = 2e9 * 2e-6**2, 2e5 * 3e-7
    expected = 4.0 * (3e-7 / 4) / (error / 2e5) / 0.25  # at the step of equal error
    found = verify.speedup_at_equal_error(error, 0.25, paper_error, paper_error / 4, 4.0)
    assert found == pytest.approx(expected)


def test_each_difference_is_relative_to_the_reference_of_a_row_to_the_blade_that_vibrates_most(
    make_result, config
):
    def compare(outcome, reference):
        return differences([outcome], [reference], config.analysis)

    reference = make_result(amplitude=1e-3, depth=2e-4)
    found = compare(make_result(amplitude=1.02e-3, depth=2.1e-4), reference)
    assert found == pytest.approx(Differences(wear_l2=0.05, peak=0.02, revolution_peak=0.02))
    turned = replace(reference, wear=np.roll(reference.wear, 1000 // 6, axis=1))  # into valleys of 6 lobes
    assert compare(turned, reference).wear_l2 == pytest.approx(math.sqrt(2), rel=0.01)
    for first, second in ((None, 3), (3, None)):
        assert compare(make_result(complete=first), make_result(complete=second)) == UNBOUNDED

    def row(large, small):
        wear = make_result(depth=2e-4)
        return [replace(make_result(amplitude=of), wear=wear.wear) for of in (small, large)]

    found = differences(row(1e-3, 2e-5), row(1e-3, 1e-5), config.analysis)
    assert found == pytest.approx(Differences(0.0, 0.01, 0.01), rel=1e-6)
    one = row(1e-3, 1e-5)[0]
    assert compare(one, one) == Differences(0.0, 0.0, 0.0)


def run_with(f_omega, wear, peak=0.0, revolution_peak=0.0, **changes):
    run = StudyRun(CoatingCase("2nd", 2.0, 0.5, 0.0), f_omega)
    error, fine = Differences(wear, peak, revolution_peak), Differences(0.001, 0.0, 0.0)
    values = {"run": run, "status": "completed", "error": error, "energy_residual": 1e-4, "speedup": 7.0}
    values |= {"against_paper": fine, "paper_uncertainty": fine, "seconds": {"study": 0.25, "finer": 1.0}}
    values |= {"spread": fine if max(error) > 0.01 else None}
    return VerifiedRun(**values | changes)


def test_runs_beyond_tolerance_the_worst_first():
    runs = [
        run_with(0.1, 0.002),
        run_with(0.2, 0.02, spread=Differences(0.015, 0.0, 0.0)),
        run_with(0.3, 0.001, revolution_peak=0.03),
        run_with(0.4, math.inf, math.inf, math.inf, status="unbounded", spread=None),
    ]
    figures = summary(runs)
    assert [entry["f_omega"] for entry in figures["beyond"]] == [0.4, 0.3, 0.2]
    assert figures["within_1_percent"] == 0.5  # the peak of a revolution does not count
    assert figures["beyond"][2]["sensitive"]
    assert (figures["beyond"][0]["wear_l2"], figures["beyond"][0]["spread"]) == (None, None)
    json.dumps(figures, allow_nan=False)


def test_numbers_agree_within_twice_the_uncertainty_of_both(tmp_path):
    known = {"number": ["f1", "f2", "share"], "value": [100.0, 200.0, 0.25], "unit": ["Hz", "Hz", "1"]}
    known = pd.DataFrame(known).assign(uncertainty=[0.5, 1.0, 0.0])
    cases = ((100.999, 0, True), (99.001, 0, True), (101.001, 0, False), (102.599, 1.2, True))
    for f1, uncertainty, agrees in cases:
        own = known.assign(value=[f1, 200.0, 0.25], uncertainty=[uncertainty, 0.0, 0.0])
        own = own if uncertainty else own.drop(columns=["unit", "uncertainty"])
        for folder, table in (("reference", known), ("own", own)):
            (tmp_path / folder).mkdir(exist_ok=True)
            table.to_csv(tmp_path / folder / "blade.csv", index=False)
        found = compare_tables(tmp_path / "own", tmp_path / "reference")
        assert found.agrees.tolist() == [agrees, True, True]
        assert found.number.tolist() == ["f1", "f2", "share"]
        assert found.allowed[0] == pytest.approx(2 * math.hypot(0.5, uncertainty), rel=1e-3)


def test_a_row_holds_errors_what_starts_change_and_cost(monkeypatch):
    def drawn(run):
        """A run that is beyond one percent, and sensitive, above 0.2."""
        if run.f_omega <= 0.2:
            return run_with(run.f_omega, 0.001, run=run, speedup=200.0)
        spread = Differences(0.015, 0.0, 0.0)
        return run_with(run.f_omega, 0.02, 0.001, 0.002, run=run, spread=spread, speedup=None)

    case = CoatingCase("2nd", 2.0, 0.5, 0.15)
    runs = [StudyRun(case, 0.1 + 0.01 * number) for number in range(12)]
    monkeypatch.setattr(verify, "verify_runs", lambda blade, config, runs: map(drawn, runs))
    lines = []
    table = verify.table(None, {}, {"all": runs, "important": runs[-2:]}, lines.append)
    assert len(lines) == len(table) == 3 * 12 + 2  # drawn thrice
    row, within = table[table.f_omega > 0.2].iloc[0], table[table.f_omega < 0.2].iloc[0]
    assert (row.E, row.K, row.theta, row.law, row.status) == (2.0, 0.5, 0.15, "theta", "completed")
    assert (row.error_wear_l2, row.error_revolution_peak, row.start_wear_l2) == (0.02, 0.002, 0.015)
    assert (row.sensitive, row.cpu_s, within.sensitive) == (True, 0.25, False)
    assert math.isnan(within.start_wear_l2)
    assert within.speedup_at_equal_error == 200.0


def test_central_differences_are_checked_by_the_blade_that_is_built(monkeypatch):
    """Its highest mode in coordinates of 1 kg has 1e6 rad/s."""
    config = CONFIG.plain()
    n, f1 = 30, 2 * np.pi * 480.0
    stiffness = np.diag(np.linspace(f1, 1e6, n) ** 2)
    blade = Mock(f1_hz=480.0, mass=np.eye(n), stiffness=lambda f_omega: stiffness)
    monkeypatch.setattr("bladerub.blade.files.is_built", lambda *_: True)
    monkeypatch.setattr("bladerub.blade.validation.read_reduced_blade", lambda _: blade)
    config["solver"]["max_time_step"] = 3e-6
    validate(config)
    config["solver"]["scheme"] = "central_differences"
    with pytest.raises(ConfigError, match=r"solver.max_time_step = 3e-06: .* below 2e-06"):
        validate(config)
    config["solver"]["max_time_step"] = 1.9e-6
    validate(config)
