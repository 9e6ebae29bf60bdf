import numpy as np

from bladerub.io import hdf5
from bladerub.io.hdf5 import Variable
from bladerub.plots.history import history

REVOLUTION = (np.arange(200) + 0.5) / 50
STEADY = 1e-4 * np.sin(12 * np.pi * REVOLUTION)
GROWING = STEADY * np.exp(REVOLUTION / 2)
GROWING[150:] = np.nan
AMPLITUDE = [1.6e-4, 2.7e-4, 4.4e-4, np.nan]


def test_displacements_in_mm_on_one_scale_and_the_growth_of_both_runs(tmp_path, draws):
    paths = []
    for theta, displacement, amplitude in ((0.0, STEADY, [1e-4] * 4), (0.15, GROWING, AMPLITUDE)):
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
    table, figure = history(paths)
    axes = draws(figure).axes
    for panel, displacement in zip(axes, (STEADY, GROWING), strict=False):
        np.testing.assert_allclose(panel.lines[0].get_ydata(), 1e3 * displacement)
    assert axes[0].get_ylim() == axes[1].get_ylim()
    assert axes[0].get_ylim()[1] > 1e3 * np.nanmax(np.abs(GROWING))
    steady, growing = axes[2].lines
    np.testing.assert_allclose(steady.get_xydata(), np.transpose([[0.5, 1.5, 2.5, 3.5], [0.1] * 4]))
    np.testing.assert_allclose(growing.get_ydata(), 1e3 * np.array(AMPLITUDE))
    assert list(table.columns) == ["theta", "revolution", "radial_displacement"]
    np.testing.assert_array_equal(table[table.theta == 0.15].radial_displacement, GROWING)
