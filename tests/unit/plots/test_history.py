import numpy as np
import pytest

from bladerub.io import hdf5
from bladerub.io.hdf5 import Variable
from bladerub.plots.history import history

REVOLUTION = (np.arange(200) + 0.5) / 50
STEADY = 1e-4 * np.sin(12 * np.pi * REVOLUTION)
GROWING = STEADY * np.exp(REVOLUTION / 2)
GROWING[150:] = np.nan
AMPLITUDE = {"θ = 0": [1e-4] * 4, "θ = 0.15 rad": [1.6e-4, 2.7e-4, 4.4e-4, np.nan]}


@pytest.fixture
def run_files(tmp_path):
    paths = []
    for theta, displacement, amplitude in zip(
        (0.0, 0.15), (STEADY, GROWING), AMPLITUDE.values(), strict=True
    ):
        paths.append(tmp_path / f"{theta}.h5")
        variables = {
            "revolution": Variable(("revolution",), REVOLUTION, "1", "time"),
            "radial_displacement": Variable(("revolution",), displacement, "m", "of node 1"),
            "revolution_peak": Variable(("revolution_number",), 2 * np.asarray(amplitude), "m", "largest"),
            "revolution_amplitude": Variable(("revolution_number",), amplitude, "m", "half range"),
            "wear": Variable(("node",), np.zeros(8), "m", "worn depth"),
            "spectrum_amplitude": Variable(("spectrum_order",), np.zeros(3), "m", "amplitude"),
        }
        about = {"casing": "2nd", "E": 2.0, "K": 0.5, "theta": theta, "f_omega": 0.19, "run_key": "key"}
        hdf5.write(paths[-1], variables, about)
    return paths


@pytest.fixture
def drawn(run_files, draws):
    table, figure = history(run_files)
    return table, draws(figure)


@pytest.fixture
def axes(drawn):
    return drawn[1].axes


def test_displacements_in_mm_on_one_scale(axes):
    for panel, displacement in zip(axes, (STEADY, GROWING), strict=False):
        np.testing.assert_allclose(panel.lines[0].get_ydata(), 1e3 * displacement)
    assert axes[0].get_ylim() == axes[1].get_ylim()
    assert axes[0].get_ylim()[1] > 1e3 * np.nanmax(np.abs(GROWING))


def test_the_growth_of_both_runs(axes):
    steady, growing = axes[2].lines
    np.testing.assert_allclose(steady.get_xydata(), np.transpose([[0.5, 1.5, 2.5, 3.5], [0.1] * 4]))
    np.testing.assert_allclose(growing.get_ydata(), [0.16, 0.27, 0.44, np.nan])


def test_runs_are_read_from_their_files_and_named_by_their_angle(drawn):
    table, figure = drawn
    assert list(table.columns) == ["theta", "revolution", "radial_displacement"]
    np.testing.assert_array_equal(table[table.theta == 0.15].radial_displacement, GROWING)
    assert figure.get_suptitle() == r"casing 2nd, E = 2, K = 0.5, $f_\Omega$ = 0.190"
