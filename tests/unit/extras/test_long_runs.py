import numpy as np
import pytest

from bladerub.extras.passages import long_runs
from bladerub.study.grid import CoatingCase

CASE = CoatingCase("2nd", 1.1, 0.5, 0.0)


@pytest.fixture
def study(config):
    return config | {"long_runs": {"revolutions": 200}}


def test_runs_that_grow_to_the_end_and_peaks_are_chosen(study, make_map):
    """Peaks at 0.2 and 0.3; grows at 0.05 and 0.2, and saturates in the longer run at 0.1."""
    f_omega = np.round(np.arange(0.02, 0.4001, 0.01), 6)
    growth = np.where(np.isin(f_omega, [0.05, 0.1, 0.2]), 0.04, 0.0)
    longer = np.full((f_omega.size, 60), np.nan)
    longer[np.isclose(f_omega, 0.05)] = 1e-6 * 1.04 ** np.arange(60)
    longer[np.isclose(f_omega, 0.1)] = 1e-6
    coating = make_map(CASE, {4: (0.3, 2e-4), 6: (0.2, 5e-4)}, growth=growth, longer=longer)
    assert long_runs.chosen(study, coating) == {0.05: "grows", 0.2: "f6", 0.3: "f4"}


def amplitudes():
    number = np.arange(200.0)
    ended, free = 1e-4 * 1.05**number, 1e-4 * 1.05**number
    free[70:] = free[69] * 0.9 ** np.arange(1, 131)
    ended[70:] = np.nan
    return {
        "steady": np.full(200, 1e-4),
        "saturating": 1e-4 * (2 - np.exp(-number / 30)),
        "divergent": 1e-4 * 1.02**number,
        "unbounded": ended,
        "free": free,
    }


@pytest.mark.parametrize(
    ("name", "verdicts"),
    [
        ("steady", ["steady"] * 4),
        ("saturating", ["divergent", "saturating", "saturating", "saturating"]),
        ("divergent", ["divergent"] * 4),
        ("unbounded", ["divergent", "divergent", "unbounded", "unbounded"]),
        ("free", ["divergent", "divergent", "saturating", "free"]),
    ],
)
def test_what_is_said_after_more_and_more_revolutions(study, name, verdicts):
    amplitude = amplitudes()[name]
    said = [long_runs.verdict_after(study, amplitude, stop)[0] for stop in (20, 60, 100, 200)]
    assert said == verdicts
