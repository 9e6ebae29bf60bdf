import h5py
import numpy as np
import pytest

from bladerub.contact.result import Energy
from bladerub.extras.passages import long_runs, sweep_grid, sweeps
from bladerub.extras.passages.speed_sweep import SweepResult
from bladerub.study.grid import CoatingCase
from bladerub.study.peaks import peak

CASE = CoatingCase("2nd", 1.1, 0.5, 0.0)
REVOLUTIONS = 60


@pytest.fixture
def make(config, blade, monkeypatch, angle, tmp_path):
    """Make a sweep that vibrates on engine order 4, by a hat over speed."""

    def simulate_sweep(_, spec):
        f_omega = np.linspace(spec.run.f_omega, spec.f_end, REVOLUTIONS)
        height = 1e-3 * np.clip(1 - np.abs(f_omega - 0.3) / 0.05, 0.001, None)
        track = height[:, None] * np.sin(4 * angle)
        if spec.rate == 7.0:
            track[15:], track[14, 100:] = np.nan, np.nan
            height = np.where(np.arange(REVOLUTIONS) > 14, np.nan, height)
        told = {"status": "unbounded" if spec.rate == 7.0 else "completed", "message": "for a test"}
        told |= {"n_steps": 1000, "n_contact_steps": 300}
        motion = {"radial_displacement": track.ravel(), "revolution_peak": height}
        motion |= {"revolution_amplitude": height, "f_omega": f_omega, "time": np.arange(REVOLUTIONS) + 0.5}
        worn = {"angle": angle, "wear": np.full((8, angle.size), 2e-4)}
        return SweepResult(**told, **motion, **worn, energy=Energy(*np.arange(1.0, 14.0)), work_stiffness=0.5)

    monkeypatch.setattr(sweeps, "simulate_sweep", simulate_sweep)

    def make(direction, rate):
        path = tmp_path / f"{direction}_{rate}.h5"
        sweeps.make(config, CASE, blade, direction, rate, path)
        with h5py.File(path) as file:
            assert file["node"][:].tolist() == list(range(1, 9))  # as in every other file
        return sweeps.read(path)

    return make


@pytest.mark.parametrize("direction", sweep_grid.DIRECTIONS)
def test_spectra_are_of_windows_in_the_order_of_speed(make, config, direction):
    sweep = make(direction, 0.05)
    window = config.analysis.spectrum_revolutions
    assert sweep.f_omega.size == REVOLUTIONS - window + 1
    assert (np.diff(sweep.f_omega) > 0).all()
    assert (np.diff(sweep.speed) > 0).all() == (direction == "up")
    best = np.unravel_index(np.argmax(sweep.spectrum_amplitude), sweep.spectrum_amplitude.shape)
    assert sweep.f_omega[best[0]] == pytest.approx(0.3, abs=0.003)
    assert sweep.spectrum_order[best[1]] == 4
    np.testing.assert_allclose(sweep.C1, np.sqrt(1 + 3 * sweep.f_omega**2))
    assert (sweep.case, sweep.direction, sweep.rate, sweep.status) == (CASE, direction, 0.05, "completed")


def test_peaks_stand_beside_those_at_constant_speed(make, make_map, config):
    config = config.replaced("sweeps.survival", 0.5)
    maps = {CASE: make_map(CASE, {4: (0.3, 1.5e-3), 6: (0.2, 5e-4)})}
    table = sweeps.table(config, [make("up", 0.05), make("down", 0.05), make("up", 7.0)], maps)
    assert len(table) == 6
    whole = table[(table.order == 4) & (table.rate == 0.05)]
    constant = peak(maps[CASE], 4, config.analysis.peaks)
    assert (whole.amplitude_constant == constant.amplitude).all()
    assert (whole.f_peak_constant == 0.3).all()
    assert whole.f_peak.to_numpy() == pytest.approx(0.3, abs=0.003)
    assert whole.ratio.to_numpy() == pytest.approx(whole.amplitude / 1.5e-3)
    assert whole.survives.all()
    assert not table[table.order == 6].survives.any()
    ended = table[(table.order == 4) & (table.rate == 7.0)].iloc[0]
    assert np.isnan(ended.f_peak)
    assert (ended.survives, ended.status) == (False, "unbounded")
    assert ended.f_end == pytest.approx(np.linspace(0.14, 0.4, REVOLUTIONS)[14])


def test_runs_that_grow_to_the_end_and_peaks_are_chosen(config, make_map):
    """Peaks at 0.2 and 0.3; grows at 0.05 and 0.2, and saturates in the longer run at 0.1."""
    f_omega = np.round(np.arange(0.02, 0.4001, 0.01), 6)
    growth = np.where(np.isin(f_omega, [0.05, 0.1, 0.2]), 0.04, 0.0)
    longer = np.full((f_omega.size, 60), np.nan)
    longer[np.isclose(f_omega, 0.05)] = 1e-6 * 1.04 ** np.arange(60)
    longer[np.isclose(f_omega, 0.1)] = 1e-6
    coating = make_map(CASE, {4: (0.3, 2e-4), 6: (0.2, 5e-4)}, growth=growth, longer=longer)
    assert long_runs.chosen(config, coating) == {0.05: "grows", 0.2: "f6", 0.3: "f4"}


def test_what_is_said_after_more_and_more_revolutions(config):
    number = np.arange(200.0)
    ended, free = 1e-4 * 1.05**number, 1e-4 * 1.05**number
    free[70:] = free[69] * 0.9 ** np.arange(1, 131)
    ended[70:] = np.nan
    saturating = 1e-4 * (2 - np.exp(-number / 30))
    for amplitude, verdicts in (
        (np.full(200, 1e-4), ["steady"] * 4),
        (saturating, ["divergent", "saturating", "saturating", "saturating"]),
        (1e-4 * 1.02**number, ["divergent"] * 4),
        (ended, ["divergent", "divergent", "unbounded", "unbounded"]),
        (free, ["divergent", "divergent", "saturating", "free"]),
    ):
        said = [long_runs.verdict_after(config, amplitude, stop)[0] for stop in (20, 60, 100, 200)]
        assert said == verdicts
