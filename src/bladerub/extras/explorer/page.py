"""The page: template, style, program, drawing library and data in one file."""

import base64
import hashlib
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

import pandas as pd

from bladerub.extras.explorer import coating, study
from bladerub.io.optional import package
from bladerub.study.manifest import read_manifest
from bladerub.study.maps import read_map

_PROGRAM = ["data.js", "choice.js", "pictures.js", "words.js", "main.js"]
"""In the order in which they use each other."""


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
    ``peaks.csv`` and ``divergence.csv``, `settings` as of `bladerub.extras.explorer.study.about`, `configs`
    the files that were laid over config/config.yaml. Raises `OSError` if a map or manifest cannot be read,
    and `ValueError` if the coatings were not computed at the same speeds, or the tables are of other ones.
    """
    coatings, data, scales = [], [], None
    revolutions, max_frequency = settings["spectrum_revolutions"], settings["max_frequency"]
    for index, (map_path, manifest_path) in enumerate(zip(map_paths, manifest_paths, strict=True)):
        coating_map, runs = read_map(map_path), read_manifest(manifest_path)
        coating_scales = study.scales(coating_map, max_frequency)
        scales = scales or coating_scales
        if coating.json_text(coating_scales) != coating.json_text(scales):
            raise ValueError(
                f"{map_path}: not of the same blade, speeds and angles as {map_paths[0]}; make the maps again"
            )
        coatings.append(study.coating(coating_map.case, peaks, configs))
        for name, text in coating.parts(coating_map, divergence, runs, revolutions, max_frequency).items():
            data.append(f'<script type="application/gzip" id="{name}-{index}">{text}</script>')
    library, program = package("plotly.offline", "study").get_plotlyjs(), "\n".join(map(_text, _PROGRAM))
    return Template(_text("index.html")).substitute(
        policy=_policy(library, program),
        style=_text("style.css"),
        study=coating.json_text({**study.about(settings), **scales, "coatings": coatings}),
        data="\n".join(data),
        library=library,
        program=program,
    )


def _text(name: str) -> str:
    return files("bladerub.extras.explorer").joinpath("page", name).read_text(encoding="utf-8")


def _policy(*scripts: str) -> str:
    """Content security policy: no connection, and no script but `scripts`."""
    digests = [base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() for text in scripts]
    allowed = " ".join(f"'sha256-{digest}'" for digest in digests)
    return f"default-src 'none'; script-src {allowed}; style-src 'unsafe-inline'; img-src data: blob:"
