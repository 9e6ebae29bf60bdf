"""Engine-order lines f = k f_Ω, named where they leave the picture."""

from collections.abc import Mapping

from matplotlib.axes import Axes

_LINE = {"color": "#8f8f8f", "linewidth": 0.6, "zorder": 1.5}
_NEAREST = (0.13, 0.035)  # shares of the axes; a name closer than that to the one before is left out


def draw(axes: Axes, slopes: Mapping[int, float], x_max: float, y_max: float) -> None:
    """Draw eo(k) with its slope, by k, up to ``(x_max, y_max)``: k over f_Ω, and 1 / k over f."""
    label, anchor = "engine orders eo(k)", (x_max, 0.0)
    for k, slope in slopes.items():
        x = min(x_max, y_max / slope)
        axes.plot([0, x], [0, slope * x], label=label, **_LINE)
        label = "_eo"
        if abs(x - anchor[0]) < _NEAREST[0] * x_max and abs(slope * x - anchor[1]) < _NEAREST[1] * y_max:
            continue
        anchor = (x, slope * x)
        if slope * x_max > y_max:
            place = {"xytext": (0, 2), "ha": "center", "va": "bottom"}
        else:
            place = {"xytext": (2, 0), "ha": "left", "va": "center"}
        look = {"fontsize": 7, "color": "#555555", "annotation_clip": False}
        axes.annotate(f"eo({k})", anchor, textcoords="offset points", **place, **look)
