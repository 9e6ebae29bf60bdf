import numpy as np
import pytest
from study_fixtures import changed

from bladerub.extras.chart.point import MEASURES, ChartPoint
from bladerub.study.grid import CoatingCase

F_OMEGA = np.round(np.arange(0.152, 0.4001, 0.002), 6)


@pytest.fixture
def make_point():
    """A point that was run at all speeds; its response on each order is a hat, C1² = 1 + 3 f_omega²."""

    def make(E, K, Y4=1e-3, Y6=5e-4, f4=0.32, f6=0.19, theta=0.0, divergent=0.0, depth=1e-4):
        hats = [Y * np.clip(1 - np.abs(F_OMEGA - f) / 0.05, 0.01, None) for f, Y in ((f4, Y4), (f6, Y6))]
        uniform = np.arange(F_OMEGA.size) % 4 == 0
        numbers = dict.fromkeys(MEASURES, 1.0) | {"deepest_wear": depth, "lobes": 4.0}
        numbers |= {"revolutions": 20.0, "energy_wear": 240.0}
        measures = {name: np.full(F_OMEGA.size, number) for name, number in numbers.items()}
        measures |= {"peak": np.max(hats, axis=0), "divergent": np.where(uniform, divergent, np.nan)}
        case = CoatingCase("2nd", E, K, theta)
        C1 = np.sqrt(1 + 3 * F_OMEGA**2)
        return ChartPoint(case, F_OMEGA, C1, np.array([4.0, 6.0]), np.stack(hats, axis=1), uniform, measures)

    return make


@pytest.fixture
def few_speeds(config):
    """Even speeds 0.16, 0.24 and 0.32; the study has those between as well."""
    of_chart = {"start": 0.16, "step": 0.08, "dense_stop": 0.16, "dense_step": 0.08}
    speeds = {"start": 0.16, "stop": 0.34, "step": 0.02, "extra": []}
    return changed(config, speeds=speeds, chart={"speeds": of_chart})
