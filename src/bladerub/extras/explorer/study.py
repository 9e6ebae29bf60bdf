"""What the page holds of the study besides its coatings: axes, names, peaks and colours."""

from dataclasses import asdict
from typing import Any

import numpy as np
import pandas as pd
from matplotlib import colormaps
from matplotlib.colors import to_hex

from bladerub.extras.explorer.coating import AMPLITUDE_FLOOR, LAST_ORDER, arcs, command, kept_orders, mm
from bladerub.io.provenance import software
from bladerub.plots import bins, spectrum, style, titles
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import CoatingMap
from bladerub.study.variants import of_case


def scales(coating: CoatingMap, max_frequency: float) -> dict[str, Any]:
    """Axes that all coatings share, from any of them.

    ``speed_edges`` and ``speed_of_bin`` are the bins of the maps as of `bladerub.plots.bins.with_gaps`, with
    NaN in the gaps; ``angle_edges`` are in degrees; ``kept`` is how many entries of ``order`` each speed has.
    """
    speed_edges, speed_of_bin = bins.with_gaps(coating.f_omega, np.arange(coating.f_omega.size))
    return {
        "f_omega": coating.f_omega,
        "C1": coating.C1,
        "speed_edges": speed_edges,
        "speed_of_bin": speed_of_bin,
        "angle_edges": np.degrees(bins.edges(coating.angle)[arcs(coating.angle.size)]),
        "order": coating.spectrum_order,
        "kept": kept_orders(coating.f_omega, coating.spectrum_order, max_frequency),
    }


def coating(case: CoatingCase, peaks: pd.DataFrame, configs: list[str]) -> dict[str, Any]:
    """Name, properties and resonant peaks (``peaks.csv``, perhaps with bands; Y in mm) of one coating.

    What is missing is NaN: a peak, with its ``reason``, and the band of one without an ensemble.
    """
    columns = list(dict.fromkeys([*peaks, "draws", "amplitude_low", "amplitude_high", "reason"]))
    return {
        "name": case.name,
        "title": titles.coating(case),
        **asdict(case),
        "rigid": case.is_rigid,
        "friction": case.friction,
        "command": command(case, configs),
        "peaks": [
            {"order": row.order, "f": row.f_peak, "Y": mm(row.amplitude)}
            | {
                "reason": row.reason,
                "draws": row.draws,
                "low": mm(row.amplitude_low),
                "high": mm(row.amplitude_high),
            }
            for row in of_case(peaks, case).reindex(columns=columns).itertuples()
        ],
    }


def about(settings: dict[str, Any]) -> dict[str, Any]:
    """Collect what the page says and draws besides the data.

    `settings` from the config: ``max_frequency`` (normalised), ``amplitude_range`` (m),
    ``growth_revolutions``, ``spectrum_revolutions`` and ``modulus_unit`` (Pa); ``doubts`` of the blade.
    """
    return {
        **settings,
        "amplitude_range": mm(settings["amplitude_range"]),
        "made_by": software(),
        "amplitude_floor": mm(AMPLITUDE_FLOOR),
        "orders": list(spectrum.ORDERS),
        "last_order": LAST_ORDER,
        "look": look(),
    }


def look() -> dict[str, Any]:
    """Colours and lines of the figures of the paper, for the page to draw in the same."""
    maps = {"wear": style.WEAR_MAP, "amplitude": style.AMPLITUDE_MAP, "height": colormaps[style.HEIGHT_MAP]}
    lines = {"A": style.FIRST["color"], "B": style.SECOND["color"], "dark": style.DARK, "blue": style.BLUE}
    lines |= {"red": style.RED, "orange": style.ORANGE, "missing": style.MISSING}
    steps = np.linspace(0, 1, 64)
    return {name: [to_hex(colour) for colour in colours(steps)] for name, colours in maps.items()} | lines
