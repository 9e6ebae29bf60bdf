"""The page: template, style, program, drawing library and data in one file."""

import base64
import hashlib
from dataclasses import asdict
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

import numpy as np
import pandas as pd
from matplotlib import colormaps
from matplotlib.colors import to_hex

from bladerub.extras.explorer import coating
from bladerub.extras.explorer.coating import mm
from bladerub.io.errors import package
from bladerub.io.provenance import software
from bladerub.plots import style, titles
from bladerub.plots.maps import edges, with_gaps
from bladerub.plots.scales import ORDERS
from bladerub.study.grid import CoatingCase
from bladerub.study.manifest import read_manifest
from bladerub.study.maps import CoatingMap, read_map
from bladerub.study.variants import of_case

_PROGRAM = ["data.js", "choice.js", "pictures.js", "words.js", "main.js"]  # as they use each other
_PEAK = {"order": "order", "f_peak": "f", "amplitude": "Y", "reason": "reason", "draws": "draws"}
_PEAK |= {"amplitude_low": "low", "amplitude_high": "high"}
"""Columns of ``peaks.csv`` and of the bands by their names in the page."""


def build(
    map_paths: list[str | Path],
    manifest_paths: list[str | Path],
    peaks: pd.DataFrame,
    divergence: pd.DataFrame,
    settings: dict[str, Any],
    configs: list[str],
) -> str:
    """Make the page, as HTML; equal data give equal text.

    `map_paths` and `manifest_paths` have each coating in the same order, `peaks` and `divergence` are
    ``peaks.csv`` and ``divergence.csv``, `configs` the files that were laid over config/config.yaml.
    `settings` are those of rule ``explorer`` (``max_frequency`` is normalised, others SI units), and
    ``f1_hz`` and ``doubts`` of the blade. Raises `OSError` if a map or manifest cannot be read, and
    `ValueError` if the coatings were not computed at the same speeds, or the tables are of other ones.
    """
    coatings, data, scales = [], [], None
    revolutions, max_frequency = settings["spectrum_revolutions"], settings["max_frequency"]
    for index, (map_path, manifest_path) in enumerate(zip(map_paths, manifest_paths, strict=True)):
        coating_map, runs = read_map(map_path), read_manifest(manifest_path)
        coating_scales = _scales(coating_map, max_frequency)
        scales = scales or coating_scales
        if coating.json_text(coating_scales) != coating.json_text(scales):
            problem = f"not of the same blade, speeds and angles as {map_paths[0]}"
            raise ValueError(f"{map_path}: {problem}; make the maps again")
        coatings.append(_coating(coating_map.case, peaks, configs))
        for name, text in coating.parts(coating_map, divergence, runs, revolutions, max_frequency).items():
            data.append(f'<script type="application/gzip" id="{name}-{index}">{text}</script>')
    library, program = package("plotly.offline", "study").get_plotlyjs(), "\n".join(map(_text, _PROGRAM))
    study = settings | {"amplitude_range": mm(settings["amplitude_range"]), "made_by": software()}
    study |= {"amplitude_floor": mm(coating.AMPLITUDE_FLOOR), "orders": list(ORDERS)}
    study |= {"last_order": coating.LAST_ORDER, "look": _look(), **scales, "coatings": coatings}
    scripts = {"library": library, "program": program, "policy": _policy(library, program)}
    texts = {"style": _text("style.css"), "study": coating.json_text(study), "data": "\n".join(data)}
    return Template(_text("index.html")).substitute(scripts | texts)


def _scales(coating_map: CoatingMap, max_frequency: float) -> dict[str, Any]:
    """Axes that all coatings share, from any of them: bins of speed with gaps, of the angle in degrees."""
    speed_edges, speed_of_bin = with_gaps(coating_map.f_omega, np.arange(coating_map.f_omega.size))
    return {
        "f_omega": coating_map.f_omega,
        "C1": coating_map.C1,
        "speed_edges": speed_edges,
        "speed_of_bin": speed_of_bin,
        "angle_edges": np.degrees(edges(coating_map.angle)[coating.arcs(coating_map.angle.size)]),
        "order": coating_map.spectrum_order,
        "kept": coating.kept_orders(coating_map.f_omega, coating_map.spectrum_order, max_frequency),
    }


def _coating(case: CoatingCase, peaks: pd.DataFrame, configs: list[str]) -> dict[str, Any]:
    """Name, properties and peaks of one coating, lengths in mm; a peak or band that is missing is NaN."""
    shown = of_case(peaks, case).reindex(columns=list(_PEAK)).rename(columns=_PEAK)
    shown[["Y", "low", "high"]] *= 1e3
    about = {"name": case.name, "title": titles.coating(case), **asdict(case), "rigid": case.is_rigid}
    about |= {"friction": case.friction, "command": coating.command(case, configs)}
    return about | {"peaks": shown.to_dict("records")}


def _look() -> dict[str, Any]:
    """Colours and lines of the figures of the paper, for the page to draw in the same."""
    maps = {"wear": style.WEAR_MAP, "amplitude": style.AMPLITUDE_MAP, "height": colormaps[style.HEIGHT_MAP]}
    lines = {"A": style.FIRST["color"], "B": style.SECOND["color"], "dark": style.DARK, "blue": style.BLUE}
    lines |= {"red": style.RED, "orange": style.ORANGE, "missing": style.MISSING}
    steps = np.linspace(0, 1, 64)
    return {name: [to_hex(colour) for colour in colours(steps)] for name, colours in maps.items()} | lines


def _text(name: str) -> str:
    return files("bladerub.extras.explorer").joinpath("page", name).read_text(encoding="utf-8")


def _policy(*scripts: str) -> str:
    """Content security policy: no connection, and no script but `scripts`."""
    digests = [base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() for text in scripts]
    allowed = " ".join(f"'sha256-{digest}'" for digest in digests)
    return f"default-src 'none'; script-src {allowed}; style-src 'unsafe-inline'; img-src data: blob:"
