"""The exact solutions of `bar_solutions` against a brute-force computation of the same waves.

Leapfrog on a bar of n lumped masses at its stability limit, where waves move without dispersion, with the end
stopped at the wall. Expected: errors of the order of 1/n, from the mass of the end.
"""

import numpy as np
import pytest
from bar_solutions import (
    DOYEN,
    GRAVITY,
    HEIGHT,
    SPEED,
    end_height,
    first_contact_force,
    next_impact,
    rebound_speed,
    second_contact_force,
)


def fall(gravity, duration, n=400):
    """Time, height of the end, speed of the centre of mass and force on the end from the first touch on."""
    spacing = DOYEN.length / n
    step = spacing / DOYEN.wave_speed
    mass = np.full(n + 1, DOYEN.density * spacing)
    mass[[0, -1]] /= 2
    now, before = np.zeros(n + 1), np.full(n + 1, SPEED * step + gravity * step**2 / 2)
    time = step * np.arange(1, round(duration / step) + 1)
    seen = np.empty((3, time.size))
    for i in range(time.size):
        tension = DOYEN.modulus * np.diff(now) / spacing
        pull = np.append(tension, 0.0) - np.append(0.0, tension)
        after = 2 * now - before + step**2 * (pull / mass - gravity)
        push = max(0.0, -after[0] * mass[0] / step**2)
        after[0] = max(after[0], 0.0)
        seen[:, i] = after[0], mass @ (after - now) / step / mass.sum(), push
        now, before = after, now
    return time, *seen


def test_constants_of_the_benchmark():
    assert DOYEN.wave_speed == 30
    assert DOYEN.crossing == pytest.approx(2 / 3)
    assert np.sqrt(2 * HEIGHT * GRAVITY) == SPEED
    assert first_contact_force(DOYEN, SPEED, 0.0, 0.1) == pytest.approx(300)
    assert first_contact_force(DOYEN, SPEED, GRAVITY, DOYEN.crossing * (1 - 1e-12)) == pytest.approx(500)
    assert next_impact(DOYEN, SPEED, GRAVITY) == pytest.approx(4 * DOYEN.crossing, rel=1e-12)


@pytest.mark.parametrize("gravity", [0.0, GRAVITY])
def test_rebound(gravity):
    time, height, speed, push = fall(gravity, 3.9 * DOYEN.crossing)
    away_from_jumps = (time > 0.02 * DOYEN.crossing) & (np.abs(time / DOYEN.crossing - 1) > 0.02)
    exact = first_contact_force(DOYEN, SPEED, gravity, time)
    np.testing.assert_allclose(push[away_from_jumps], exact[away_from_jumps], atol=2e-3 * exact.max())
    np.testing.assert_allclose(height, end_height(DOYEN, SPEED, gravity, time), atol=0.01 * HEIGHT)
    after = np.searchsorted(time, 1.02 * DOYEN.crossing)
    leaving = speed[after] + gravity * (time[after] - DOYEN.crossing)
    assert leaving == pytest.approx(rebound_speed(DOYEN, SPEED, gravity), rel=2e-3)
    assert rebound_speed(DOYEN, SPEED, gravity) == pytest.approx(SPEED, rel=1e-12)


def test_second_impact_of_the_bouncing_bar():
    time, _, speed, push = fall(GRAVITY, 5.5 * DOYEN.crossing)
    of_second = (time > 4.02 * DOYEN.crossing) & (time < 4.98 * DOYEN.crossing)
    exact = second_contact_force(DOYEN, SPEED, GRAVITY, time)
    np.testing.assert_allclose(push[of_second], exact[of_second], atol=5e-3 * exact.max())
    assert speed[-1] == pytest.approx(SPEED - GRAVITY * 0.5 * DOYEN.crossing, rel=5e-3)
