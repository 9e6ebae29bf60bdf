"""What the loops of the GPU, emulated, and of the processor round off in one revolution.

They are compared with the emulation with a mantissa of 64 bits, eleven more than a double has.
"""

import dataclasses
from functools import partial

import numpy as np
import pytest

from bladerub.contact.run import simulate
from bladerub.extras.gpu import emulation
from bladerub.extras.gpu.batch import simulate_many
from bladerub.study.grid import coating_cases, run_spec, speeds

pytestmark = [
    pytest.mark.nightly,  # long doubles are emulated
    pytest.mark.skipif(not emulation.is_possible(), reason="no C++ compiler"),
    pytest.mark.skipif(np.finfo(np.longdouble).nmant != 63, reason="no numbers with a mantissa of 64 bits"),
]
N_RUNS = 20


@pytest.fixture(scope="module")
def specs(coarse_config):
    rng = np.random.default_rng(1)
    coatings = [case for case in coating_cases(coarse_config) if not case.is_rigid]
    fast = [speed for speed in speeds(coarse_config) if speed > 0.15]  # of few steps a revolution
    numbers, drawn = (rng.choice(of, N_RUNS, replace=False) for of in (len(coatings), fast))
    # steps longer than the study's: extended precision takes fifty times as long
    short = {"revolutions": 1, "steps_per_element": 6, "max_time_step": 4e-6}
    return [
        dataclasses.replace(run_spec(coarse_config, coatings[number], float(speed)), **short)
        for number, speed in zip(numbers, drawn, strict=True)
    ]


@pytest.fixture(scope="module")
def more_exact(coarse_blade, specs):
    return emulated(coarse_blade, specs, "long double")


def emulated(blade, specs, real):
    left_out = []
    device = partial(emulation.run, real=real)
    results = dict(simulate_many(blade, specs, device, lambda runs, line: left_out.append(line)))
    assert not left_out
    return [results[number] for number in range(len(specs))]


def differences(results, expected, name):
    """Largest difference of each run over the largest number in it; the steps are the same."""
    found = []
    for result, exact in zip(results, expected, strict=True):
        for same in ("status", "n_steps", "n_contact_steps", "n_reversed_steps"):
            assert getattr(result, same) == getattr(exact, same), same
        assert exact.n_contact_steps > 1000
        numbers = getattr(exact, name)
        found.append(np.abs(getattr(result, name) - numbers).max() / np.abs(numbers).max())
    return np.array(found)


def test_the_loop_of_the_gpu_rounds_off_1e_12(coarse_blade, specs, more_exact):
    results = emulated(coarse_blade, specs, "double")
    peaks = differences(results, more_exact, "revolution_peak")
    assert np.sum(peaks < 1e-12) >= 0.9 * N_RUNS
    assert peaks.max() < 1e-11  # it grows where contact lasts
    for name in ("radial_displacement", "wear"):
        found = differences(results, more_exact, name)
        assert np.median(found) < 1e-12, name
        assert found.max() < 1e-10, name


def test_the_loop_of_the_processor_rounds_off_1e_10(coarse_blade, specs, more_exact):
    # Its modes are positions, and their steps differences of these
    results = [simulate(coarse_blade, spec) for spec in specs]
    for name in ("revolution_peak", "radial_displacement", "wear"):
        assert differences(results, more_exact, name).max() < 1e-10, name
