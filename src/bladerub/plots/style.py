"""One style for every figure: sizes for print, colours that the colour-blind and grey print keep apart."""

import math
from base64 import b64encode
from collections.abc import Callable
from functools import wraps
from io import BytesIO
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from bladerub.io import atomic
from bladerub.io.provenance import software

PAGE = 180 / 25.4  # width of a full-page figure, inches (180 mm)
COLUMN = 120 / 25.4  # width of a figure that stands alone in a column, inches (120 mm)

DARK = "#14213d"
ORANGE = "#e08e0b"
BLUE = "#2f7fc1"
RED = "#c8352b"
VIOLET = "#7a4fa3"
GREY = "#8a8a8a"
MISSING = "#e4e4e4"
"""Background of maps: what was not computed shows through."""

FIRST = {"color": DARK, "linestyle": "-"}
SECOND = {"color": ORANGE, "linestyle": "--"}
"""The two lines of a comparison; dark solid and light dashed, so that grey print keeps them apart."""

AMPLITUDE_MAP = LinearSegmentedColormap.from_list(
    "amplitude", ["#ffffff", "#f9bf73", "#ee8a48", "#cf4d38", "#8c1d52", "#2b0a3a"]
)
"""White to dark over warm colours of falling lightness: amplitudes, under cool lines."""
WEAR_MAP = LinearSegmentedColormap.from_list(
    "wear", ["#ffffff", "#cfe6ea", "#74b9d0", "#2f7fb5", "#1c4a86", "#0d1b3d"]
)
"""White to dark over blue: worn depth."""
HEIGHT_MAP = "viridis"

_RC = {
    "figure.constrained_layout.h_pad": 0.06,
    "figure.constrained_layout.w_pad": 0.06,
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "axes.labelsize": 9,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.facecolor": "white",
    "axes.axisbelow": True,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "lines.linewidth": 1.3,
    "legend.fontsize": 8,
    "legend.frameon": True,
    "legend.framealpha": 0.9,
    "legend.edgecolor": "none",
    "grid.color": "#d9d9d9",
    "grid.linewidth": 0.5,
    "image.composite_image": False,
    "pdf.fonttype": 42,
}
_PDF_RASTER_DPI = 300
_PAGE_DPI, _FILE_DPI = 110, 200


class Picture(Figure):
    """A figure that shows itself in a notebook, whatever backend is used, and can be drawn without data."""

    def draw(self, renderer: Any) -> None:
        """Draw, with linear scales in place of logarithmic ones that no data are on, which have no limits."""
        for axes in self.axes:
            for name, shared in (("x", axes.get_shared_x_axes()), ("y", axes.get_shared_y_axes())):
                together = shared.get_siblings(axes)
                smallest = min(getattr(one.dataLim, f"minpos{name}") for one in together)
                if getattr(axes, f"get_{name}scale")() == "log" and not math.isfinite(smallest):
                    getattr(axes, f"set_{name}scale")("linear")
        super().draw(renderer)

    def _repr_html_(self) -> str:
        return f'<img src="{data_address(self)}">'


def data_address(figure: Figure) -> str:
    """Return an address that holds `figure` as a PNG; equal figures have equal addresses."""
    stream = BytesIO()
    figure.savefig(stream, format="png", dpi=_PAGE_DPI, metadata={"Software": None})
    return f"data:image/png;base64,{b64encode(stream.getvalue()).decode()}"


styled = matplotlib.rc_context(_RC)
"""Decorate a function that draws in the style, and leaves matplotlib's settings as they were."""


def on_axes(draw: Callable[..., Figure]) -> Callable[..., Any]:
    """Let a function return the axes ``ax`` if given, else its figure, written to ``path`` if given."""

    @styled
    @wraps(draw)
    def drawn(*args, path: str | Path | None = None, ax: Axes | None = None, **kwargs) -> Any:
        figure = draw(*args, ax=ax, **kwargs)
        if path is not None:
            figure.savefig(path, dpi=_FILE_DPI)
        return ax or figure

    return drawn


def new_figure(width: float = PAGE, height: float = 0.6 * PAGE) -> Figure:
    """Empty figure of `width` × `height` inches; its axes are placed so that nothing overlaps."""
    return Picture(figsize=(width, height), layout="constrained")


@styled
def save(figure: Figure, png: str | Path, pdf: str | Path, dpi: float) -> None:
    """Write `figure` as PNG of `dpi` and PDF, equal for equal data, which say in metadata what made them."""
    origin = f"{software()}, matplotlib {matplotlib.__version__}"
    with atomic.writing(png, "wb") as stream:
        figure.savefig(stream, format="png", dpi=dpi, metadata={"Software": origin})
    figure.set_layout_engine("none")  # what is placed stays: to place it again takes as long as drawing
    with atomic.writing(pdf, "wb") as stream:
        about = {"Creator": origin, "CreationDate": None}
        figure.savefig(stream, format="pdf", dpi=_PDF_RASTER_DPI, metadata=about)
