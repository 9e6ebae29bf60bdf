"""Limits of the rub that must come out whatever the scheme: lobes, rigid casing, θ → 0, finer bars.

Sources: Batailly, Legrand and Pierre (the paper): a steady interaction of frequency f at speed f_Ω wears
round(f / f_Ω) lobes into the casing, and a coating of large E and K is direct contact. The other two limits
are consistency: the law of contact is continuous in θ, so results differ in proportion to θ; and the bars
are a midpoint rule for a continuous layer, of second order in their width where the tip presses smoothly.

All on the default blade, coarsely meshed, at its default step.
"""

import numpy as np
import pytest

from bladerub.study.spectra import order_spectrum
from bladerub.study.wear import lobes


def apart(found, exact):
    return np.linalg.norm(found - exact) / np.linalg.norm(exact)


@pytest.mark.parametrize(
    ("E", "K", "f_omega"), [(2.0, 0.5, 0.206), (2.0, 0.5, 0.30), (1.1, 0.5, 0.31), (5.0, 1.0, 0.33)]
)
def test_lobes_are_the_vibrations_a_turn(run, E, K, f_omega):
    result = run(E, K, f_omega)
    order, amplitude = order_spectrum(result.radial_displacement, 20, 10, 30.0)
    vibrations = order[np.argmax(np.where(order >= 0.5, amplitude, 0.0))]
    found = lobes(result.angle, result.wear, 0.1)
    print(f"f_omega = {f_omega}: f / f_omega = {vibrations:g}, {found} lobes")
    assert found == round(vibrations)


def test_stiff_coating_becomes_the_rigid_casing(run):
    """E = K over a decade and a half: wear and distance to the rigid run shrink from value to value."""
    rigid = run(np.inf, np.inf, 0.25, revolutions=4)
    wear, peaks, displacement = [], [], []
    for modulus in (100.0, 316.0, 1e3, 3.16e3):
        result = run(modulus, modulus, 0.25, revolutions=4)
        wear.append(result.wear.mean())
        peaks.append(np.abs(result.revolution_peak / rigid.revolution_peak - 1).max())
        displacement.append(apart(result.radial_displacement, rigid.radial_displacement))
    print("mean wear, peaks and displacement off by:", *np.round([wear, peaks, displacement], 9))
    for sequence in (wear, peaks, displacement):
        assert np.all(np.diff(sequence) < 0)
    assert wear[-1] < wear[0] / 5
    assert peaks[-1] < 0.03
    assert displacement[-1] < 0.03


def test_no_rotation_of_the_elements_is_the_limit_of_little(run):
    upright = run(1.1, 0.5, 0.31, revolutions=10)
    thetas = np.array([0.01, 0.005, 0.0025])
    runs = [run(1.1, 0.5, 0.31, theta=theta, revolutions=10) for theta in thetas]
    wear = [apart(run.wear, upright.wear) for run in runs]
    peaks = [np.abs(run.revolution_peak / upright.revolution_peak - 1).max() for run in runs]
    orders = [np.polyfit(np.log(thetas), np.log(errors), 1)[0] for errors in (wear, peaks)]
    print("order in theta of wear and peaks:", np.round(orders, 2), "wear off by:", wear)
    np.testing.assert_allclose(orders, 1, atol=0.15)


def test_finer_bars_change_less_and_less(run):
    """1,000, 2,000 and 4,000 bars under a tip of one width. Expected: second order."""
    counts = np.array([1000, 2000, 4000])
    finer = [{"n_elements": n, "half_width": n / 1000, "steps_per_element": 12_000 // n} for n in counts]
    # off the peaks, which magnify any change
    runs = [run(2.0, 0.5, 0.40, max_time_step=1.0, **values) for values in finer]
    wear = [run.wear.reshape(8, 1000, -1).mean(axis=2) for run in runs]
    change = [apart(wear[0], wear[1]), apart(wear[1], wear[2])]
    peak = [run.revolution_peak[-1] for run in runs]
    order = np.log2(change[0] / change[1])
    print(f"wear changes by {change}, order {order:.2f}; last peak {peak}")
    assert order > 1.7
    assert abs(peak[2] - peak[1]) < abs(peak[1] - peak[0])
    assert change[1] < 0.005
