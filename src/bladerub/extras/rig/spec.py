"""What a rig is: tip, coated disk and incursion, in SI units; and rigs of a file (config/rigs.yaml)."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Annotated

from pydantic import Field

from bladerub.config.errors import ConfigError
from bladerub.config.problems import problems
from bladerub.config.read import location_of
from bladerub.contact.laws import element_law
from bladerub.contact.spec import PLASTIC, Coating, ElementLaw
from bladerub.extras import plans
from bladerub.extras.law_settings import Law
from bladerub.settings.fields import Form, Metre, Name, Omitted, Pascal, Radian, Section, Unit

PLAN = Path("config/rigs.yaml")
"""The rigs of a study, in its folder."""

MEASURABLE = (
    *("normal_force", "tangential_force", "normal_impulse", "tangential_impulse", "largest_pressure"),
    *("worn_depth", "pass_wear", "pass_energy", "temperature_rise"),
)
"""What a rig may have measured: columns of `bladerub.extras.rig.passes.simulate_passes`."""


class RigSettings(Section):
    """A rig of a plan: the parameters of `Rig`, whose measured values are in the units of their columns."""

    E: Pascal = Field(ge=1000, le=1e13)
    K: Pascal = Field(ge=0, le=1e13)
    yield_stress: Pascal = Field(ge=0, le=1e12)
    thickness: Metre = Field(ge=1e-6, le=1)
    tip_width: Metre = Field(ge=1e-6, le=1)
    tip_length: Metre = Field(ge=1e-6, le=1)
    track: Metre = Field(ge=0.001, le=1000)
    speed: Annotated[float, Unit("m/s")] = Field(ge=1e-6, le=10000)
    incursion: Metre = Field(ge=1e-9, le=1)
    theta: Radian = Field(ge=0, le=1.5)
    edge_drop: Metre = Field(ge=0, le=1)
    coated: Metre = Field(ge=0, le=1000)
    passes: int = Field(ge=1, le=100000)
    law: Omitted[Law] = None
    source: Annotated[Omitted[str], Form("a text of at most 300 letters")] = Field(None, pattern="^.{0,300}$")
    assumed: list[Annotated[str, Field(pattern=r"^[A-Za-z_]{1,40}$"), Form("the name of a rig's parameter")]]
    measured: Omitted[dict[str, Annotated[float, Unit("as in the table"), Field(ge=-1e15, le=1e15)]]] = None


class RigPlan(Section):
    """Rub rigs by name, a rigid tip on a coated disk (docs/laws.md)."""

    rigs: dict[Name, RigSettings] = Field(min_length=1, max_length=100)


@dataclass(frozen=True)
class Rig:
    """A rigid blade tip that rubs on a coated disk, fed by a constant incursion at each pass.

    Parameters
    ----------
    name : str
        Name of the case.
    E, K, yield_stress : float
        Young modulus, plastic modulus and elastic limit of the coating, Pa.
    thickness : float
        Of the coating, m.
    tip_width, tip_length : float
        Of the tip: across the track, and along it, m.
    track : float
        Length of the track that the tip passes from one pass to the next, m: the circumference.
    speed : float
        Of the tip along the track, m/s.
    incursion : float
        By which the tip is fed at each pass, m.
    passes : int
        Number of passes; the first is at the depth of one incursion.
    theta : float
        Angle of the contact force from the normal, against the motion, rad.
    edge_drop : float
        How much lower the edges of the tip are than its middle, m.
    coated : float
        Length of the coated part of the track, m; the whole track if 0.
    law : ElementLaw
        Law of the coating.
    measured : mapping of str to float
        What was measured in the last pass, by `MEASURABLE`.
    source : str
        Where inputs and measured values are from.
    assumed : tuple of str
        Names of the parameters that the source does not give.

    Raises
    ------
    ValueError
        If a parameter is not as it must be; the message names it and its value.

    Examples
    --------
    >>> import bladerub as br
    >>> rig = br.Rig(
    ...     "mine", E=600e6, K=300e6, yield_stress=0.0, thickness=3e-3, tip_width=1e-2, tip_length=2e-3,
    ...     track=1.0, speed=125.0, incursion=1e-5, law=br.Law("viscoplastic", viscosity=1e4).element_law,
    ... )
    >>> rig.law.label, rig.coating.E
    ('viscoplastic (viscosity 10000)', 600000000.0)
    """

    name: str
    E: float
    K: float
    yield_stress: float
    thickness: float
    tip_width: float
    tip_length: float
    track: float
    speed: float
    incursion: float
    passes: int = 1
    theta: float = 0.0
    edge_drop: float = 0.0
    coated: float = 0.0
    law: ElementLaw = PLASTIC
    measured: Mapping[str, float] = field(default_factory=dict)
    source: str = ""
    assumed: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Raise `ValueError`, which names the parameter and its value, if one is not as it must be."""
        parameters = {name: value for name, value in asdict(self).items() if name not in ("name", "law")}
        parameters |= {"assumed": list(self.assumed), "measured": dict(self.measured)}
        if mistakes := list(problems(parameters, RigSettings)):
            raise ValueError("; ".join(mistakes))
        if self.incursion * self.passes >= self.thickness:
            rule = f"must be below {self.thickness / self.passes:g}, or the layer is through"
            raise ValueError(f"incursion = {self.incursion:g}: {rule}")
        for name in ("tip_length", "coated"):
            if (length := getattr(self, name)) > self.track:
                raise ValueError(f"{name} = {length:g}: must be at most the track, {self.track:g}")
        if unknown := {*self.assumed} - {parameter.name for parameter in fields(self)}:
            raise ValueError(f"assumed = {min(unknown)}: must be a parameter of a rig")
        if unknown := {*self.measured} - {*MEASURABLE}:
            raise ValueError(f"measured = {min(unknown)}: must be one of {', '.join(MEASURABLE)}")

    @property
    def coating(self) -> Coating:
        """The coating, its moduli in Pa; elements are those of `bladerub.extras.rig.passes`."""
        layer = (self.E, self.K, self.theta, self.yield_stress, 1.0, self.thickness)
        return Coating(*layer, n_elements=1, element_law=self.law)


def read_rigs(path: str | Path) -> list[Rig]:
    """Read rigs; raises `ConfigError`, with file, line, key, value and what would be right."""
    rigs, plan = [], plans.read_plan(path, RigPlan)
    for name, located in plan.content["rigs"].content.items():
        rig, within = RigSettings.model_validate(located.plain()), f"rigs.{name}.law"
        try:
            law, within = element_law(rig.law), f"rigs.{name}"
            rigs.append(Rig(name, **rig.plain() | {"law": law, "assumed": tuple(rig.assumed)}))
        except ValueError as error:
            text = f"{within}.{error}"
            raise ConfigError.at(location_of(text, plan.locations()), text) from error
    return rigs
