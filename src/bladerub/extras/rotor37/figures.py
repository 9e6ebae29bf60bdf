"""The figures of Rotor 37: response over the speed, direct contact over a revolution, and maps."""

from collections.abc import Mapping
from functools import partial

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from bladerub.blade.validation import read_reduced_blade
from bladerub.contact import casing
from bladerub.contact.spec import RunSpec
from bladerub.extras.rotor37.direct import spec_of
from bladerub.plots import style
from bladerub.plots.maps import spectrum_map, wear_map
from bladerub.plots.scales import Scales
from bladerub.settings.study import Config
from bladerub.study.grid import coating_cases, modulus_unit
from bladerub.study.maps import CoatingMap, read_map

_LAST = 5  # revolutions over which the amplitude is taken
_COLOURS = (style.BLUE, style.ORANGE, style.DARK, style.RED)


def figures(config: Config, folder: str, history: pd.DataFrame) -> dict[str, Figure]:
    """Draw all by name, of the maps and the blade in `folder`, and of the `history` of direct contact."""
    blade, look = read_reduced_blade(f"{folder}/blade/reduced_model.h5"), config.figures
    rigid, coated = {}, {}
    for case in coating_cases(config):
        coating = read_map(f"{folder}/maps/{case.name}.h5")
        if case.is_rigid:
            rigid[f"μ = {case.friction:g}"] = coating
        else:
            coated.setdefault(case.theta, {})[f"E = {case.E:g} GPa"] = coating
    panels = {"rigid casing": rigid}
    panels |= {f"coated casing, θ = {angle:g}": coatings for angle, coatings in coated.items()}
    scales = Scales(modulus_unit(config), config.blade.length, blade.f1_hz, look.nominal_speed)
    ends = {"amplitude_range": look.amplitude_range, "f_max": look.max_frequency}
    spectrum = partial(spectrum_map, scales=scales, **ends)
    straight, inclined = (coatings["E = 1 GPa"] for coatings in coated.values())
    node_angle = float(np.arctan2(*blade.node_position[0, 1:]))
    return {
        "response": response(panels, blade.f1_hz, look.nominal_speed),
        "direct": direct_contact(history, spec_of(config, blade, 0.0), node_angle),
        "spectrum_rigid": spectrum(rigid["μ = 0.15"]),
        "spectrum_coated": spectrum(straight),
        "wear_straight": wear_map(straight, scales),
        "wear_inclined": wear_map(inclined, scales),
    }


@style.styled
def response(panels: Mapping[str, Mapping[str, CoatingMap]], f1_hz: float, nominal: float) -> Figure:
    """Draw the last amplitude over the rotor speed, a panel each of named coatings; `nominal` is in 1/min."""
    figure = style.new_figure(style.PAGE, 0.36 * style.PAGE * len(panels))
    rows = figure.subplots(len(panels), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    for axes, (title, coatings) in zip(rows, panels.items(), strict=True):
        for colour, (label, coating) in zip(_COLOURS, coatings.items(), strict=False):
            speed = coating.f_omega * 60 * f1_hz
            amplitude = 1e3 * coating.revolution_amplitude[:, -_LAST:].max(axis=1)
            axes.plot(speed, amplitude, color=colour, linewidth=1.1, label=label)
            unbounded = speed[coating.status != "completed"]
            look = {"color": colour, "markersize": 4, "transform": axes.get_xaxis_transform()}
            axes.plot(unbounded, np.full(unbounded.size, 0.98), "x", **look)
        axes.axvline(nominal, color=style.GREY, linewidth=0.8, linestyle=":")
        axes.set(yscale="log", ylabel="amplitude (mm)")
        axes.set_title(title)
        axes.legend(ncols=len(coatings), loc="upper left", fontsize=7)
    axes.set_xlabel("rotor speed (1/min); dotted: design speed; crosses: unbounded")
    return figure


@style.styled
def direct_contact(history: pd.DataFrame, spec: RunSpec, node_angle: float) -> Figure:
    """Draw the last revolution of node 1 and the gap over it, m; `node_angle` from the stacking line, rad."""
    stiffness = history.case.str.partition("_mu")
    titles = {"rest": "without centrifugal stiffening", "stiffened": "with centrifugal stiffening"}
    figure = style.new_figure(style.PAGE, 0.62 * style.PAGE)
    angle = np.linspace(0, 2 * np.pi, 721)
    gap = casing.gap(spec.casing, spec.clearance[0], angle + spec.casing.start_angle + node_angle)
    panels, looks = figure.subplots(2, 1, sharex=True, sharey=True), (style.FIRST, style.SECOND)
    for axes, (name, title) in zip(panels, titles.items(), strict=True):
        blank = {"color": style.MISSING, "linewidth": 0, "label": "casing"}
        axes.fill_between(np.rad2deg(angle), 1e3 * gap, 0.45, **blank)
        runs = history[stiffness[0] == name]
        for look, (friction, rows) in zip(looks, runs.groupby(stiffness[2]), strict=True):
            moved = 1e3 * rows.radial_displacement
            axes.plot(np.rad2deg(rows.turned), moved, **look, linewidth=1.1, label=f"μ = {friction}")
        axes.set(xlim=(0, 360), xticks=range(0, 361, 45), ylim=(-0.62, 0.45), ylabel="radial (mm)")
        axes.set_title(title)
    axes.legend(fontsize=7, ncols=3, loc="lower center")
    axes.set_xlabel("angle turned in the last revolution (degrees)")
    return figure
