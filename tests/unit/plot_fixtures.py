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
def coating_map(make_map) -> CoatingMap:
    """Six speeds, a hole in the spectrum at the third, the last run ended early; eo(4) peaks at 0.3."""
    status = ["completed"] * 5 + ["unbounded"]
    f_omega = [0.1, 0.15, 0.2, 0.25, 0.3, 0.35]
    case = CoatingCase("2nd", 0.11, 0.5, 0.15)
    coating = make_map(case, {4: (0.3, 1e-4)}, f_omega, [5, 5, 10, 5, 5, 4], status=status)
    coating.spectrum_amplitude[2] = np.nan
    return coating
