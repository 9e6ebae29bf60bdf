import itertools
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from bladerub.contact.illustration import LoadingCycle
from bladerub.contact.spec import Coating
from bladerub.extras.chart import stiffening
from bladerub.extras.laws import cycles
from bladerub.extras.passages.sweeps import SpeedSweep
from bladerub.extras.plots.chart import QUANTITIES, chart_explanation, chart_map, chart_stiffening
from bladerub.extras.plots.passages import sweeps
from bladerub.extras.verification import steps
from bladerub.study.grid import CoatingCase


@pytest.fixture
def chart():
    """Two θ, three E, three K; highest at K = 0.5, which with E = 0.11 and 1.1 is the paper's."""
    heights = {0.3: 5e-4, 0.5: 1e-3, 2.0: 8e-4}
    values = itertools.product((0.0, 0.15), (0.11, 0.5, 1.1), heights)
    rows = pd.DataFrame(values, columns=["theta", "E", "K"]).assign(f4=0.3, f6=0.2, divergent_share=0.0)
    height = rows.K.map(heights) * (1 + rows.E)
    return rows.assign(**dict.fromkeys(("Y4", "Y6", "peak", "worn_volume", "deepest_wear"), height))


@pytest.mark.parametrize("quantity", [*QUANTITIES, "Y4", "f6"])
def test_every_quantity_is_drawn_with_the_paper_s_coatings_and_the_ridge(chart, draws, quantity):
    panel, *_ = draws(chart_map(chart, quantity, 2e8)).axes
    dots, _, ridge = panel.lines
    for line in (dots, ridge):
        assert sorted(zip(*line.get_data(), strict=True)) == [(0.11, 0.5), (0.5, 0.5), (1.1, 0.5)]


def test_the_ridge_is_drawn_against_what_explains_it_and_over_the_modulus(chart, blade, draws):
    peaks = chart.assign(order=4, amplitude=chart.Y4, E_T=chart.E * chart.K / (chart.E + chart.K))
    peaks = peaks.assign(wear_per_cycle=1e3 * peaks.amplitude, lobes=4)
    _, energy, *_ = draws(chart_explanation(peaks, 6e8)).axes
    np.testing.assert_allclose(energy.lines[1].get_xdata(), [1.11, 1.5, 2.1])
    peaks["f_crossing"], peaks["f_peak"] = 0.29, 0.29 + 0.05 * peaks.E_T
    (axes,) = draws(chart_stiffening(peaks, stiffening.table(peaks, blade), 6e8)).axes
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 0.29 + 0.05 * axes.lines[0].get_xdata())
    nothing = peaks.assign(**dict.fromkeys(("amplitude", "wear_per_cycle", "lobes", "f_peak"), np.nan))
    draws(chart_explanation(nothing, 6e8))
    draws(chart_stiffening(nothing, stiffening.table(nothing, blade), 6e8))


def test_each_law_has_a_panel_with_its_cycles_in_megapascals(draws):
    coating = Coating(2.0, 0.5, 0.0, 0.0, modulus_unit=6e8, thickness=5e-3, n_elements=2000)

    def cycle(stress):
        return LoadingCycle(coating, np.array([0.0, 0.01, 0.02]), np.asarray(stress), np.zeros(3))

    two = {"slow": cycle([0, 0, 0.01]), "fast": cycle([0, 0.01, 0.02])}
    slow, fast = draws(cycles.draw({"one": {"soft": cycle([0, 0.01, 0.01])}, "two": two})).axes[1].lines
    np.testing.assert_allclose(fast.get_xydata(), [[0, 0], [1, 6], [2, 12]])
    np.testing.assert_allclose(slow.get_ydata(), [0, 0, 6])


def test_a_sweep_is_drawn_by_direction_over_the_runs_at_constant_speed(draws):
    case, speeds = CoatingCase("2nd", 1.1, 0.5, 0.0), np.linspace(0.14, 0.4, 30)

    def sweep(direction, rate, status="completed"):
        amplitude = 1e-3 * np.exp(-(((speeds - 0.3) / 0.02) ** 2))
        if status == "unbounded":
            amplitude[20:] = np.nan
        speed, none = speeds if direction == "up" else speeds[::-1], np.empty((0, 3))
        spectra = none[:, 0], none[:, 0], speeds[:3], none
        return SpeedSweep(case, direction, rate, status, 1e-5, 1e-4, speed, amplitude, amplitude, *spectra)

    amplitude = np.array([[1e-4, 2e-4], [1e-3, 2e-3], [1e-4, 9e-3]])
    constant = SimpleNamespace(f_omega=np.array([0.2, 0.3, 0.4]), revolution_amplitude=amplitude)
    constant.status = np.array(["completed", "completed", "unbounded"])
    drawn = [sweep("up", 0.05), sweep("down", 0.05), sweep("up", 0.2, "unbounded")]
    up, down = draws(sweeps(drawn, {case: constant})).axes
    np.testing.assert_allclose(up.lines[0].get_ydata(), [0.2, 2.0, 9.0])
    np.testing.assert_allclose(down.lines[1].get_xdata(), speeds[::-1])


def test_errors_stand_over_steps_and_chaotic_runs_are_left_out():
    tolerances, counts = [0.03, 0.01, np.nan], [2e3, 4e3, 8e3]
    runs = pd.DataFrame({"E": [2.0, 2.0, 2.0, np.inf], "error": [1e-3, 3e-3, 0.5, 1e-4]})
    runs["sensitive"] = runs.error > 0.1
    finenesses = pd.DataFrame({"tolerance": tolerances, "steps_per_revolution": counts})
    panels = steps.draw_steps(finenesses.merge(runs, how="cross")).axes
    for panel, error in zip(panels, (2e-3, 2.8e-3), strict=True):  # median, and what most do not exceed
        of_E2 = next(line for line in panel.get_lines() if line.get_label() == "E = 2")
        np.testing.assert_allclose(of_E2.get_xdata(), [4e3, 2e3])
        np.testing.assert_allclose(of_E2.get_ydata(), error)
