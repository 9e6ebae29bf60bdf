"""What the normalised numbers of a figure are on its blade: E and K in Pa, speeds, large displacements."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis

from bladerub.plots.style import DARK, GREY
from bladerub.study.maps import CoatingMap
from bladerub.study.summary import LARGE_DISPLACEMENT

LARGE = f"displacement above {LARGE_DISPLACEMENT:.0%} of the blade's length"
"""What is said of the speeds that `Scales.is_large` finds."""
ORDERS = range(1, 13)  # engine orders that are drawn and labelled

_OUTWARD = 36  # points from the axis whose numbers and name stand between
_LINE = {"color": DARK, "linestyle": (0, (1, 1.5)), "linewidth": 1.1}
_ORDER = {"color": "#8f8f8f", "linewidth": 0.6, "zorder": 1.5}
_ABOVE = {"xytext": (0, 2), "ha": "center", "va": "bottom"}
_BESIDE = {"xytext": (2, 0), "ha": "left", "va": "center"}
_NEAREST = (0.13, 0.035)  # shares of the axes; a name of an order closer to the one before is left out


def greatest(*values: np.ndarray | float) -> float:
    """Return the greatest of `values`, where an axis or a scale can end: 1 where none is above 0."""
    numbers = np.concatenate([np.ravel(value) for value in values] or [[]]).astype(float)
    return float(np.max(numbers, where=numbers > 0, initial=0.0)) or 1.0


def draw_engine_orders(axes: Axes, slopes: Mapping[int, float], x_max: float, y_max: float) -> None:
    """Draw f = k f_Ω, named where it leaves the picture, with its slope by k: k over f_Ω, 1 / k over f."""
    label, anchor = "engine orders eo(k)", (x_max, 0.0)
    for k, slope in slopes.items():
        x = min(x_max, y_max / slope)
        axes.plot([0, x], [0, slope * x], label=label, **_ORDER)
        label = "_eo"
        if abs(x - anchor[0]) < _NEAREST[0] * x_max and abs(slope * x - anchor[1]) < _NEAREST[1] * y_max:
            continue
        anchor = (x, slope * x)
        place = _ABOVE if slope * x_max > y_max else _BESIDE
        look = {"fontsize": 7, "color": "#555555", "annotation_clip": False}
        axes.annotate(f"eo({k})", anchor, textcoords="offset points", **place, **look)


@dataclass(frozen=True)
class Scales:
    """What turns the numbers of a figure into those of its blade; what is None is not known or not said."""

    modulus_unit: float | None = None  # of E and K, Pa
    length: float | None = None  # of the blade, m
    f1_hz: float | None = None  # first frequency of the blade at rest
    nominal_speed: float | None = None  # of its rotor, 1/min

    def is_large(self, coating: CoatingMap) -> np.ndarray:
        """Find the speeds (n,) at which node 1 moves further than small displacements are."""
        if self.length is None:
            return np.zeros(coating.f_omega.size, dtype=bool)
        return np.nan_to_num(coating.revolution_peak).max(axis=1) >= LARGE_DISPLACEMENT * self.length

    def add_speeds(self, axes: Axes, along: str) -> None:
        """Add a second scale, rpm and Hz, to the speeds that run `along` "x" or "y", if f1 is known."""
        if self.f1_hz:
            axis = self._second(axes, along, 60 * self.f1_hz)
            axis.set_major_formatter(lambda rpm, _: f"{rpm:.0f}\n{rpm / 60:.0f} Hz")
            axis.set_label_text("rotor speed (rpm, Hz)")

    def add_frequencies(self, axes: Axes, along: str) -> None:
        """Add a second scale, Hz, to the frequencies that run `along` "x" or "y", if f1 is known."""
        if self.f1_hz:
            self._second(axes, along, self.f1_hz).set_label_text("frequency (Hz)")

    def draw_nominal_speed(self, draw: Callable) -> None:
        """Draw the nominal speed, if it is known, by `draw`: ``axvline`` or ``axhline`` of the axes."""
        if self.f1_hz and self.nominal_speed is not None:
            label = f"nominal speed, {self.nominal_speed:g} rpm"
            draw(self.nominal_speed / 60 / self.f1_hz, label=label, zorder=3, **_LINE)

    def _second(self, axes: Axes, along: str, factor: float) -> Axis:
        """Add an axis, `factor` times the first one, outside of the numbers and the name of that."""
        side = "bottom" if along == "x" else "left"
        add = axes.secondary_xaxis if along == "x" else axes.secondary_yaxis
        second = add(side, functions=(lambda value: value * factor, lambda value: value / factor))
        second.spines[side].set_position(("outward", _OUTWARD if along == "x" else 1.3 * _OUTWARD))
        second.spines[side].set_color(GREY)
        second.tick_params(labelsize=7, color=GREY)
        return second.xaxis if along == "x" else second.yaxis


UNKNOWN = Scales()
