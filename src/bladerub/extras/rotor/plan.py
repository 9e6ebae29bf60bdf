"""The plan of rows: what it holds, and its combinations, each with draws of their blades."""

import itertools
from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from bladerub.config.errors import ConfigError
from bladerub.extras import plans
from bladerub.extras.inventory import Inventory, take
from bladerub.extras.rows.spec import Row
from bladerub.extras.rows.study import drawn
from bladerub.io.folders import study_folder
from bladerub.settings.coatings import CasingName, PlasticModulus, RunSpeed, Theta, YoungModulus
from bladerub.settings.fields import Metre, Name, Number, Omitted, Section, Seed
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec, speed_name
from bladerub.study.plan import CoatingPlan, planned_run

_LISTS = ("f_omega", "blades", "length_scatter", "frequency_scatter", "coupling")
_SOME = Field(min_length=1, max_length=100)


class Group(Section):
    """Rows on one coating, for each combination of the lists."""

    casing: CasingName
    E: YoungModulus
    K: PlasticModulus
    theta: Theta
    f_omega: list[RunSpeed] = _SOME
    """Constant speeds."""
    blades: list[Annotated[int, Field(ge=1, le=200)]] = _SOME
    """Their numbers, at even angles. Neighbours must not meet within the displacement limit."""
    length_scatter: list[Annotated[Metre, Field(ge=0, le=0.01)]] = _SOME
    """Standard deviations of the tip radii, of normal distributions."""
    frequency_scatter: list[Annotated[Number, Field(ge=0, le=0.1)]] = _SOME
    """Relative standard deviations of the natural frequencies; one draw for all modes of a blade."""
    coupling: list[Annotated[Number, Field(ge=0, le=10)]] = _SOME
    """Springs between neighbours over the stiffness of the first mode; 0 is a stiff disk."""
    draws: int = Field(ge=1, le=10000)
    """Rows of each combination whose blades differ; identical blades are one row."""


class Patterns(Section):
    """Rows whose worn pattern is followed as it deepens, with their single blades."""

    harmonic: int = Field(ge=1, le=100)
    """Lobes of the pattern; such as the engine order of the peak."""
    interval: int = Field(ge=1, le=1000)
    """Revolutions between two looks at the wear."""
    groups: dict[Name, Group] = _SOME
    """As those of the plan, by name."""


class RotorPlan(Section):
    """Groups of rows of blades on one coating (studies/rotor/README.md)."""

    seed: Seed
    """Of the first draw; each further one adds 1."""
    groups: dict[Name, Group] = _SOME
    """Each stands for all combinations of its lists, by name."""
    sweeps: Omitted[dict[Name, Group]] = Field(None, max_length=100)
    """Groups whose rows are compared over their speeds, by name."""
    patterns: Omitted[Patterns] = None


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
class Plan:
    """A plan as read: combinations of its groups, its sweeps and its patterns, with the number of draws."""

    seed: int
    compared: Counter[Combination]
    swept: Counter[Combination]
    followed: Counter[Combination]
    patterns: Patterns | None = None

    @cached_property
    def draws(self) -> Counter[Combination]:
        """Number of draws of each combination that has runs."""
        return self.compared | self.swept

    @cached_property
    def combinations(self) -> dict[str, Combination]:
        """Those combinations by their names."""
        return {combination.name: combination for combination in self.draws}

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
            for draw in range(self.draws[combination])
        ]
        return CoatingPlan(combination.case, tuple(runs))


PLAN = Path("config/rotor.yaml")
"""The plan of a study, in its folder."""

RUNS = Path("rotor/runs")
"""Folder of the rows, a subfolder for each combination, in that of the results."""


def read_plan(path: str | Path, config: Config) -> Plan:
    """Read a plan for the study `config`; beside each combination stands its single nominal blade."""
    located = plans.read_plan(path, RotorPlan, study=config)
    plan = RotorPlan.model_validate(located.plain())
    of_patterns = plan.patterns.groups if plan.patterns else {}
    sections = {"groups": plan.groups, "sweeps": plan.sweeps or {}, "patterns.groups": of_patterns}
    draws: dict[str, Counter[Combination]] = {section: Counter() for section in sections}
    by_name: dict[str, Combination] = {}
    for section, groups in sections.items():
        for name, group in groups.items():
            members = Counter(dict(_combinations_of(group)))
            for combination in members:
                first = by_name.setdefault(combination.name, combination)
                if first != combination:
                    speeds = f"{first.f_omega:g} and {combination.f_omega:g}"
                    key = f"{section}.{name}.f_omega"
                    text = f"{key}: {speeds} would both be {combination.name}; leave one out"
                    raise ConfigError.at(located.locations()[key], text)
            draws[section] |= members
    return Plan(plan.seed, *draws.values(), plan.patterns)


def _combinations_of(group: Group) -> Iterator[tuple[Combination, int]]:
    """Yield the combinations of a group, and of its single nominal blades, with their numbers of draws."""
    case = CoatingCase(group.casing, group.E, group.K, group.theta)
    for values in itertools.product(*(getattr(group, name) for name in _LISTS)):
        combination = Combination(case, *values)
        differ = combination.length_scatter or combination.frequency_scatter
        yield combination.alone, 1
        yield combination, group.draws if differ else 1


def described(combination: Combination) -> dict[str, Any]:
    """Describe a combination by the columns of the tables."""
    values = asdict(combination)
    case = values.pop("case")
    return {name: case[name] for name in ("casing", "E", "K", "theta")} | values


def inventories(config: Config, folder: Path, digest: str | None, known: Collection[Path]) -> list[Inventory]:
    """Count the runs of the rows of blades, if any were begun in the `folder` of results, as `take` does."""
    path, runs = study_folder() / PLAN, folder / RUNS
    if not (runs.exists() and path.exists()):
        return []
    plan = read_plan(path, config)
    return [take(config, plan.runs(config, name), runs / name, digest, known) for name in plan.combinations]
