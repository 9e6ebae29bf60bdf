"""What a schema cannot say of a config: that its parts agree with each other."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterator
from itertools import accumulate, pairwise
from typing import Any

import numpy as np

from bladerub.blade import geometry
from bladerub.blade.model import N_INTERFACE
from bladerub.blade.sources import matrix_folder, origin
from bladerub.blade.sources.origin import MatrixSource
from bladerub.config.errors import format_value
from bladerub.contact.casing import shape
from bladerub.contact.spec import Casing
from bladerub.io.sources import ROOT
from bladerub.study.grid import SPEED_DECIMALS, UNSCALED, coating_cases, listed_case, speeds

Config = dict[str, Any]
Check = Callable[[Config], Iterator[str]]

SOURCE_FOLDERS = ("config", "docs", "src", "tests")
"""Folders of the repository, which no results may go to."""

MOST_ELEMENTS = 20_000
"""Elements of a blade's mesh: some 300,000 unknowns, beyond which its factors fill the memory."""

MOST_RUNS = 2_000_000
"""Runs of a study."""

MOST_SAMPLES = 20_000_000
"""Samples that a run keeps in memory, one an element and revolution."""

_checks: list[tuple[Check, frozenset[str]]] = []


def check(config: Config, broken: Collection[str]) -> list[str]:
    """List the problems of `config`, leaving out checks that read a top-level key in `broken`."""
    return [problem for function, parts in _checks if not parts & set(broken) for problem in function(config)]


def _reads(*parts: str) -> Callable[[Check], Check]:
    def register(function: Check) -> Check:
        _checks.append((function, frozenset(parts)))
        return function

    return register


@_reads("results")
def _results(config: Config) -> Iterator[str]:
    folders = config["results"].split("/")
    where = f"results = {format_value(config['results'])}"
    if folders[0].casefold() in SOURCE_FOLDERS:
        yield f"{where}: must not be in {folders[0]}, which is the repository's own"
    for path in accumulate(folders, os.path.join):
        if os.path.isfile(ROOT / path):
            yield f"{where}: must be a folder, {path} is a file"


@_reads("blade")
def _blade_shape(config: Config) -> Iterator[str]:
    if "source" in config["blade"]:
        yield from _blade_source(config["blade"])
        return
    try:
        _check_size(config["blade"]["mesh"])
        geometry.check(config["blade"])
    except ValueError as error:
        yield str(error)


def _blade_source(blade: Config) -> Iterator[str]:
    try:
        given = origin.read(blade["source"])
    except ValueError as error:
        yield f"blade.source.{error}"
        return
    if isinstance(given, MatrixSource):
        try:
            matrix_folder.files(given.folder)
        except ValueError as error:
            where = f"blade.source.matrices = {format_value(blade['source']['matrices'])}"
            yield f"{where}: {error} ({given.folder})"
        return
    if not given.file.is_file():
        where = f"blade.source.file = {format_value(blade['source']['file'])}"
        yield f"{where}: there is no such file ({given.file})"
    if given.is_table:
        try:
            _check_size(blade["mesh"])
            geometry.check_interface(blade["mesh"])
        except ValueError as error:
            yield str(error)


def _check_size(mesh: Config) -> None:
    n_elements = mesh["chordwise"] * mesh["thickness"] * mesh["spanwise"]
    if n_elements > MOST_ELEMENTS:
        raise ValueError(f"blade.mesh: has {n_elements} elements, must be {MOST_ELEMENTS} or fewer")


@_reads("reduction")
def _accuracy_modes(config: Config) -> Iterator[str]:
    reduction = config["reduction"]
    most = 3 * N_INTERFACE + reduction["modes_per_speed"]  # coordinates that the reduced model has for sure
    if reduction["accuracy_modes"] > most:
        yield (
            f"reduction.accuracy_modes = {reduction['accuracy_modes']}: must be at most {most} with "
            f"reduction.modes_per_speed = {reduction['modes_per_speed']}, the reduced model has no more"
        )


@_reads("reduction", "blade")
def _fit_speeds(config: Config) -> Iterator[str]:
    count = config["reduction"].get("fit_speeds", 3)
    if count != 3 and "matrices" in config["blade"].get("source", {}):
        yield f"reduction.fit_speeds = {count}: must be 3 with blade.source.matrices"


@_reads("casings", "contact")
def _casings(config: Config) -> Iterator[str]:
    layer = config["contact"]["layer_thickness"]
    for name, casing in config["casings"].items():
        where = f"casings.{name}"
        diameters, weights = casing["nodal_diameters"], casing["weights"]
        if len(weights) != len(diameters):
            yield f"{where}.weights = {weights}: must be {len(diameters)}, one for each of nodal_diameters"
            continue
        if not any(weights):
            yield f"{where}.weights = {weights}: at least one must not be 0"
            continue
        if 2 * max(diameters) > config["contact"]["elements"]:
            yield (
                f"{where}.nodal_diameters = {diameters}: must be at most half of contact.elements = "
                f"{config['contact']['elements']}"
            )
        depth, amplitude = casing["interference"], casing["amplitude"]
        lowest = _lowest(tuple(diameters), tuple(weights))
        if depth > amplitude * (1 - lowest):
            yield (
                f"{where}.interference = {depth:g}: must be at most {amplitude * (1 - lowest):g} m, or the "
                f"blade touches all around at an amplitude of {amplitude:g} m"
            )
        if depth >= layer:
            yield (
                f"{where}.interference = {depth:g}: must be below contact.layer_thickness = {layer:g} m, or "
                "the blade reaches through the coating"
            )


@_reads("casings", "contact", "blade")
def _contact_at_all(config: Config) -> Iterator[str]:
    smallest = min(config["contact"]["clearance"].values()) * config["blade"]["length"]
    scale = config["contact"].get("scale", UNSCALED)["length"]
    for name, casing in config["casings"].items():
        depth = casing["interference"]
        if depth * scale <= smallest:
            yield (
                f"casings.{name}.interference = {depth:g}: must be above the smaller contact.clearance, "
                f"{smallest / scale:g} m on this blade, or the blade never touches"
            )


def _lowest(nodal_diameters: tuple[int, ...], weights: tuple[float, ...]) -> float:
    casing = Casing("", nodal_diameters, weights, amplitude=1.0, interference=0.0, start_angle=0.0)
    return float(np.min(shape(casing, np.linspace(0, 2 * np.pi, 7201))))


@_reads("contact")
def _tip_profile(config: Config) -> Iterator[str]:
    half_width, elements = config["contact"]["tip_profile"]["half_width"], config["contact"]["elements"]
    if half_width > elements / 8:
        yield (
            f"contact.tip_profile.half_width = {half_width:g}: must be at most an eighth of "
            f"contact.elements = {elements}, the tip of a blade is narrow"
        )


@_reads("coatings", "casings")
def _coating_casings(config: Config) -> Iterator[str]:
    for index, entry in enumerate(config["coatings"]):
        yield from _known_casing(config, f"coatings[{index}]", entry["casing"])


@_reads("friction", "casings")
def _compared_casings(config: Config) -> Iterator[str]:
    for index, entry in enumerate(config.get("friction", [])):
        yield from _known_casing(config, f"friction[{index}]", entry["casing"])


def _known_casing(config: Config, where: str, casing: str) -> Iterator[str]:
    if casing not in config["casings"]:
        yield f'{where}.casing = "{casing}": must be one of the casings, {", ".join(config["casings"])}'


@_reads("coatings")
def _coatings_listed_twice(config: Config) -> Iterator[str]:
    try:
        coating_cases(config)
    except ValueError as error:
        yield str(error)


@_reads("speeds", "reduction")
def _speeds(config: Config) -> Iterator[str]:
    grid, highest = config["speeds"], config["reduction"]["f_omega_max"]
    if grid["stop"] < grid["start"]:
        yield f"speeds.stop = {grid['stop']:g}: must not be below speeds.start = {grid['start']:g}"
        return
    named = {"speeds.stop": grid["stop"]} | {f"speeds.extra[{i}]": f for i, f in enumerate(grid["extra"])}
    for where, f_omega in named.items():
        if f_omega > highest:
            yield (
                f"{where} = {f_omega:g}: must be at most reduction.f_omega_max = {highest:g} (normalised), "
                "the reduced blade is not valid above"
            )
    try:
        speeds(config)
    except ValueError as error:
        yield str(error)


@_reads("coatings", "speeds")
def _runs(config: Config) -> Iterator[str]:
    try:
        n_coatings, n_speeds = len(coating_cases(config)), len(speeds(config))
    except ValueError:  # told by the checks of the coatings and of the speeds
        return
    if n_coatings * n_speeds > MOST_RUNS:
        yield (
            f"speeds: {n_speeds} speeds on {n_coatings} coatings are {n_coatings * n_speeds} runs, must be "
            f"{MOST_RUNS} or fewer"
        )


def most_revolutions(config: Config) -> int:
    """Return the revolutions that the samples of a run allow (`MOST_SAMPLES`)."""
    return MOST_SAMPLES // config["contact"]["elements"]


@_reads("sweeps", "reduction")
def _sweeps(config: Config) -> Iterator[str]:
    sweeps, highest = config["sweeps"], config["reduction"]["f_omega_max"]
    if sweeps["stop"] > highest:
        yield (
            f"sweeps.stop = {sweeps['stop']:g}: must be at most reduction.f_omega_max = {highest:g}, beyond "
            "which the stiffness of the blade is not fitted"
        )
    if not sweeps["start"] < sweeps["stop"]:
        yield f"sweeps.stop = {sweeps['stop']:g}: must be above sweeps.start = {sweeps['start']:g}"


@_reads("analysis", "solver", "contact")
def _samples(config: Config) -> Iterator[str]:
    most = most_revolutions(config)
    revolutions = {
        "solver.revolutions": config["solver"]["revolutions"],
        "analysis.divergence.confirmation_revolutions": config["analysis"]["divergence"][
            "confirmation_revolutions"
        ],
    }
    for where, number in revolutions.items():
        if number > most:
            yield (
                f"{where} = {number}: must be at most {most} with contact.elements = "
                f"{config['contact']['elements']}, a run keeps a sample for each element and revolution"
            )


@_reads("analysis", "coatings", "casings", "speeds")
def _histories(config: Config) -> Iterator[str]:
    try:
        cases, grid = set(coating_cases(config)), set(speeds(config))
    except ValueError:  # told by the checks of the coatings and of the speeds
        return
    for index, entry in enumerate(config["analysis"]["histories"]):
        where = f"analysis.histories[{index}]"
        case = listed_case(entry)
        if entry["casing"] not in config["casings"]:
            yield from _known_casing(config, where, entry["casing"])
        elif case not in cases:
            yield f"{where} = {case.name}: must be one of the coatings, add it there or drop it here"
        if round(entry["f_omega"], SPEED_DECIMALS) not in grid:
            yield (
                f"{where}.f_omega = {entry['f_omega']:g}: must be one of the speeds, add it to "
                "speeds.extra or drop it here"
            )


@_reads("analysis", "solver", "contact")
def _analysis(config: Config) -> Iterator[str]:
    analysis, revolutions = config["analysis"], config["solver"]["revolutions"]
    spans = {
        "spectrum_revolutions": analysis["spectrum_revolutions"],
        "divergence.revolutions": analysis["divergence"]["revolutions"],
    }
    for key, span in spans.items():
        if span > revolutions:
            yield f"analysis.{key} = {span}: must be at most solver.revolutions = {revolutions}"
    confirmation = analysis["divergence"]["confirmation_revolutions"]
    fewest = revolutions + analysis["divergence"]["revolutions"]
    if 0 < confirmation < fewest:
        yield (
            f"analysis.divergence.confirmation_revolutions = {confirmation}: must be 0, or at least "
            f"solver.revolutions + analysis.divergence.revolutions = {fewest}, to show what comes after a run"
        )
    low, high = analysis["peaks"]["speed_window"]
    if low >= high:
        yield f"analysis.peaks.speed_window = {[low, high]}: must be the lower end first, then the upper"
    highest = analysis["max_order"]
    if highest > config["contact"]["elements"] / 2:
        yield (
            f"analysis.max_order = {highest:g}: must be at most half of contact.elements = "
            f"{config['contact']['elements']}, there is one sample an element"
        )
    for index, order in enumerate(analysis["peaks"]["orders"]):
        if order > highest:
            where = f"analysis.peaks.orders[{index}]"
            yield f"{where} = {order}: must be at most analysis.max_order = {highest:g}"


@_reads("analysis", "speeds")
def _crossings(config: Config) -> Iterator[str]:
    try:
        grid = speeds(config)
    except ValueError:  # told by the check of the speeds
        return
    if config["speeds"]["stop"] < config["speeds"]["start"]:  # told there as well
        return
    if len(grid) < 2:
        yield f"speeds.stop = {config['speeds']['stop']:g}: must give two speeds or more, for maps and peaks"
        return
    for index, order in enumerate(config["analysis"]["peaks"]["orders"]):
        if order * grid[-1] < 1:  # rotation stiffens the blade: C1 is nowhere below its value at rest, 1
            yield (
                f"analysis.peaks.orders[{index}] = {order}: must be at least {1 / grid[-1]:.3g} to cross the "
                f"first frequency below the highest speed, {grid[-1]:g}"
            )


@_reads("figures")
def _figures(config: Config) -> Iterator[str]:
    low, high = config["figures"]["amplitude_range"]
    if low >= high:
        yield f"figures.amplitude_range = {[low, high]}: must be the lower end first, then the upper"


@_reads("chart", "casings")
def _chart_casing(config: Config) -> Iterator[str]:
    yield from _known_casing(config, "chart", config["chart"]["casing"])


@_reads("chart")
def _chart_moduli(config: Config) -> Iterator[str]:
    for name in ("theta", "E", "K"):
        for index, (lower, upper) in enumerate(pairwise(config["chart"][name]), 1):
            if float(f"{upper:g}") <= float(f"{lower:g}"):  # six digits, as in the names of the files
                yield f"chart.{name}[{index}] = {upper:g}: must be above the one before ({lower:g})"


@_reads("chart", "speeds")
def _chart_speeds(config: Config) -> Iterator[str]:
    start, stop = config["chart"]["speeds"]["start"], config["speeds"]["stop"]
    if start >= stop:
        yield f"chart.speeds.start = {start:g}: must be below speeds.stop = {stop:g}"
