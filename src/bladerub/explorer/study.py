"""What the page knows of the study before a coating is opened."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from matplotlib import colormaps
from matplotlib.colors import Colormap, to_hex

from bladerub.explorer import figures, thinning
from bladerub.explorer.coating import AMPLITUDE_FLOOR
from bladerub.io.provenance import software
from bladerub.plots import bins, spectrum, style, titles
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import CoatingMap


def scales(coating: CoatingMap, max_frequency: float) -> dict[str, Any]:
    """Axes that all coatings share, from any of them.

    Returns
    -------
    dict
        ``f_omega`` and ``C1`` (n,); ``speed_edges`` and ``speed_of_cell``, the cells of the maps as
        `bladerub.plots.bins.with_gaps` makes them, with None in the holes; ``angle_edges``, in degrees;
        ``order`` (m,) and how many of them are ``kept`` at each speed.
    """
    speed_edges, speed_of_cell = bins.with_gaps(coating.f_omega, np.arange(coating.f_omega.size))
    bounds = thinning.stretches(coating.angle.size)
    return {
        "f_omega": coating.f_omega,
        "C1": coating.C1,
        "speed_edges": speed_edges,
        "speed_of_cell": speed_of_cell,
        "angle_edges": np.degrees(bins.edges(coating.angle)[bounds]),
        "order": coating.spectrum_order,
        "kept": thinning.kept_orders(coating.f_omega, coating.spectrum_order, max_frequency),
    }


def coating(case: CoatingCase, peaks: pd.DataFrame, configs: list[str]) -> dict[str, Any]:
    """Name, properties and resonant peaks of one coating.

    Parameters
    ----------
    case : CoatingCase
        The coating.
    peaks : DataFrame
        ``peaks.csv``.
    configs : list of str
        Files that were laid over config/config.yaml.
    """
    return {
        "name": case.name,
        "title": titles.coating(case),
        "casing": case.casing,
        "E": case.E,
        "K": case.K,
        "theta": case.theta,
        "law": case.law,
        "rigid": case.is_rigid,
        "friction": case.friction,
        "command": figures.command(case, configs),
        "peaks": [
            {"order": row.order, "f": row.f_peak, "Y": row.amplitude}
            for row in figures.of_case(peaks, case).itertuples()
        ],
    }


def look() -> dict[str, Any]:
    """Colours and lines of the figures of the paper, for the page to draw in the same."""
    return {
        "wear": _colours(style.WEAR_MAP),
        "amplitude": _colours(style.AMPLITUDE_MAP),
        "height": _colours(colormaps[style.HEIGHT_MAP]),
        "A": style.FIRST["color"],
        "B": style.SECOND["color"],
        "dark": style.DARK,
        "blue": style.BLUE,
        "red": style.RED,
        "orange": style.ORANGE,
        "missing": style.MISSING,
    }


def _colours(colour_map: Colormap) -> list[str]:
    return [to_hex(colour) for colour in colour_map(np.linspace(0, 1, 64))]


def about(settings: dict[str, Any]) -> dict[str, Any]:
    """Gather what the page says and draws besides the data.

    Parameters
    ----------
    settings : dict
        ``max_frequency`` (normalised), ``amplitude_range`` (m), ``growth_revolutions`` and
        ``spectrum_revolutions``, from the config.
    """
    return {
        **settings,
        "made_by": software(),
        "amplitude_floor": AMPLITUDE_FLOOR,
        "orders": list(spectrum.ORDERS),
        "last_order": thinning.LAST_ORDER,
        "look": look(),
    }
