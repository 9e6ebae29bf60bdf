"""What can be asked of a study: one of its coatings, and one run."""

from dataclasses import dataclass, field, replace

from bladerub.api.arguments import InputError, over
from bladerub.blade.cache import first_frequency, kept_frequency
from bladerub.config import quantities
from bladerub.config.checks import most_revolutions
from bladerub.contact.spec import RunSpec
from bladerub.settings.coatings import QUANTITIES
from bladerub.settings.study import Config
from bladerub.settings.units import pressure_in_words, speed_in_words
from bladerub.study import grid

_MOST_REVOLUTIONS = 10_000

Quantity = float | str
"""A plain number as in a config, or text with a unit: ``"11400 rpm"``, ``"1.2 GPa"``, ``"6 mm"``."""


@dataclass(frozen=True, repr=False)
class StudyRun:
    """One run of a study: a coating at one speed, from `Study.run` or `StudyCoating.at`.

    Parameters
    ----------
    config : Config
        The config of the study, for a run of this length.
    case : CoatingCase
        Casing, coating and law of friction, normalised.
    spec : RunSpec
        The same in SI units, with everything else that the run is.
    f1_hz : float, optional
        First frequency by which a speed with a unit was normalised, Hz.

    Examples
    --------
    >>> planned = study.run("2nd", E=2, K=0.5, theta=0.15, f_omega=0.19)
    >>> planned.name, planned.f_omega
    ('2nd_E2_K0.5_theta0.15/0.1900', 0.19)
    >>> round(planned.of_length(0.1).spec.displacement_limit, 6)  # m: a tenth of the blade
    0.01
    """

    config: Config = field(repr=False)
    case: grid.CoatingCase
    spec: RunSpec = field(repr=False)
    f1_hz: float | None = field(default=None, repr=False, compare=False)

    @property
    def f_omega(self) -> float:
        """Rotational frequency over the first eigenfrequency at rest."""
        return self.spec.f_omega

    def of_length(self, length: float) -> "StudyRun":
        """Describe the same run of a blade of this `length` (m): clearances and limits are in this unit."""
        config = self.config.replaced("blade.length", length)
        spec = grid.run_spec(config, self.case, self.f_omega)
        start = self.spec.initial_displacement
        return replace(self, config=config, spec=replace(spec, initial_displacement=start))

    @property
    def name(self) -> str:
        """Coating and speed as in paths, for instance ``2nd_E2_K0.5_theta0.15/0.1900``."""
        return f"{self.case.name}/{grid.speed_name(self.f_omega)}"

    def __repr__(self) -> str:
        speed = speed_in_words(self.f_omega, kept_frequency(self.config))
        coating = f"{self.case.name}{_moduli(self.config, self.case)}"
        return f"StudyRun({coating}, at {speed}, {self.spec.revolutions} revolutions)"


@dataclass(frozen=True, repr=False)
class StudyCoating:
    """One coating of a study, or the rigid casing, from `Study.coating` or `Study.rigid`.

    Parameters
    ----------
    config : Config
        The config of the study.
    case : CoatingCase
        Casing, coating and law of friction, normalised.

    Examples
    --------
    >>> coating = study.coating("2nd", E=2, K=0.5)
    >>> coating.at(0.19, revolutions=5).spec.revolutions
    5
    """

    config: Config = field(repr=False)
    case: grid.CoatingCase

    @property
    def name(self) -> str:
        """Name in paths, for instance ``2nd_E2_K0.5_theta0.15``."""
        return self.case.name

    @over("f_omega", "revolutions")
    def at(self, f_omega: Quantity, revolutions: int | None = None) -> StudyRun:
        """Describe the run at the speed `f_omega`, of so many revolutions.

        The speed is normalised, or text such as ``"2200 rpm"``, by the first frequency of the study's blade.
        Lists of speeds or revolutions give a list of runs. Raises `InputError` if one is impossible.
        """
        plain = checked_number(self.config, "f_omega", f_omega)
        f1_hz = first_frequency(self.config) if isinstance(f_omega, str) else None
        config = self.config if revolutions is None else _of_revolutions(self.config, revolutions)
        return StudyRun(config, self.case, grid.run_spec(config, self.case, plain), f1_hz)

    def __repr__(self) -> str:
        return f"StudyCoating({self.case.name}{_moduli(self.config, self.case)})"


def checked_number(config: Config, name: str, value: Quantity) -> float:
    """Return the argument `name` as a plain number within its bounds."""
    try:
        return quantities.checked_number(name, value, QUANTITIES[name], quantities.references(config))
    except ValueError as error:
        raise InputError(name, value, str(error)) from None


def _moduli(config: Config, case: grid.CoatingCase) -> str:
    """Write E and K of a coating in Pa; nothing of the rigid casing."""
    if case.is_rigid:
        return ""
    E, K = (pressure_in_words(grid.modulus_unit(config) * modulus) for modulus in (case.E, case.K))
    return f", E = {E}, K = {K}"


def _of_revolutions(config: Config, revolutions: int) -> Config:
    """Change a config to runs of so many revolutions: its analysis looks at no more."""
    limit = min(_MOST_REVOLUTIONS, most_revolutions(config))
    if not isinstance(revolutions, int) or not 2 <= revolutions <= limit:
        raise InputError("revolutions", revolutions, f"must be a whole number from 2 to {limit}")
    spectrum, growth = config.analysis.spectrum_revolutions, config.analysis.divergence.revolutions
    return (
        config.replaced("solver.revolutions", revolutions)
        .replaced("analysis.spectrum_revolutions", min(spectrum, revolutions))
        .replaced("analysis.divergence.revolutions", max(3, min(growth, revolutions)))  # or no valid config
    )
