"""The study's peaks again, with finer bars under the same tip, and with more interface nodes on it.

A bar is an abradable element. With n times as many, the profile keeps its shape in metres and the coating
its stiffness per area; the time step stays. What remains is how the bars resolve the edge of the profile
(`bladerub.contact.tip.coverage`) and the wear under it. More nodes, with more static modes of the tip, find
even places on a mesh that is finer along the chord.
"""

import itertools
import math
import time
from collections.abc import Callable, Mapping
from dataclasses import astuple, replace
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from bladerub.blade.build import build
from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.contact.run import simulate
from bladerub.contact.setup import compile_kernel, fixed_steps
from bladerub.contact.spec import RunSpec
from bladerub.contact.strips import strip_width
from bladerub.extras.verification.differences import amplitude_on
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, element_law, run_spec, speeds
from bladerub.study.variants import filled, with_variant

REFINEMENTS = (1, 2, 4)  # how many times finer the bars are; 1 are the study's
NODES = (8, 16, 24)  # numbers of interface nodes; 8 are the study's
CHORDWISE = 24  # elements; 49 nodes along the camber line

_LAYERS = [(0.11, 0.5, 0.0), (1.1, 0.5, 0.0), (2.0, 0.5, 0.0), (2.0, 0.5, 0.15), (20.0, 10.0, 0.0)]
CASES = [CoatingCase("2nd", *layer) for layer in _LAYERS]
"""Coatings of the paper whose peaks are compared: those of Figs. 8, 9, 15 and 16, and the stiffest."""


class Model(NamedTuple):
    """A model of the runs that is compared with others."""

    blade: ReducedBlade
    wear: Callable[[RunResult], np.ndarray]  # mean wear of a run, m, of one shape in all models
    change: Callable[[RunSpec], RunSpec] = lambda spec: spec


def listed(peaks: pd.DataFrame) -> list[tuple[CoatingCase, Any]]:
    """List coating and row of the peaks of the `CASES` in a table ``peaks.csv``, or of all if it has none."""
    rows = filled(peaks[peaks.law == "theta"]).dropna(subset=["f_peak"]).itertuples()
    described = [(CoatingCase.described(row._asdict()), row) for row in rows]
    return [pair for pair in described if pair[0] in CASES] or described


def finer_bars(blade: ReducedBlade, config: Config, peaks: pd.DataFrame) -> pd.DataFrame:
    """Find the peaks of some coatings of `peaks`, a table ``peaks.csv``, again with finer bars."""
    models = {}
    for times in REFINEMENTS:
        wear, change = partial(_under_bars, times=times), partial(with_finer_bars, blade, times=times)
        models[config.contact.elements * times] = Model(blade, wear, change)
    return _table(compared("elements", models, config, peaks))


def more_nodes(config: Config, peaks: pd.DataFrame) -> pd.DataFrame:
    """Find the same peaks with more interface nodes; ``cpu_s``: of the run at the study's speed of a peak."""
    blades = {n: blade_with(config, n) for n in NODES}
    models = {n: Model(blade, partial(_along_chord, blade)) for n, blade in blades.items()}
    seconds = []
    for (case, peak), blade in itertools.product(listed(peaks), blades.values()):
        start = time.process_time()
        simulate(blade, run_spec(config, case, float(peak.f_peak)))
        seconds.append(time.process_time() - start)
    return _table(compared("interface_nodes", models, config, peaks).assign(cpu_s=seconds))


def compared(column: str, models: Mapping[int, Model], config: Config, peaks: pd.DataFrame) -> pd.DataFrame:
    """Find peaks with each of some models, by the number that `column` has; the first is the study's.

    A row for each of the peaks that `listed` takes and each model: the peak to which the response rises from
    the study's speed of the peak, and the wear at that speed.
    """
    rows = []
    for case, peak in listed(peaks):
        *coating, _, variant = astuple(case)
        for number, model in models.items():
            run, speed, amplitude = _climb(model, config, case, peak)
            wear = model.wear(run)
            if number == next(iter(models)):
                own_wear, own_amplitude = wear, amplitude
            change, volume_change = amplitude / own_amplitude - 1, wear.sum() / own_wear.sum() - 1
            difference = np.linalg.norm(wear - own_wear) / np.linalg.norm(own_wear)
            sizes = speed, amplitude, change, volume_change, difference
            rows.append((*coating, peak.order, number, *sizes, run.status, variant))
    columns = ["casing", "E", "K", "theta", "order", column, "f_peak", "amplitude", "amplitude_change"]
    return pd.DataFrame(rows, columns=[*columns, "volume_change", "wear_difference", "status", "variant"])


def _climb(model: Model, config: Config, case: CoatingCase, peak: Any) -> tuple[RunResult, float, float]:
    """Return the run at the speed of a peak; speed and amplitude (m) of the peak that rises from there."""

    @cache
    def run(f_omega: float) -> RunResult:
        return simulate(model.blade, model.change(run_spec(config, case, f_omega)))

    def amplitude(index: int) -> float:
        return amplitude_on(peak.order, run(grid[index]), config.analysis)

    grid, start = speeds(config), float(peak.f_peak)
    index, highest = -1, int(np.argmin(np.abs(np.array(grid) - start)))
    while highest != index:
        index = highest
        highest = max(range(max(index - 1, 0), min(index + 2, len(grid))), key=amplitude)
    return run(start), grid[index], amplitude(index)


def _table(rows: pd.DataFrame) -> pd.DataFrame:
    return with_variant(rows, [column for column in rows if column != "variant"])


def with_finer_bars(blade: ReducedBlade, spec: RunSpec, times: int) -> RunSpec:
    """Return the run with bars `times` finer under the same tip, at the same time step."""
    spec = fixed_steps(blade, spec)
    coating = replace(spec.coating, n_elements=spec.coating.n_elements * times)
    tip = replace(spec.tip, half_width=spec.tip.half_width * times)
    steps = math.ceil(spec.steps_per_element / times)
    return replace(spec, coating=coating, tip=tip, steps_per_element=steps)


def blade_with(config: Config, n: int) -> ReducedBlade:
    """Build the blade of `config` with `n` interface nodes, and compile the time loop for them."""
    varied = config.replaced("blade.mesh.chordwise", CHORDWISE).replaced("blade.mesh.thickness", 2)
    compile_kernel(bool(config.contact.tip_turns), n, element_law(config))
    return build(varied.replaced("reduction.interface_nodes", n)).reduced


def _under_bars(run: RunResult, times: int) -> np.ndarray:
    """Mean wear (8, N) under each of the study's bars, m."""
    return run.wear.reshape(len(run.wear), -1, times).mean(axis=2)


def _along_chord(blade: ReducedBlade, run: RunResult) -> np.ndarray:
    """Mean wear (N,) along the chord, m."""
    return np.average(run.wear, axis=0, weights=strip_width(blade))
