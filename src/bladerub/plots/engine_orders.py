"""Engine-order lines f = k f_Ω, named where they leave the picture."""

from collections.abc import Iterable

from matplotlib.axes import Axes

_LINE = {"color": "#8f8f8f", "linewidth": 0.6, "zorder": 1.5}
_NEAREST = (0.1, 0.035)  # shares of the axes; a name closer than that to the one before is left out


def over_speed(axes: Axes, orders: Iterable[int], speed_max: float, f_max: float) -> None:
    """Draw eo(k) for k in `orders` with f_Ω horizontally and f vertically, up to ``(speed_max, f_max)``."""
    _draw(axes, {k: k for k in orders}, speed_max, f_max)


def over_frequency(axes: Axes, orders: Iterable[int], f_max: float, speed_max: float) -> None:
    """Draw eo(k) for k in `orders` with f horizontally and f_Ω vertically, up to ``(f_max, speed_max)``."""
    _draw(axes, {k: 1 / k for k in orders}, f_max, speed_max)


def _draw(axes: Axes, slopes: dict[int, float], x_max: float, y_max: float) -> None:
    label, named = "engine orders eo(k)", (x_max, 0.0)
    for k, slope in slopes.items():
        x = min(x_max, y_max / slope)
        axes.plot([0, x], [0, slope * x], label=label, **_LINE)
        label = "_eo"
        if abs(x - named[0]) < _NEAREST[0] * x_max and abs(slope * x - named[1]) < _NEAREST[1] * y_max:
            continue
        named = (x, slope * x)
        if slope * x_max > y_max:
            place = {"xytext": (0, 2), "ha": "center", "va": "bottom"}
        else:
            place = {"xytext": (2, 0), "ha": "left", "va": "center"}
        look = {"fontsize": 7, "color": "#555555", "annotation_clip": False}
        axes.annotate(f"eo({k})", named, textcoords="offset points", **place, **look)
