import numpy as np
import pytest

from bladerub.extras.variations.emulator import Emulator, compared, held_out


def smooth(x):
    return np.sin(4 * x[:, 0]) + x[:, 1] * x[:, 2]


@pytest.fixture
def positions():
    return np.random.default_rng(1).random((60, 4))


def test_a_smooth_function_is_predicted_between_the_sets(positions):
    emulator = Emulator(positions, smooth(positions))
    others = np.random.default_rng(2).random((200, 4))
    found = compared(smooth(others), emulator.predict(others))
    assert found.explained > 0.98
    assert found.within_two > 0.8


def test_scatter_is_part_of_the_predicted_deviation(positions):
    rng = np.random.default_rng(3)
    emulator = Emulator(positions, smooth(positions) + 0.3 * rng.standard_normal(60))
    others = rng.random((400, 4))
    scattered = smooth(others) + 0.3 * rng.standard_normal(400)
    predicted = emulator.predict(others)
    assert 0.3 < np.median(predicted.deviation) < 0.6
    assert 0.85 < compared(scattered, predicted).within_two <= 1


def test_sets_left_out_are_predicted_about_as_well_as_new_ones(positions):
    values = smooth(positions)
    emulator = Emulator(positions, values)
    assert held_out(emulator, positions, values).explained > 0.95
    noise = np.random.default_rng(4).standard_normal(60)
    assert held_out(Emulator(positions, noise), positions, noise).explained < 0.4
