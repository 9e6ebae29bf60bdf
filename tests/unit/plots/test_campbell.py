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
