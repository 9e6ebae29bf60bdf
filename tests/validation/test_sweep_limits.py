"""A passage through the speeds in its limits: slow without contact, and slow through a resonance.

Sources: a vibration whose frequency changes slowly keeps its action, energy over frequency (Arnold 1989,
Mathematical Methods of Classical Mechanics, section 52). A resonance that is passed slowly comes to the
height that it has at constant speed, and one that is passed faster to less (Lewis 1932, Trans. ASME 54, 253).
"""

from functools import partial

import numpy as np
import pytest

from bladerub.contact.modes import modes_at
from bladerub.contact.run import simulate
from bladerub.extras.passages.speed_sweep import simulate_sweep
from bladerub.extras.passages.sweep_grid import SweepSpec

pytestmark = pytest.mark.slow

ELASTIC = 1e6  # limit that no stress reaches, normalised
DAMPED = 0.01  # modal damping at which the resonance is soon at its height


@pytest.fixture
def spec_at(spec_of):
    return partial(spec_of, 5e-4, 0.5, yield_stress=ELASTIC, n_elements=500)


@pytest.mark.parametrize(("start", "end"), [(0.1, 0.4), (0.4, 0.1)])
def test_free_vibration_keeps_its_action(coarse_blade, spec_at, start, end):
    values = {"damping_ratio": 0.0, "initial_displacement": 1e-3, "interference": -0.05, "tolerance": 4e-3}
    run = spec_at(start, revolutions=0, **values)
    passage = simulate_sweep(coarse_blade, SweepSpec(run, end, 0.3, 1e-3))
    energy = passage.energy
    action = (energy.kinetic + energy.elastic) / modes_at(coarse_blade, end).omega[0]
    before = energy.initial / modes_at(coarse_blade, start).omega[0]
    stretched = modes_at(coarse_blade, end).omega[0] / modes_at(coarse_blade, start).omega[0]
    print(f"{start} to {end}: action {action / before:.4f}, frequency {stretched:.4f}")
    assert abs(stretched - 1) > 0.2
    assert action == pytest.approx(before, rel=0.02)
    assert passage.work_stiffness == pytest.approx(energy.kinetic + energy.elastic - energy.initial, rel=1e-3)


def test_a_slow_passage_comes_to_the_amplitude_at_constant_speed(coarse_blade, spec_at):
    """Engine order 4 on a soft coating that stays elastic: a resonance, almost a linear one."""
    speeds = np.linspace(0.288, 0.300, 13)
    runs = [simulate(coarse_blade, spec_at(f, revolutions=40, damping_ratio=DAMPED)) for f in speeds]
    constant = [run.revolution_amplitude[-1] for run in runs]
    assert 0 < np.argmax(constant) < speeds.size - 1
    ratios = []
    for rate in (0.16, 0.04, 0.01):
        start = spec_at(0.285, revolutions=20, damping_ratio=DAMPED)
        passage = simulate_sweep(coarse_blade, SweepSpec(start, 0.303, rate, 2e-4))
        ratios.append(passage.revolution_amplitude[20:].max() / max(constant))
        print(f"rate {rate}: {ratios[-1]:.3f} of constant speed, residual {passage.residual:.1e}")
        assert passage.residual < 1e-3
    assert ratios == sorted(ratios)
    assert ratios[0] < 0.9
    assert ratios[-1] == pytest.approx(1, abs=0.05)
