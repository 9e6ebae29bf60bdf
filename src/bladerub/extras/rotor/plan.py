"""The plan of rows: groups of combinations, each with draws of its blades."""

import itertools
from collections.abc import Collection, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from bladerub.config.errors import ConfigError
from bladerub.extras import plans
from bladerub.extras.inventory import Inventory, take
from bladerub.extras.rotor.settings import Group, RotorPlan
from bladerub.extras.rows.spec import Row
from bladerub.extras.rows.study import drawn
from bladerub.io.folders import study_folder
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec, speed_name
from bladerub.study.plan import CoatingPlan, planned_run

_LISTS = ("f_omega", "blades", "length_scatter", "frequency_scatter", "coupling")


@dataclass(frozen=True)
class Combination:
    """Rows of one kind on one coating at one speed; scatters are standard deviations."""

    case: CoatingCase
    f_omega: float  # normalised
    blades: int
    length_scatter: float = 0.0  # of the tip radii, m
    frequency_scatter: float = 0.0  # of the natural frequencies, relative
    coupling: float = 0.0  # springs between neighbours over the stiffness of the first mode; 0: a stiff disk

    @property
    def name(self) -> str:
        """Name of its folder."""
        scatters = f"l{self.length_scatter:g}_d{self.frequency_scatter:g}_c{self.coupling:g}"
        return f"{self.case.name}_f{speed_name(self.f_omega)}_n{self.blades}_{scatters}"

    @property
    def alone(self) -> "Combination":
        """The single nominal blade on this coating at this speed."""
        return Combination(self.case, self.f_omega, 1)


@dataclass(frozen=True)
class Patterns:
    """Rows whose worn pattern is followed."""

    harmonic: int  # lobes of the pattern
    interval: int  # revolutions between two looks at the wear
    draws: dict[Combination, int]  # number of them


@dataclass(frozen=True)
class Plan:
    """A plan as read: combinations by name, each with the number of its draws.

    `compared` and `swept` are the combinations of its groups and of its sweeps, by name. `patterns` have
    combinations of their own.
    """

    seed: int
    combinations: dict[str, Combination]
    draws: dict[str, int]
    compared: tuple[str, ...]
    swept: tuple[str, ...]
    patterns: Patterns | None = None

    def row(self, combination: Combination, draw: int) -> Row:
        """Draw the blades of one row of a combination."""
        scatters = {name: getattr(combination, name) for name in ("length_scatter", "frequency_scatter")}
        return drawn(combination.blades, self.seed + draw, combination.coupling, **scatters)

    def runs(self, config: Config, name: str) -> CoatingPlan:
        """Plan the draws of one combination as runs of the study `config`; growth is not followed further."""
        combination = self.combinations[name]
        spec = run_spec(config, combination.case, combination.f_omega)
        runs = [
            planned_run(config, spec, f"{draw:04d}.h5", False, self.row(combination, draw), follow=False)
            for draw in range(self.draws[name])
        ]
        return CoatingPlan(combination.case, tuple(runs))


PLAN = Path("config/rotor.yaml")
"""The plan of a study, in its folder."""

RUNS = Path("rotor/runs")
"""Folder of the rows, a subfolder for each combination, in that of the results."""


def read_plan(path: str | Path, config: Config) -> Plan:
    """Read a plan (config/rotor.yaml says what it holds) for the study `config`.

    Identical blades are one row, and the single nominal blade stands beside each combination. Raises
    `ConfigError` if it is no plan, or the study has not its casings or speeds: the message has file, line,
    key, value and what would be right.
    """
    located = plans.read_plan(path, RotorPlan, study=config)
    plan = RotorPlan.model_validate(located.plain())
    followed_groups = plan.patterns.groups if plan.patterns else {}
    sections = {"groups": plan.groups, "sweeps": plan.sweeps or {}, "patterns.groups": followed_groups}
    pairs: dict[str, list[tuple[Combination, int]]] = {}
    by_name: dict[str, Combination] = {}
    for section, groups in sections.items():
        pairs[section] = []
        for name, group in groups.items():
            members = list(_combinations_of(group))
            if problem := _problem(group, config) or _same_name(members, by_name):
                key = f"{section}.{name}"
                raise ConfigError.at(located.locations()[key], f"{key}.{problem}")
            pairs[section] += members
    followed = dict(pairs.pop("patterns.groups"))
    combinations, draws = {}, {}
    for combination, n in itertools.chain(*pairs.values()):
        combinations[combination.name] = combination
        draws[combination.name] = max(n, draws.get(combination.name, 0))
    names = (dict.fromkeys(combination.name for combination, _ in members) for members in pairs.values())
    patterns = Patterns(plan.patterns.harmonic, plan.patterns.interval, followed) if followed else None
    return Plan(plan.seed, combinations, draws, *map(tuple, names), patterns)


def _combinations_of(group: Group) -> Iterator[tuple[Combination, int]]:
    """Yield the combinations of a group, and of its single nominal blades, with their numbers of draws."""
    case = CoatingCase(group.casing, group.E, group.K, group.theta)
    for values in itertools.product(*(getattr(group, name) for name in _LISTS)):
        combination = Combination(case, *values)
        differ = combination.length_scatter or combination.frequency_scatter
        yield combination.alone, 1
        yield combination, group.draws if differ else 1


def _problem(group: Group, config: Config) -> str | None:
    """Say which key of a group the study does not have, with what would be right."""
    if group.casing not in config.casings:
        return f'casing = "{group.casing}": must be one of the casings, {", ".join(config.casings)}'
    fastest, highest = max(group.f_omega), config.reduction.f_omega_max
    if fastest > highest:
        return f"f_omega: {fastest:g}: must be at most reduction.f_omega_max = {highest:g}"
    return None


def _same_name(members: list[tuple[Combination, int]], by_name: dict[str, Combination]) -> str | None:
    """Enter the combinations of a group in `by_name`; say which would share the folder of another."""
    for combination, _ in members:
        first = by_name.setdefault(combination.name, combination)
        if first != combination:
            speeds = f"{first.f_omega:g} and {combination.f_omega:g}"
            return f"f_omega: {speeds} would both be {combination.name}; leave one out"
    return None


def described(combination: Combination) -> dict[str, Any]:
    """Describe a combination by the columns of the tables."""
    values = asdict(combination)
    case = values.pop("case")
    return {name: case[name] for name in ("casing", "E", "K", "theta")} | values


def inventories(
    config: Config, results: Path, digest: str | None, known: Collection[Path]
) -> list[Inventory]:
    """Count the runs of the rows of blades, if any were begun, as `take` does."""
    path = study_folder() / PLAN
    if not ((results / RUNS).exists() and path.exists()):
        return []
    plan = read_plan(path, config)
    return [
        take(config, plan.runs(config, name), results / RUNS / name, digest, known)
        for name in plan.combinations
    ]
