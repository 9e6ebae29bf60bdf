"""What models cannot say of a config: that its sections agree with each other."""

import itertools
import os
from collections.abc import Callable, Collection, Iterator

import numpy as np

from bladerub import plugins
from bladerub.blade import geometry
from bladerub.blade.cache import kept_frequency
from bladerub.blade.model import n_interface
from bladerub.blade.source import reader
from bladerub.config.errors import top_key
from bladerub.contact.casing import shape
from bladerub.io.errors import format_value
from bladerub.io.folders import study_folder
from bladerub.settings.contact import AnyCasing
from bladerub.settings.study import Config
from bladerub.settings.units import speed_in_words
from bladerub.study import grid
from bladerub.study.paper import HISTORIES
from bladerub.study.peaks import peak_orders, used_casings

Check = Callable[[Config], Iterator[str]]

SOURCE_FOLDERS = ("benchmarks", "build", "config", "docs", "profiles", "src", "studies", "tests")
"""Folders of the repository, not for results."""

MOST_RUNS = 2_000_000  # of a study
MOST_SAMPLES = 20_000_000  # that a run keeps in memory, one an element and revolution


def reads(*sections: str) -> Callable[[Check], Check]:
    """Mark a function that yields problems of a config, a line each, with the sections that it reads."""

    def mark(function: Check) -> Check:
        function.sections = frozenset(sections)  # type: ignore[attr-defined]
        return function

    return mark


def check(config: Config, broken: Collection[str]) -> list[str]:
    """List the problems of `config`, a line each, also by what plugs in (``AGREEMENTS``).

    A check is left out if it reads a section in `broken`, or one with a problem already found.
    """
    problems: list[str] = []
    plugged = plugins.loaded("AGREEMENTS").items()
    added = [function for section, function in plugged if config.plugged(section) is not None]
    for function in (*_CHECKS, *added):
        if not function.sections & {*broken, *map(top_key, problems)}:  # type: ignore[attr-defined]
            try:
                problems += function(config)
            except ValueError as error:  # of the function that reads the value: it says what would be right
                problems.append(str(error))
    return problems


def most_revolutions(config: Config) -> int:
    """Return the revolutions that the samples of a run allow (`MOST_SAMPLES`)."""
    return MOST_SAMPLES // config.contact.elements


@reads("results")
def _results(config: Config) -> Iterator[str]:
    folders = config.results.split("/")
    setting = f"results = {format_value(config.results)}"
    if folders[0].casefold() in SOURCE_FOLDERS:
        yield f"{setting}: must not be in {folders[0]}, which is the repository's own"
    for path in itertools.accumulate(folders, os.path.join):
        if os.path.isfile(study_folder() / path):
            yield f"{setting}: must be a folder, {path} is a file"


@reads("blade", "reduction")
def _blade(config: Config) -> Iterator[str]:
    blade = config.blade
    if source := reader(blade):
        yield from source.problems(config)
    else:
        geometry.check_size(blade.mesh)
        geometry.check(blade, n_interface(config))


@reads("reduction")
def _accuracy_modes(config: Config) -> Iterator[str]:
    modes, per_speed = config.reduction.accuracy_modes, config.reduction.modes_per_speed
    limit = 3 * n_interface(config) + per_speed  # coordinates that the reduced model has for sure
    if modes > limit:
        yield f"reduction.accuracy_modes = {modes}: must be at most {limit}, with {per_speed} modes_per_speed"


@reads("contact")
def _tip(config: Config) -> Iterator[str]:
    if config.contact.tip_turns and not plugins.offered("MOTIONS"):
        yield "contact.tip_turns = true: must be false, this package's tips keep their angle"


@reads("casings")
def _tables(config: Config) -> Iterator[str]:
    """Read the tables of measured casings."""
    for name, entry in config.casings.items():
        try:
            grid.casing_spec("", entry)
        except ValueError as error:
            yield f"casings.{name}.{error}"


@reads("casings", "contact", "blade", "coatings")
def _depths(config: Config) -> Iterator[str]:
    """Check that the blade touches every coating, not all around, and does not reach through it."""
    cases = grid.coating_cases(config)
    for name in config.casings:
        depths = [case.own.get("interference") for case in cases if case.casing == name]
        if not depths or None in depths:  # or each coating says how deep
            yield from casing_problems(config, name)
    for index, entry in enumerate(config.coatings):
        for case in grid.cases_of(entry) if grid.OWN.keys() & entry.model_fields_set else ():
            if problem := own_problem(config, case):
                key, bound = problem
                yield f"coatings[{index}].{key} = {case.own[key]:g}: must be {bound}"


def casing_problems(config: Config, name: str) -> Iterator[str]:
    """Say how the depth of a casing is wrong for coatings that have no `interference` of their own."""
    thickness, entry = config.contact.layer_thickness, config.casings[name]
    depth, key = grid.casing_spec(name, entry).interference, f"casings.{name}.interference"
    bound = _depth_bound(config, entry, depth)
    if entry.plugged("table"):
        if entry.interference is None:
            key = f"casings.{name}.table: interference"
        if bound and depth <= smallest_clearance(config):
            bound += "; give an interference here or in the entry of coatings, or lower the table"
        if depth >= thickness:
            bound = bound or f"below contact.layer_thickness, {thickness:g} m"
    if bound:
        yield f"{key} = {depth:g}: must be {bound}"


def _depth_bound(config: Config, entry: AnyCasing, depth: float) -> str | None:
    """Say what the depth of a casing must be, where the blade would touch all around, or never."""
    casing, smallest = grid.casing_spec("", entry), smallest_clearance(config)
    lowest = float(np.min(shape(casing, np.linspace(0, 2 * np.pi, 7201))))
    deepest = casing.amplitude * (1 - lowest) + smallest
    if depth > deepest:
        return f"at most {deepest:g} m, or the blade touches all around"
    if depth <= smallest:
        return f"above the smaller contact.clearance, {smallest:g} m, or the blade never touches"
    return None


def smallest_clearance(config: Config) -> float:
    """Smaller clearance at an edge of the tip, in m before ``contact.scale``, as those of the casings."""
    clearance = config.contact.clearance
    smallest = min(clearance.leading_edge, clearance.trailing_edge) * config.blade.length
    return smallest / config.contact.plugged("scale", grid.UNSCALED).length


def own_problem(config: Config, case: grid.CoatingCase) -> tuple[str, str] | None:
    """Say what is wrong with the values of its own that a coating has: the key, and what would be right."""
    casing, values = config.casings[case.casing], case.own
    thickness = values.get("layer_thickness", config.contact.layer_thickness)
    depth = values.get("interference", grid.casing_spec("", casing).interference)
    if "interference" not in values:
        bound = f"above the interference of the casing, {depth:g} m, or the blade reaches through the coating"
        return ("layer_thickness", bound) if depth >= thickness else None
    bound = _depth_bound(config, casing, depth)
    if depth >= thickness:
        bound = f"below the layer thickness, {thickness:g} m, or the blade reaches through the coating"
    return ("interference", bound) if bound else None


@reads("coatings", "speeds")
def _runs(config: Config) -> Iterator[str]:
    n_speeds = len(grid.speeds(config))
    if n_speeds < 2:
        stop = config.speeds.stop
        yield f"speeds.stop = {stop:g}: must give two speeds or more, for maps and peaks"
    n_runs = len(grid.coating_cases(config)) * n_speeds
    if n_runs > MOST_RUNS:
        yield f"speeds: {n_speeds} speeds are {n_runs} runs on all coatings, must be {MOST_RUNS} or fewer"


@reads("analysis", "solver", "contact")
def _revolutions(config: Config) -> Iterator[str]:
    limit, divergence = most_revolutions(config), config.analysis.divergence
    revolutions, confirmation = config.solver.revolutions, divergence.confirmation_revolutions
    setting = f"analysis.divergence.confirmation_revolutions = {confirmation}"
    for key, number in ((f"solver.revolutions = {revolutions}", revolutions), (setting, confirmation)):
        if number > limit:
            yield f"{key}: must be at most {limit}, a run keeps a sample for each element and revolution"
    fewest = revolutions + divergence.revolutions
    if 0 < confirmation < fewest:
        sum_of = "solver.revolutions + analysis.divergence.revolutions"
        yield f"{setting}: must be 0, or at least {sum_of} = {fewest}, to show what comes after a run"


@reads("analysis", "coatings", "speeds")
def _histories(config: Config) -> Iterator[str]:
    names, all_speeds = {case.name for case in grid.coating_cases(config)}, set(grid.speeds(config))
    for index, entry in enumerate(config.analysis.histories):
        key, case = f"analysis.histories[{index}]", grid.listed_case(entry)
        f_omega = round(entry.f_omega, grid.SPEED_DECIMALS)
        if (case, f_omega) in HISTORIES:  # the paper's, which a study of other coatings or speeds leaves out
            continue
        if case.name not in names:
            yield f"{key} = {case.name}: must be one of the coatings, add it there or drop it here"
        if f_omega not in all_speeds:
            requirement = "one of the speeds, add it to speeds.extra or drop it here"
            yield f"{key}.f_omega = {entry.f_omega:g}: must be {requirement}"


@reads("analysis", "casings", "coatings", "speeds")
def _crossings(config: Config) -> Iterator[str]:
    fastest = grid.speeds(config)[-1]
    for name in used_casings(config):
        has_orders = config.casings[name].peak_orders
        key = f"casings.{name}.peak_orders" if has_orders else "analysis.peaks.orders"
        for index, order in enumerate(peak_orders(config, name)):
            if order * fastest < 1:  # rotation stiffens the blade: C1 is nowhere below its value at rest, 1
                yield (
                    f"{key}[{index}] = {order}: must be at least {1 / fastest:.3g} to cross the first "
                    f"frequency below the highest speed, {speed_in_words(fastest, kept_frequency(config))}; "
                    "give others in your config, or higher speeds"
                )


_CHECKS = (
    *(_results, _blade, _accuracy_modes, _tip, _tables, _depths, _runs, _revolutions),
    *(_histories, _crossings),
)
