"""The grid of the study: which coatings at which speeds, and the SI run behind each point."""

import itertools
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, NamedTuple

import numpy as np

from bladerub import plugins
from bladerub.contact import laws
from bladerub.contact.spec import PLASTIC, Casing, Coating, ElementLaw, RunSpec, TipProfile
from bladerub.io.errors import BadInput
from bladerub.settings.coatings import OnCasing
from bladerub.settings.contact import AnyCasing
from bladerub.settings.contact import Casing as Waves
from bladerub.settings.study import Config

SPEED_DECIMALS = 6  # of speeds, so that start + i step and a written value agree
SAME_SPEED = 1e-6  # speeds closer than this are the same point of the grid


class Scale(NamedTuple):
    """Factors of lengths, of ``contact.modulus_unit`` and of times, see `run_spec`."""

    length: float = 1.0
    modulus: float = 1.0
    time: float = 1.0


UNSCALED = Scale()  # ``contact.scale`` where the config has none: all its values are absolute
MAX_COATINGS = 5000  # coatings of a study; each is a job, and Snakemake plans no more than some ten thousand
OWN = {"damping_ratio": "xi", "layer_thickness": "h", "interference": "d"}
"""Keys that a coating may have instead of those of ``contact`` and ``casings``: their signs in its name."""

_LAYER = ("E", "K", "theta", "friction")
_VARIED = (*_LAYER, *OWN)  # lists in an entry of coatings, of which every combination is run


@dataclass(frozen=True)
class CoatingCase:
    """One coating of the study: a casing and the normalised properties of its layer."""

    casing: str  # a name in the config
    E: float  # Young and plastic modulus; both infinite for direct contact with the rigid casing
    K: float
    theta: float  # rotation of the abradable elements, or angle of friction by Coulomb's law, rad
    law: str = "theta"  # or "coulomb", see `bladerub.contact.spec.Coating`
    variant: str = ""  # values of its own (`OWN`) as in its name: ``xi0.001_h0.004_d0.0004``

    @classmethod
    def rigid(cls, casing: str, friction: float) -> "CoatingCase":
        """Direct contact with the rigid casing under Coulomb's coefficient `friction`."""
        return cls(casing, math.inf, math.inf, math.atan(friction), "coulomb")

    @classmethod
    def described(cls, attributes: Mapping[str, Any]) -> "CoatingCase":
        """Read the coating from the attributes of a run or a map; raise `KeyError` if one is missing."""
        values = {"variant": "", **attributes}  # files of earlier versions have no variants
        return cls(**{field.name: values[field.name] for field in fields(cls)})

    def with_own(self, **values: float | None) -> "CoatingCase":
        """Return this coating with values of its own for keys of `OWN`; None leaves that of the config."""
        parts = (
            f"{sign}{values[key] + 0.0:.12g}" for key, sign in OWN.items() if values.get(key) is not None
        )
        return replace(self, variant="_".join(parts))

    @property
    def own(self) -> dict[str, float]:
        """Its values for keys of `OWN`, as in the config."""
        values = dict(re.findall(r"([a-z]+)([^_]+)", self.variant))
        return {key: float(values[sign]) for key, sign in OWN.items() if sign in values}

    @property
    def is_rigid(self) -> bool:
        """Whether this is direct contact with the rigid casing."""
        return math.isinf(self.E) and math.isinf(self.K)

    @property
    def friction(self) -> float:
        """Coefficient of friction: tangential over radial part of the contact force."""
        return math.tan(self.theta)

    @property
    def name(self) -> str:
        """Name in paths, such as ``2nd_E0.11_K0.5_theta0`` or ``2nd_rigid_mu0.15``; a variant comes last."""
        layer = "rigid" if self.is_rigid else f"E{self.E:g}_K{self.K:g}"
        angle = f"theta{self.theta:g}" if self.law == "theta" else f"mu{self.friction:g}"
        return f"{self.casing}_{layer}_{angle}" + (f"_{self.variant}" if self.variant else "")


def coating_cases(config: Config) -> list[CoatingCase]:
    """List the coatings of the config in its order; ValueError names an entry that is twice, or too many."""
    cases: dict[str, CoatingCase] = {}
    for index, entry in enumerate(config.coatings):
        n_cases = len(cases) + math.prod(map(len, _values(entry).values()))
        if n_cases > MAX_COATINGS:
            raise ValueError(
                f"coatings[{index}]: brings the coatings to {n_cases}, all combinations counted; must be "
                f"{MAX_COATINGS} or fewer"
            )
        for case in cases_of(entry):
            if case.name in cases:
                raise ValueError(f"coatings[{index}]: {case.name}: must be listed once")
            cases[case.name] = case
    return list(cases.values())


def cases_of(entry: OnCasing) -> list[CoatingCase]:
    """List the combinations that one entry of ``coatings`` stands for."""
    varied = _values(entry)
    combinations = itertools.product(*varied.values())
    return [_case(entry.casing, dict(zip(varied, values, strict=True))) for values in combinations]


def listed_case(entry: OnCasing) -> CoatingCase:
    """Read one coating, of one value each, from what has the keys of an entry of ``coatings``."""
    return _case(entry.casing, _values(entry))


def _values(entry: OnCasing) -> dict[str, Any]:
    return {key: value for key in _VARIED if (value := getattr(entry, key, None)) is not None}


def _case(casing: str, values: Mapping[str, float]) -> CoatingCase:
    # not -0.0, which has another name
    layer = {key: float(values[key]) + 0.0 for key in _LAYER if key in values}
    moduli = layer.get("E", math.inf), layer.get("K", math.inf)
    angle = (math.atan(layer["friction"]), "coulomb") if "friction" in layer else (layer["theta"], "theta")
    return CoatingCase(casing, *moduli, *angle).with_own(**{key: values[key] for key in OWN if key in values})


def case_from_name(config: Config, name: str) -> CoatingCase:
    """Find a coating of the study, or one that plugs in (``COATINGS``), by name; raises `BadInput`."""
    further = (coatings(config) for coatings in plugins.loaded("COATINGS").values())
    for case in itertools.chain(coating_cases(config), *further):
        if case.name == name:
            return case
    raise BadInput(f"coating {name} is not in the config; add it to coatings")


def between(f_omega: np.ndarray, low: float, high: float) -> np.ndarray:
    """Select the speeds (n,) from `low` to `high`, both included."""
    return (f_omega >= low - SAME_SPEED) & (f_omega <= high + SAME_SPEED)


def speeds(config: Config) -> list[float]:
    """List the speeds, normalised, ascending; ValueError if two would have the same name in paths."""
    grid = config.speeds
    n_steps = math.floor((grid.stop - grid.start) / grid.step + 1e-6)
    regular = [grid.start + index * grid.step for index in range(n_steps + 1)]
    distinct = sorted({round(float(f), SPEED_DECIMALS) for f in [*regular, *grid.extra]})
    for slower, faster in itertools.pairwise(distinct):
        if speed_name(slower) == speed_name(faster):
            raise ValueError(f"speeds: {slower:g} and {faster:g} are closer than 0.0001; leave one out")
    return distinct


def speed_name(f_omega: float) -> str:
    """Name of a speed in paths, for instance ``0.1900``."""
    return f"{f_omega:.4f}"


def modulus_unit(config: Config) -> float:
    """Return what E = 1 and K = 1 are in this study, Pa."""
    return float(config.contact.modulus_unit * config.contact.plugged("scale", UNSCALED).modulus)


def young_moduli(config: Config) -> list[float]:
    """List the Young modulus of every abradable coating of the config, Pa."""
    return [modulus_unit(config) * case.E for case in coating_cases(config) if not case.is_rigid]


def element_law(config: Config) -> ElementLaw:
    """Describe the law that the config names; raises `ValueError` as `bladerub.contact.laws.element_law`."""
    return laws.element_law(config.contact.plugged("law"))


def casing_spec(name: str, entry: AnyCasing, length_scale: float = 1.0) -> Casing:
    """Describe an entry of ``casings`` in SI units; `length_scale` is ``contact.scale.length``.

    Raises a ValueError that begins with the key if a kind that plugs in cannot be read, or none does.
    """
    if not isinstance(entry, Waves):
        return casing_kind(entry).casing_spec(name, entry, length_scale)
    return Casing(
        name=name,
        nodal_diameters=tuple(entry.nodal_diameters),
        weights=tuple(entry.weights),
        amplitude=entry.amplitude * length_scale,
        interference=entry.interference * length_scale,
        start_angle=math.radians(entry.start_angle),
        bump_width=entry.bump_width or 0.0,
    )


def casing_kind(entry: AnyCasing) -> Any:
    """Return the module that describes a casing which is no sum of waves or bumps, by the key that it has."""
    for key, place in plugins.offered("CASINGS").items():
        if entry.plugged(key) is not None:
            return plugins.load(place)
    raise ValueError("nodal_diameters: missing, this package has casings of these alone")


def run_spec(config: Config, case: CoatingCase, f_omega: float) -> RunSpec:
    """Describe the run of coating `case` at the speed `f_omega` in SI units.

    The one place where values that the config gives in blade lengths, degrees or for the stand-in of the
    paper's blade (``contact.scale``) become SI of this blade. Raises `KeyError` for a casing
    that it has not, `ValueError` as `casing_spec`.
    """
    contact, solver, own = config.contact, config.solver, case.own
    casing, length = config.casings[case.casing], config.blade.length
    if "interference" in own:
        casing = casing.replaced("interference", own["interference"])
    scale = contact.plugged("scale", UNSCALED)
    return RunSpec(
        casing=casing_spec(case.casing, casing, scale.length),
        coating=Coating(
            E=case.E,
            K=case.K,
            theta=case.theta,
            yield_stress=contact.yield_stress,
            modulus_unit=modulus_unit(config),
            thickness=own.get("layer_thickness", contact.layer_thickness) * scale.length,
            n_elements=contact.elements,
            law=case.law,
            element_law=PLASTIC if case.is_rigid else element_law(config),
        ),
        tip=TipProfile(
            half_width=contact.tip_profile.half_width,
            edge_drop=contact.tip_profile.edge_drop * scale.length,
            turns=bool(contact.tip_turns),
        ),
        clearance=(contact.clearance.leading_edge * length, contact.clearance.trailing_edge * length),
        damping_ratio=own.get("damping_ratio", contact.damping_ratio),
        f_omega=float(f_omega),
        revolutions=solver.revolutions,
        scheme=solver.scheme,
        displacement_limit=solver.displacement_limit * length,
        tolerance=solver.tolerance,
        steps_per_element=solver.steps_per_element or 0,
        max_time_step=(solver.max_time_step or math.inf) * scale.time,
    )


def keeps_history(config: Config, case: CoatingCase, f_omega: float) -> bool:
    """Return whether the config lists this run among those whose whole displacement is kept."""
    return any(
        round(entry.f_omega, SPEED_DECIMALS) == round(f_omega, SPEED_DECIMALS)
        and listed_case(entry).name == case.name
        for entry in config.analysis.histories
    )
