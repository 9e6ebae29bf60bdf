"""Sweeps and long runs by rules beside the study, on the tiny one."""

import numpy as np
import pandas as pd
import pytest

from bladerub.io import hdf5

SWEPT = ["2nd_E1.1_K0.5_theta0", "2nd_rigid_mu0"]


@pytest.fixture
def beside(tiny):
    sweeps = {"coatings": [*SWEPT, "2nd_E7_K0.5_theta0"], "start": 0.16, "stop": 0.34, "rates": [1.0, 2.0]}
    return tiny | {"sweeps": sweeps | {"speed_step": 2e-3}, "long_runs": {"revolutions": 12}}


def test_sweeps_and_long_runs_are_planned(study, beside):
    plan = study.plan(beside, "sweeps", "long_runs")
    assert plan == {"sweep": 8, "sweeps": 1, "long_coating": 6, "long_runs": 1}


@pytest.mark.nightly
def test_sweeps_and_long_runs_are_made_when_asked_for(copied_study, beside):
    copied_study.build(beside, "sweeps", "long_runs")
    for name in ("sweeps", "long_runs"):
        assert (copied_study.results / "figures" / f"{name}.png").stat().st_size > 10_000

    table = pd.read_csv(copied_study.results / "tables" / "sweeps.csv")
    assert len(table) == 2 * 2 * 2 * 2  # coatings, directions, rates, engine orders
    assert (table.energy_residual < 1e-3).all()
    peaks = pd.read_csv(copied_study.results / "tables" / "peaks.csv")
    both = table.merge(peaks, on=["casing", "E", "K", "theta", "order"], suffixes=("", "_study"))
    assert len(both) == len(table)
    assert (both.amplitude_constant == both.amplitude_study).all()

    long = pd.read_csv(copied_study.results / "tables" / "long_runs.csv")
    assert set(long.revolutions) == {3, 6, 12}
    path = copied_study.results / "long_runs" / "2nd_E1.1_K0.5_theta0.h5"
    data, _ = hdf5.read(path)
    for f_omega, amplitude in zip(data["f_omega"], data["revolution_amplitude"], strict=True):
        run = copied_study.results / "runs" / "2nd_E1.1_K0.5_theta0" / f"{f_omega:.4f}.h5"
        np.testing.assert_array_equal(hdf5.read(run)[0]["revolution_amplitude"], amplitude[:3])

    assert copied_study.plan(beside, "sweeps", "long_runs") == {}
    beside["sweeps"]["rates"] = [1.0, 3.0]
    assert copied_study.plan(beside, "sweeps") == {"sweep": 4, "sweeps": 1}
    assert copied_study.plan(beside) == {}  # the study has no part in it
