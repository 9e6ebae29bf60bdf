import itertools

import numpy as np
import pandas as pd
import pytest

from bladerub.contact.illustration import LoadingCycle
from bladerub.contact.spec import Coating
from bladerub.extras.chart import stiffening
from bladerub.extras.laws import cycles
from bladerub.extras.plots.chart import QUANTITIES, chart_explanation, chart_map, chart_stiffening


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
