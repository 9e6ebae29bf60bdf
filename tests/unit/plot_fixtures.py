from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.figure import Figure

from bladerub.plots import style
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import CoatingMap


@pytest.fixture
def draws(tmp_path) -> Callable[[Figure], Figure]:
    """Save a figure as the rules do, see that both files are what they claim to be, and give it back."""

    def save(figure: Figure) -> Figure:
        png, pdf = tmp_path / "figure.png", tmp_path / "figure.pdf"
        style.save(figure, png, pdf, dpi=50)
        assert png.read_bytes().startswith(b"\x89PNG")
        assert pdf.read_bytes().startswith(b"%PDF")
        return figure

    return save


@pytest.fixture
def coating_map() -> CoatingMap:
    """Six speeds, a hole in the spectrum at the third, the last run ended early; eo(4) peaks at 0.3."""
    f_omega = np.array([0.1, 0.15, 0.2, 0.25, 0.3, 0.35])
    order = np.arange(0, 8.1, 0.5)
    angle = (np.arange(40) + 0.5) * 2 * np.pi / 40
    height = np.exp(-(((f_omega - 0.3) / 0.05) ** 2))
    amplitude = 1e-6 + 1e-4 * np.outer(height, np.abs(order - 4) < 0.1)
    amplitude[2] = np.nan
    wear = np.outer(f_omega * 1e-3, 1 + np.cos(5 * angle))
    return CoatingMap(
        case=CoatingCase("2nd", 0.11, 0.5, 0.15),
        f_omega=f_omega,
        C1=np.sqrt(1 + 4 * f_omega**2),
        angle=angle,
        wear=wear,
        wear_node=np.repeat(wear[:, None], 8, axis=1),
        spectrum_order=order,
        spectrum_amplitude=amplitude,
        revolution_peak=np.ones((6, 20)),
        revolution_amplitude=np.ones((6, 20)),
        confirmation_amplitude=np.full((6, 60), np.nan),
        max_wear=wear.max(axis=1),
        lobes=np.array([5, 5, 10, 5, 5, 4]),
        status=np.array(["completed"] * 5 + ["unbounded"]),
    )
