"""Verdicts on the claims in several studies: side by side, counted, and drawn as a mark for each.

`margins` show how far the analysis decides them: the claims, judged again on parts of the study.
Nothing is simulated. Each variation drops speeds, Young moduli or plastic moduli of the study, or reads the
peaks through another window; then every claim is judged as in the study.
"""

import logging
from collections.abc import Iterable
from dataclasses import replace
from operator import attrgetter
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from bladerub.io.errors import BadInput
from bladerub.plots import style
from bladerub.settings.study import Config
from bladerub.study import divergence, findings, peaks
from bladerub.study.findings.claim import SCORE
from bladerub.study.findings.evidence import Evidence, read_rom_accuracy
from bladerub.study.grid import SAME_SPEED, SPEED_DECIMALS, speeds
from bladerub.study.maps import DATASETS, CoatingMap, read_map
from bladerub.study.wear import lobes

MARKS = {
    "yes": {"marker": "o", "facecolor": style.DARK, "edgecolor": style.DARK},
    "partly": {"marker": "o", "facecolor": style.ORANGE, "edgecolor": style.DARK},
    "no": {"marker": "x", "facecolor": style.GREY},
}
"""Full, light and crossed, so that grey print keeps them apart."""

STUDY = "study"
"""Name of the variation that changes nothing."""

SETTINGS = {
    "window 0.90 to 1.20": ("peaks.speed_window", [0.9, 1.2]),
    "window 0.75 to 1.50": ("peaks.speed_window", [0.75, 1.5]),
    "window from the crossing": ("peaks.speed_window", [1.0, 1.35]),  # contact can but stiffen
    "line of the order alone": ("peaks.order_halfwidth", 0.0),
    "half an order each side": ("peaks.order_halfwidth", 0.5),
    "growth above 2 %": ("divergence.growth", 0.02),
}
"""Other values in ``config.analysis``: where a peak is looked for, how wide an order is, what grows."""

PROMINENCES = (0.05, 0.2)
"""Other values of ``analysis.lobe_prominence``: what counts as a lobe."""

_IN_FIGURES = {"E": {0.11, 1.1, 2.0, 11.0, 20.0, np.inf}, "K": {0.5, np.inf}}  # moduli that are never dropped
_log = logging.getLogger(__name__)


def side_by_side(table: pd.DataFrame, by: str) -> pd.DataFrame:
    """Return ``holds`` of each claim (rows) by the column `by` of findings, both in their order."""
    if table.empty:
        raise BadInput("no claim is judged: none is about the coatings and speeds that are varied")
    wide = table.pivot_table(index="id", columns=by, values="holds", aggfunc="first")
    return wide.loc[list(dict.fromkeys(table["id"])), list(dict.fromkeys(table[by]))]


def counts(table: pd.DataFrame) -> pd.DataFrame:
    """Count the verdicts of each ``set`` of findings, and name those that differ from the first."""
    holds = side_by_side(table, by="set")
    numbers = holds.apply(pd.Series.value_counts).reindex(list(SCORE)).fillna(0).astype(int).T
    score = holds.apply(lambda of_set: of_set.map(SCORE))
    change = score.sub(score.iloc[:, 0], axis=0)
    for word, differs in (("better", change > 0), ("worse", change < 0)):
        numbers[word] = [" ".join(differs.index[differs[name]]) for name in holds]
    return numbers.rename_axis(index="set", columns=None).reset_index()


@style.styled
def verdicts(holds: pd.DataFrame) -> Figure:
    """Draw a column a study and a row a claim: `holds` is yes, partly, no or, without a verdict, NaN."""
    rows, columns = holds.shape
    figure = style.new_figure(style.PAGE, 0.9 + 0.155 * rows + 0.045 * max(map(len, holds.columns)))
    axes = figure.subplots()
    for word, mark in MARKS.items():
        claim, study = np.nonzero((holds == word).to_numpy())
        axes.scatter(study, claim, s=26, linewidth=0.8, label=word, zorder=2, **mark)
    axes.set_xticks(range(columns), holds.columns, rotation=90)
    axes.set_yticks(range(rows), holds.index)
    axes.set(xlim=(-0.7, columns - 0.3), ylim=(rows - 0.4, -0.6))
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    for row in range(rows):
        axes.axhline(row, color="#e9e9e9", linewidth=0.6, zorder=1)
    for column, count in enumerate((holds == "yes").sum()):
        axes.text(column, rows - 0.3, str(count), ha="center", va="top", fontsize=8)
    axes.text(-0.9, rows - 0.3, "yes", ha="right", va="top", fontsize=8)
    figure.legend(loc="outside lower center", ncols=3, handletextpad=0.2)
    return figure


def variations(config: Config, maps: Iterable[CoatingMap]) -> dict[str, tuple[Config, list[CoatingMap]]]:
    """List the variations by name, `STUDY` first: with another window or threshold, or fewer of the maps."""
    maps = [coating for coating in maps if not coating.case.variant]
    varied = {STUDY: (config, maps)}
    if _even_speeds(config, 1).size < len(speeds(config)):
        varied["even speeds only"] = config, _at(maps, _even_speeds(config, 1))
    for every in (2, 4):
        step = every * config.speeds.step
        varied[f"speed step {step:g}"] = config, _at(maps, _even_speeds(config, every))
    for name, (key, value) in SETTINGS.items():
        study_value = attrgetter(key)(config.analysis)
        # below the study's threshold of growth there are no longer runs to judge by
        if value != study_value and (key != "divergence.growth" or value > study_value):
            varied[name] = config.replaced(f"analysis.{key}", value), maps
    for prominence in PROMINENCES:
        if prominence != config.analysis.lobe_prominence:
            counted = [
                replace(coating, lobes=np.array([lobes(coating.angle, w, prominence) for w in coating.wear]))
                for coating in maps
            ]
            varied[f"lobes above {100 * prominence:g} %"] = config, counted
    for modulus in ("E", "K"):
        values = {getattr(coating.case, modulus) for coating in maps}
        dropped = sorted(values - _IN_FIGURES[modulus])[::2]
        coatings = [coating for coating in maps if getattr(coating.case, modulus) not in dropped]
        if dropped and coatings:
            without = ", ".join(f"{value:g}" for value in dropped)
            varied[f"without {modulus} = {without}"] = config, coatings
    return varied


def _even_speeds(config: Config, every: int) -> np.ndarray:
    """Return each `every`-th of the even speeds, and those whose displacement is kept: claims name them."""
    even = speeds(config.replaced("speeds.extra", []))[::every]
    history_speeds = [round(entry.f_omega, SPEED_DECIMALS) for entry in config.analysis.histories]
    return np.union1d(even, history_speeds)


def _at(maps: Iterable[CoatingMap], f_omega: np.ndarray) -> list[CoatingMap]:
    """Return `maps` at those of their speeds that are in `f_omega`."""
    over_speed = [name for name, (dims, *_) in DATASETS.items() if dims[0] == "f_omega"]
    selected = []
    for coating in maps:
        mask = np.abs(coating.f_omega[:, None] - f_omega).min(axis=1) < SAME_SPEED
        values = {name: getattr(coating, name) for name in over_speed if getattr(coating, name) is not None}
        selected.append(replace(coating, **{name: array[mask] for name, array in values.items()}))
    return selected


def margins(config: Config, map_paths: Iterable[str | Path], rom_accuracy_path: str | Path) -> pd.DataFrame:
    """Judge every claim in every variation: a row each, as of findings; the log has what cannot be judged."""
    rom_accuracy, judged = read_rom_accuracy(rom_accuracy_path), []
    varied = variations(config, map(read_map, map_paths))
    if not varied[STUDY][1]:
        raise BadInput("coatings: margins need one without values of its own, as the claims do")
    for name, (settings, maps) in varied.items():
        _log.warning("%s:", name)  # a heading for what `findings` leaves out
        tables = {"peaks": peaks.table(settings, maps), "divergence": divergence.table(settings, maps)}
        tables["rom_accuracy"] = rom_accuracy
        judged.append(findings.judge(Evidence(settings, tables, maps)).assign(variation=name))
    return pd.concat(judged, ignore_index=True)[["variation", *findings.COLUMNS]]
