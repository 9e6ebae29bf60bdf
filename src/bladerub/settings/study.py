"""The whole config of a study: the sections of the core, and those that plug in."""

from collections.abc import Collection, Mapping
from functools import cache
from typing import Annotated, Any, Literal

from pydantic import Field, create_model
from pydantic.fields import FieldInfo

from bladerub import plugins
from bladerub.settings.analysis import Analysis, Figures
from bladerub.settings.blade import BladeSpec
from bladerub.settings.coatings import Coatings, RunSpeed
from bladerub.settings.contact import Casing, Contact, casings
from bladerub.settings.fields import BladeLengths, Form, Limit, Number, Omitted, Section, Speed, Unit


class Speeds(Section):
    """Rotational frequencies that every coating is run at."""

    start: Speed = Field(ge=0.001, le=2)
    """Lowest speed. At lower ones a run takes long (in proportion to 1/speed) and nothing resonates."""
    stop: Annotated[
        Speed,
        Limit("at least", "speeds.start"),
        Limit("at most", "reduction.f_omega_max", "the reduced blade is not valid above"),
    ] = Field(ge=0.001, le=2)
    """Highest speed: upper end of the paper's range."""
    step: Speed = Field(ge=1e-4, le=2)
    """Determines how finely a peak is resolved; the cost is proportional to its inverse."""
    extra: list[RunSpeed] = Field(max_length=10000)
    """In addition to the evenly spaced ones, for instance those of Figs. 17 and 18."""


class Solver(Section):
    """Time integration of one run."""

    revolutions: int = Field(ge=1, le=10000)
    """Exactly twenty in the paper."""
    scheme: Literal["exponential", "central_differences"]
    """Exponential is exact in each mode and of second order in the contact forces; central differences with
    prediction and correction are the paper's scheme, of first order."""
    tolerance: Number = Field(ge=1e-5, le=0.1)
    """Largest relative error of worn depth, spectral peak and peak of a revolution of a run that is not
    chaotic. The time step follows from it, for each coating and speed; central differences, of first order,
    promise none."""
    steps_per_element: Omitted[int] = Field(None, ge=1, le=1000)
    """Fewest time steps in the passage of one element. Instead of a tolerance, alone or with the next key."""
    max_time_step: Omitted[Annotated[float, Unit("s", scaled="time")]] = Field(None, ge=1e-9, le=1e-4)
    """Instead of a tolerance; central differences need it below the stability limit of the highest mode of
    the blade."""
    displacement_limit: BladeLengths = Field(ge=1e-3, le=1)
    """Of an interface node, radial or tangential. Beyond it the run ends as unbounded: small displacements
    are no longer small."""
    device: Literal[("cpu", *plugins.offered("SOLVERS"))]  # type: ignore[valid-type]
    """What the runs are computed on; a GPU computes many at once. A chaotic run depends on what it is
    computed on, so the runs of the other are stale."""


class Config(BladeSpec):
    """The whole study, from the blade to the figures."""

    results: Annotated[
        str,
        Form(
            "a folder below the one Snakemake runs in, of at most 120 letters, digits and _ . - only, "
            'without ".."'
        ),
    ] = Field(pattern=r"^[A-Za-z0-9_][A-Za-z0-9_.-]*(/[A-Za-z0-9_][A-Za-z0-9_.-]*)*$", max_length=120)
    """Everything a rule makes is written to this folder, so that it can be deleted as a whole."""
    contact: Contact
    casings: casings({})  # type: ignore[valid-type]
    coatings: Coatings = Field(min_length=1, max_length=1000)
    """Each entry stands for all combinations of its values. With theta the contact force has a constant
    direction, with friction it follows Coulomb's law (studies/friction/README.md). An entry with the key
    `coating` is direct contact with the rigid casing."""
    speeds: Speeds
    solver: Solver
    analysis: Analysis
    figures: Figures

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the values: the class, with what plugs in, is made anew."""
        return typed, (self.plain(),)


@cache
def whole() -> type[Config]:
    """Make the model of a config: the core with what plugs in (``SECTIONS`` of `bladerub.plugins`)."""
    offered = plugins.loaded("SECTIONS")
    kinds = {
        key.removeprefix("casings."): offered.pop(key) for key in [*offered] if key.startswith("casings.")
    }
    for key in kinds.keys() & Casing.model_fields.keys():
        raise plugins.refusal("SECTIONS", f"casings.{key}", f"casings.{key}: is a key of every casing")
    study = create_model("Config", __base__=Config, __doc__=Config.__doc__, casings=(casings(kinds), ...))
    return _extended(study, "", offered)


def typed(values: Mapping[str, Any], broken: Collection[str] = ()) -> Config:
    """Make the config of `values` that have been checked, without those of its sections that are `broken`."""
    if not broken:
        return whole().model_validate(values)
    fields = whole().model_fields
    sound = fields.keys() & values.keys() - {*broken}
    definitions: Any = {name: (fields[name].annotation, fields[name]) for name in sound}
    sections = create_model("Sections", __base__=Section, **definitions)
    return whole().model_construct(**dict(sections.model_validate({name: values[name] for name in sound})))


def required() -> set[str]:
    """Return the names of the sections that every config has."""
    return {name for name, field in Config.model_fields.items() if field.is_required()}


@cache
def defaults() -> dict[str, Any]:
    """Return the sections that plug in with a default, which a file need not have."""
    added = whole().model_fields.keys() - Config.model_fields.keys()
    return whole().model_construct().model_dump(include=added, exclude_none=True)


def _extended(model: type[Section], path: str, offered: Mapping[str, Any]) -> type[Section]:
    """Add to the model of the section at `path` what is offered of it and of the sections below.

    One of these may plug in itself, or be there only for what is below it.
    """
    below = {key.removeprefix(path): kind for key, kind in offered.items() if key.startswith(path)}
    added: dict[str, Any] = {key: _field(kind) for key, kind in below.items() if "." not in key}
    for name in sorted({key.partition(".")[0] for key in below if "." in key}):
        if field := model.model_fields.get(name):
            added[name] = (_extended(field.annotation, f"{path}{name}.", offered), field)
        else:
            added[name] = _field(_extended(below.get(name, Section), f"{path}{name}.", offered))
    for key in added.keys() & below.keys() & model.model_fields.keys():
        place = f"{path}{key}"
        raise plugins.refusal("SECTIONS", place, f"{place}: is a key of the config, must have another name")
    return create_model(model.__name__, __base__=model, __doc__=model.__doc__, **added) if added else model


def _field(kind: Any) -> Any:
    """Let a config leave out a section without a default."""
    is_omitted = FieldInfo.from_annotation(kind).is_required()
    return (Omitted[kind], None) if is_omitted else kind
