from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from bladerub.contact.law import element
from bladerub.contact.setup import element_area, time_step
from bladerub.contact.steps import with_steps
from bladerub.extras.verification import refinement, response
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.peaks import COLUMNS

CASE = CoatingCase("2nd", 2.0, 0.5, 0.15)


def test_tip_coating_and_step_stay_the_same(blade, config):
    own = with_steps(run_spec(config, CASE, 0.3), 20)
    finer = refinement.with_finer_bars(blade, own, 4)
    assert finer.coating.n_elements == 4 * own.coating.n_elements
    assert finer.tip.half_width / finer.coating.n_elements == pytest.approx(
        own.tip.half_width / own.coating.n_elements
    )
    assert finer.tip.curvature * 16 == pytest.approx(own.tip.curvature)  # elements are a quarter as wide
    assert time_step(blade, finer) == pytest.approx(time_step(blade, own))
    elastic = [element(spec.coating, element_area(blade, spec)).elastic for spec in (own, finer)]
    np.testing.assert_allclose(4 * elastic[1], elastic[0])


@pytest.fixture
def bars(blade, config, make_result, monkeypatch):
    """The table of a response whose peak is at 0.31, with finer bars at 0.314 and half as high."""

    def simulate(_, spec):
        finer = spec.coating.n_elements // config["contact"]["elements"]
        peak = {1: 0.31, 2: 0.314, 4: 0.314}[finer]
        result = make_result(amplitude=1e-3 * (1 - abs(spec.f_omega - peak)) / min(finer, 2), depth=1e-4)
        return replace(result, wear=np.repeat(result.wear, finer, axis=1) * finer)

    monkeypatch.setattr(response, "simulate", simulate)
    rows = [
        ["2nd", 2.0, 0.5, 0.15, 6, 0.31, 1e-3, "theta"],
        ["2nd", 2.0, 0.5, 0.15, 6, 0.31, 1e-3, "coulomb"],
        ["2nd", 2.0, 1.0, 0.0, 6, 0.31, 1e-3, "theta"],
    ]
    return refinement.finer_bars(blade, config, pd.DataFrame(rows, columns=COLUMNS))


def test_the_peak_is_followed_and_compared_with_that_of_the_study(bars, config):
    n = config["contact"]["elements"]
    assert bars.elements.tolist() == [n, 2 * n, 4 * n]  # of the listed coating alone
    assert bars.f_peak.tolist() == [0.31, 0.314, 0.314]
    np.testing.assert_allclose(bars.amplitude_change, [0, -0.5, -0.5], atol=1e-9)


def test_wear_is_compared_as_the_mean_under_each_element_of_the_study(bars):
    np.testing.assert_allclose(bars.volume_change, [0, 1, 3], atol=1e-9)
    np.testing.assert_allclose(bars.wear_difference, [0, 1, 3], atol=1e-9)
