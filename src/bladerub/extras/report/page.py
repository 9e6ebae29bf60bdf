"""The page: results, answers and figures in the template ``page.html``, one file that needs no other."""

import math
import os
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from io import StringIO
from pathlib import Path

import matplotlib
import numpy as np
import yaml

from bladerub.blade.frequencies import doubts
from bladerub.extras.report import answers
from bladerub.extras.report.results import STRESS, Results, files
from bladerub.io.errors import package
from bladerub.io.folders import ROOT
from bladerub.io.provenance import PREFIX, config_digest, software
from bladerub.plots.campbell import campbell
from bladerub.plots.maps import spectrum_map, wear_map
from bladerub.plots.scales import Scales
from bladerub.plots.style import RED, data_address
from bladerub.study.grid import modulus_unit, run_spec

_SAME = {"svg.hashsalt": "bladerub", "svg.fonttype": "path"}  # equal results have equal pages


def build(results: Results, shown: Sequence[str], folder: Path) -> str:
    """Make the page, as HTML, with the maps of the coatings `shown`; it will be in `folder`."""
    jinja = package("jinja2", "study")
    loader = jinja.PackageLoader(__package__, "")
    environment = jinja.Environment(loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True)
    filters = ("band", "mm", "percent", "pressure_in_words", "properties", "ranges", "rpm", "title")
    environment.filters |= {name: getattr(answers, name) for name in filters}
    config, explorer = results.config, results.folder / "explorer.html"
    nominal = config.figures.nominal_speed
    scales = Scales(modulus_unit(config), config.blade.length, results.f1_hz, nominal)
    return environment.get_template("page.html").render(
        NONE=answers.NONE,
        STRESS=STRESS,
        results=results,
        config=config,
        answers=answers,
        origin=_origin(results),
        citation=_citation(),
        shown=shown,
        step=np.diff(np.unique(results.runs.rpm)).min(initial=np.inf),
        runs=dict(list(results.runs.groupby("name"))),
        doubts=doubts(results.accuracy, nominal),
        is_of_config=results.origin.get("provenance_config_sha256") == config_digest(config.plain()),
        specs={case.casing: run_spec(config, case.with_own(), 0.0) for case in results.cases.values()},
        modulus_unit=modulus_unit(config),
        degrees=math.degrees,
        campbell=_campbell(results, scales),
        pictures={name: _maps(results, name, scales) for name in shown},
        explorer=Path(os.path.relpath(explorer.absolute(), folder)).as_posix() if explorer.exists() else None,
    )


def _campbell(results: Results, scales: Scales) -> str:
    """Draw the Campbell diagram with the peaks of all coatings, as SVG."""
    figure = campbell(results.campbell, scales)
    peaks = results.peaks.dropna(subset=["f_peak"])
    look = {"linestyle": "none", "marker": "o", "fillstyle": "none", "markersize": 5, "color": RED}
    figure.axes[-1].plot(peaks.f_peak, peaks.order * peaks.f_peak, label="_peaks", zorder=4, **look)
    stream = StringIO()
    with matplotlib.rc_context(_SAME):
        figure.savefig(stream, format="svg", metadata={"Date": None})
    svg = stream.getvalue()
    return svg[svg.index("<svg") :].replace("<svg", '<svg role="img" aria-label="Campbell diagram"', 1)


def _maps(results: Results, name: str, scales: Scales) -> dict[str, str]:
    """Draw wear and spectra of a coating over the speed, as addresses of PNGs that hold them, by caption."""
    figures, coating = results.config.figures, results.map(name)
    ends, highest, worn = tuple(figures.amplitude_range), figures.max_frequency, coating.max_wear.any()
    drawn = {"Worn depth around the casing over the speed": wear_map(coating, scales)} if worn else {}
    drawn["Vibration over frequency and speed"] = spectrum_map(coating, ends, highest, scales)
    return {caption: data_address(figure) for caption, figure in drawn.items()}


def _origin(results: Results) -> Iterator[tuple[str, str]]:
    """List what made the tables, when the newest file was written (they hold no date), and what the page."""
    for name, value in results.origin.items():
        yield name.removeprefix(PREFIX).replace("_", " "), value
    newest = max(path.stat().st_mtime for path in files(results.config, results.folder))
    yield "newest file read", datetime.fromtimestamp(newest, UTC).strftime("%Y-%m-%d %H:%M UTC")
    yield "this page", software()


def _citation() -> str:
    """Say how to cite the program and the paper, from CITATION.cff."""
    about = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    works = []
    for work in (about, *about["references"]):
        authors = (author.get("name") or author["family-names"] for author in work["authors"])
        works.append(f"{', '.join(authors)}: {work['title']}")
    return f"{'; '.join(works)} (version {about['version']})."
