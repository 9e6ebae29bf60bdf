import numpy as np
import pytest

from bladerub.extras.rotor import pattern

ANGLE = np.arange(240) * (2 * np.pi / 240)


def worn(lobe, depth=1e-4):
    """Three lobes, one of them at `lobe`, on an even ground and a strong other harmonic."""
    return 2e-3 + depth * np.cos(3 * (ANGLE - lobe)) + 1e-3 * np.cos(2 * ANGLE)


@pytest.mark.parametrize("rate", [0.08, -0.08])
def test_the_drift_of_lobes_that_turn_evenly_is_their_rate(rate):
    revolution = np.arange(1, 41)  # turns by more than the distance of two lobes
    parts = np.array([pattern.component(ANGLE, worn(0.3 + rate * at), 3) for at in revolution])
    assert np.abs(parts) == pytest.approx(1e-4)
    lobe = pattern.lobe_angle(parts, 3)
    assert np.diff(lobe) == pytest.approx(rate)
    assert pattern.drift_rate(revolution, lobe, np.abs(parts)) == pytest.approx(rate)
