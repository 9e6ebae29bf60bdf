import itertools

import numpy as np
import pytest

from bladerub.plots.campbell import campbell

SPEED = np.linspace(0, 0.4, 5)
FE = np.sqrt(np.array([1, 9, 25])[None] + 4 * SPEED[:, None] ** 2)
ROM = 1.01 * FE


@pytest.fixture
def axes(draws):
    return draws(campbell(SPEED, FE, ROM, range(1, 13))).axes


def test_both_models_in_both_panels(axes):
    for panel in axes:
        rom = [line for line in panel.lines if line.get_label() in ("reduced model", "_rom")]
        fe = [line for line in panel.lines if line.get_label() in ("finite elements", "_fe")]
        np.testing.assert_array_equal(np.transpose([line.get_ydata() for line in rom]), ROM)
        np.testing.assert_array_equal(np.transpose([line.get_ydata() for line in fe]), FE)
        assert all(line.is_dashed() for line in fe)
        assert not any(line.is_dashed() for line in rom)
        assert r"f_\Omega" in panel.get_xlabel()


def test_the_second_panel_shows_the_first_mode_alone_with_all_engine_orders(axes):
    assert ROM[:, 0].max() < axes[1].get_ylim()[1] < ROM[:, 1].min()
    assert sum(line.get_label() in ("_eo", "engine orders eo(k)") for line in axes[1].lines) == 12
    assert axes[0].get_ylim()[1] > ROM.max()


def test_no_number_of_a_mode_lies_on_another(draws):
    modes = np.array([1, 2.8, 9.4, 9.7, 10.2, 11.9, 12.0, 12.05, 12.1, 12.3])[None] * np.ones((5, 1))
    figure = draws(campbell(SPEED, modes, modes, range(1, 13)))
    boxes = {}
    for axes in figure.axes:
        numbers = [text for text in axes.texts if text.get_text().isdigit()]
        boxes[axes] = [number.get_window_extent() for number in numbers]
        assert [int(number.get_text()) for number in numbers] == list(range(1, len(numbers) + 1))
    whole, first = boxes.values()
    assert (len(whole), len(first)) == (10, 1)
    assert not any(one.overlaps(other) for one, other in itertools.combinations(whole, 2))
