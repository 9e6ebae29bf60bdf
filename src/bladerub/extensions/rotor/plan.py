"""The plan of rows: groups of combinations, each with draws of its blades."""

import itertools
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from bladerub.config import read as configuration
from bladerub.config.errors import ConfigError
from bladerub.config.files import Located
from bladerub.contact.row_spec import Disk, Row
from bladerub.study.grid import CoatingCase, run_spec, speed_name
from bladerub.study.plan import CoatingPlan, planned_run

_LISTS = ("f_omega", "blades", "length_scatter", "frequency_scatter", "coupling")


@dataclass(frozen=True)
class Combination:
    """Rows of one kind on one coating at one speed; scatters are standard deviations.

    Parameters
    ----------
    case : CoatingCase
        The coating.
    f_omega : float
        Speed, normalised.
    blades : int
        Number of blades.
    length_scatter : float
        Of the tip radii, m.
    frequency_scatter : float
        Of the natural frequencies, relative.
    coupling : float
        Springs between neighbours over the stiffness of the first mode; 0 for a stiff disk.
    """

    case: CoatingCase
    f_omega: float
    blades: int
    length_scatter: float = 0.0
    frequency_scatter: float = 0.0
    coupling: float = 0.0

    @property
    def name(self) -> str:
        """Name of its folder."""
        scatters = f"l{self.length_scatter:g}_d{self.frequency_scatter:g}_c{self.coupling:g}"
        return f"{self.case.name}_f{speed_name(self.f_omega)}_n{self.blades}_{scatters}"

    @property
    def alone(self) -> "Combination":
        """The single nominal blade on this coating at this speed."""
        return Combination(self.case, self.f_omega, 1)

    def row(self, seed: int) -> Row:
        """Draw a row."""
        disk = Disk.ring(self.blades, [self.coupling]) if self.coupling else None
        return Row.drawn(self.blades, seed, self.length_scatter, self.frequency_scatter, disk)


@dataclass(frozen=True)
class Plan:
    """A plan as read: combinations by name, each with the number of its draws."""

    seed: int
    combinations: dict[str, Combination]
    draws: dict[str, int]

    def runs(self, config: Mapping[str, Any], name: str) -> CoatingPlan:
        """Plan the draws of one combination as runs; growth is not followed further.

        `config` is the study; its runs are those of `without_confirmation`.
        """
        combination = self.combinations[name]
        spec = run_spec(config, combination.case, combination.f_omega)
        rows = [combination.row(self.seed + draw) for draw in range(self.draws[name])]
        runs = [
            planned_run(config, spec, f"{draw:04d}.h5", keep_history=False, row=row)
            for draw, row in enumerate(rows)
        ]
        return CoatingPlan(combination.case, tuple(runs))


def without_confirmation(config: Mapping[str, Any]) -> dict[str, Any]:
    """Return the study `config` in which no run that grows is repeated for longer."""
    analysis = config["analysis"]
    divergence = {**analysis["divergence"], "confirmation_revolutions": 0}
    return {**config, "analysis": {**analysis, "divergence": divergence}}


def read_plan(path: str | Path, config: Mapping[str, Any]) -> Plan:
    """Read a plan (config/rotor.yaml says what it holds) for the study `config`.

    Identical blades are one row, and the single nominal blade stands beside each combination. Raises
    `ConfigError` if it is no plan, or the study has not its casings or speeds: the message has file, line,
    key, value and what would be right.
    """
    located = configuration.read_plan(path, "rotor_plan")
    for name, group in located.content["groups"].content.items():
        _check(name, group, config)
    plan = located.plain()
    combinations: dict[str, Combination] = {}
    draws: dict[str, int] = {}
    for group in plan["groups"].values():
        case = CoatingCase(group["casing"], *(float(group[name]) for name in ("E", "K", "theta")))
        for values in itertools.product(*(group[name] for name in _LISTS)):
            found = Combination(case, *values)
            scatters = found.length_scatter or found.frequency_scatter
            for each, n in ((found.alone, 1), (found, group["draws"] if scatters else 1)):
                combinations[each.name] = each
                draws[each.name] = max(n, draws.get(each.name, 0))
    return Plan(plan["seed"], combinations, draws)


def _check(name: str, located: Located, config: Mapping[str, Any]) -> None:
    group, fastest = located.plain(), config["reduction"]["f_omega_max"]
    if group["casing"] not in config["casings"]:
        known = ", ".join(config["casings"])
        text = f'groups.{name}.casing = "{group["casing"]}": must be one of the casings, {known}'
        raise ConfigError.at(located.location, text)
    for f_omega in group["f_omega"]:
        if f_omega > fastest:
            text = f"groups.{name}.f_omega: {f_omega:g}: must be at most reduction.f_omega_max = {fastest:g}"
            raise ConfigError.at(located.location, text)


def described(combination: Combination) -> dict[str, Any]:
    """Describe a combination by the columns of the tables."""
    own = asdict(combination)
    case = own.pop("case")
    return {name: case[name] for name in ("casing", "E", "K", "theta")} | own
