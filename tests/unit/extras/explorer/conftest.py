import numpy as np
import pytest

from bladerub.study import divergence
from bladerub.study.grid import CoatingCase
from bladerub.study.manifest import ManifestRow
from bladerub.study.maps import CoatingMap

SETTINGS = {"growth": 0.01, "revolutions": 10, "confidence": 0.95, "confirmation_revolutions": 30}


@pytest.fixture
def coating() -> CoatingMap:
    """Three speeds: steady; growing and repeated for longer; out of bounds in the sixth revolution."""
    rng = np.random.default_rng(3)
    f_omega, order = np.array([0.1, 0.2, 0.3]), np.arange(301) / 10
    wear = 1e-3 * rng.random((3, 60)).astype(np.float32)
    spectrum = 10 ** rng.uniform(-9, -2, (3, order.size))
    spectrum[2] = np.nan
    growth = np.array([[0.0], [0.03], [0.2]])
    amplitude = 1e-3 * (1 + growth) ** np.arange(20)
    amplitude[2, 6:] = np.nan
    longer = np.full((3, 30), np.nan)
    longer[1] = 1e-3 * 1.03 ** np.arange(30)
    return CoatingMap(
        case=CoatingCase("2nd", 2.0, 0.5, 0.15),
        f_omega=f_omega,
        C1=np.sqrt(1 + f_omega**2),
        angle=(np.arange(60) + 0.5) * 2 * np.pi / 60,
        wear=wear,
        wear_node=np.repeat(wear[:, None], 8, axis=1),
        spectrum_order=order,
        spectrum_amplitude=spectrum,
        revolution_peak=2 * amplitude,
        revolution_amplitude=amplitude,
        confirmation_amplitude=longer,
        max_wear=wear.max(axis=1),
        lobes=np.array([2, 4, 4]),
        status=np.array(["completed", "completed", "unbounded"]),
    )


@pytest.fixture
def verdicts(coating):
    """``divergence.csv`` of the coating."""
    return divergence.table({"analysis": {"divergence": SETTINGS}}, [coating])


@pytest.fixture
def runs(coating):
    return [
        ManifestRow(f"{f:.4f}.h5", f, f"key-{f}", status, 1)
        for f, status in zip(coating.f_omega, coating.status, strict=True)
    ]
