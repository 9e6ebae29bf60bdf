"""Polar views of the casing: the casing angle runs with the rotation, from the stacking line at the top."""

import itertools
from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import MaxNLocator

from bladerub.plots import style, titles
from bladerub.plots.scales import greatest
from bladerub.study.maps import CoatingMap

_SHAPES = (
    {"color": style.ORANGE, "linestyle": (0, (6, 2)), "linewidth": 1.4},
    {"color": style.BLUE, "linestyle": (0, (1.5, 1.2)), "linewidth": 1.4},
    {"color": style.RED, "linestyle": "-.", "linewidth": 1.4},
)
_COMBINED = {"color": style.DARK, "linestyle": "-", "linewidth": 2.0}


@style.styled
def casing_polar(
    angle: np.ndarray, inward: Mapping[str, np.ndarray], radius: float, magnification: float
) -> Figure:
    """Draw Fig. 5: the round casing of a `radius` (m) and distorted ones, the last of which stands out.

    `inward` is the displacement of the inner surface (n,), m, by name of the shape, at the casing `angle`
    (n,), rad; it is drawn with a `magnification`.
    """
    figure = style.new_figure(style.COLUMN, 1.25 * style.COLUMN)
    largest = max(np.abs(u).max() for u in inward.values())
    axes = prepare_polar(figure.add_subplot(projection="polar"))
    look = {"color": style.GREY, "linewidth": 1.0, "label": "round casing"}
    axes.plot(*closed(angle, np.full(np.size(angle), radius)), **look)
    looks = [*itertools.islice(itertools.cycle(_SHAPES), len(inward) - 1), _COMBINED]
    for (name, displacement), line in zip(inward.items(), looks, strict=True):
        axes.plot(*closed(angle, radius - magnification * np.asarray(displacement)), label=name, **line)
    axes.set_rgrids(radius + magnification * largest * np.array([-1, 0, 1]), [])
    axes.set_rlim(0, radius + 1.1 * magnification * largest)
    figure.legend(
        loc="outside lower center",
        ncols=2,
        title=f"change of the inner radius ({1e3 * radius:.0f} mm), magnified {magnification:g} times\n"
        f"(rings {1e3 * largest:.2g} mm apart)",
    )
    return figure


@style.styled
def wear_profiles(
    maps: Sequence[CoatingMap], speeds: Sequence[float], f1_hz: float | None = None
) -> tuple[pd.DataFrame, Figure]:
    """Draw Fig. 19 from the maps of two coatings that differ in theta: a panel for each speed, on one scale.

    The table is what is drawn: ``f_omega``, ``theta``, ``angle``, rad, and ``wear``, m. Speeds are in rpm as
    well if the first frequency of the blade, `f1_hz`, is known.
    """
    profiles = []
    for f_omega, coating in itertools.product(speeds, maps):
        wear = coating.wear[np.flatnonzero(np.isclose(coating.f_omega, f_omega))[0]]
        columns = {"f_omega": f_omega, "theta": coating.case.theta, "angle": coating.angle, "wear": wear}
        profiles.append(pd.DataFrame(columns))
    table = pd.concat(profiles)
    figure = style.new_figure(style.PAGE, (0.2 + 0.8 / len(speeds)) * style.PAGE)
    deepest = 1e3 * greatest(table.wear)
    for index, (f_omega, of_speed) in enumerate(table.groupby("f_omega", sort=False)):
        axes = prepare_polar(figure.add_subplot(1, len(speeds), index + 1, projection="polar"))
        by_theta, looks = of_speed.groupby("theta", sort=False), (style.FIRST, style.SECOND)
        for (theta, rows), look in zip(by_theta, looks, strict=True):
            axes.plot(*closed(rows.angle, 1e3 * rows.wear), label=titles.angle(theta), **look)
        axes.set(rorigin=-0.6 * deepest, rlim=(0, 1.06 * deepest))
        axes.set_title(titles.panel(index % 26, titles.speed(f_omega, f1_hz)))
        axes.yaxis.set_major_locator(MaxNLocator(nbins=max(2, 6 // len(speeds))))
    figure.legend(
        *axes.get_legend_handles_labels(),
        loc="outside lower center",
        ncols=2,
        title="worn depth (mm) outward from the inner circle, the unworn surface",
        title_fontsize=8,
    )
    return table, figure


def prepare_polar(axes: PolarAxes) -> PolarAxes:
    """Turn polar axes so that 0 is above; labels of the radius stay readable over lines."""
    axes.set_theta_zero_location("N")
    axes.set_thetagrids(range(0, 360, 45))
    axes.set_rlabel_position(90)
    axes.tick_params(labelsize=7)
    for label in axes.get_yticklabels():
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.5, "alpha": 0.8})
    return axes


def closed(angle: np.ndarray, radius: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angles and radii (n + 1,) with the first point repeated at the end, so that the line closes."""
    angle, radius = np.asarray(angle), np.asarray(radius)
    return np.append(angle, angle[0] + 2 * np.pi), np.append(radius, radius[0])
