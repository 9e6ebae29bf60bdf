"""What a config says of speed sweeps and long runs."""

from typing import Annotated

from pydantic import Field

from bladerub.settings.fields import UNIQUE, Form, Limit, Omitted, Section, Speed, Unit

_Coating = Annotated[
    str,
    Field(pattern=r"^[A-Za-z0-9]+_(E[^_/ ]+_K[^_/ ]+_(theta|mu)|rigid_mu)[^_/ ]+(_(xi|h|d)[^_/ ]+){0,3}$"),
    Form("its name in the folder of runs, for instance 2nd_E1.1_K0.5_theta0 or 2nd_rigid_mu0"),
]
_SWEPT = ["2nd_E0.11_K0.5_theta0", "2nd_E1.1_K0.5_theta0", "2nd_E2_K0.5_theta0", "2nd_E2_K0.5_theta0.15"]
_FITTED = Limit("at most", "reduction.f_omega_max", "beyond which the stiffness of the blade is not fitted")


class Sweeps(Section):
    """Passages through the speeds in time, up and down, each from rest on a new coating.

    Made by `snakemake -j2 sweeps`.
    """

    coatings: Annotated[list[_Coating], UNIQUE] = Field([*_SWEPT, "2nd_rigid_mu0"], max_length=5000)
    """Those that the study does not have are left out."""
    start: Speed = Field(0.14, gt=0, le=10)
    """Below all peaks of interest, so that the response to the first contact has decayed there."""
    stop: Omitted[Annotated[Speed, Limit("above", "sweeps.start"), _FITTED]] = Field(None, gt=0, le=10)
    """reduction.f_omega_max if not given, the end of the paper's range."""
    rates: Annotated[list[Annotated[float, Unit("f1/s"), Field(ge=1e-4, le=10)]], UNIQUE] = Field(
        [0.01, 0.05, 0.2], min_length=1, max_length=100
    )
    """Changes of the normalised speed in a second, each of one sweep up and one down; an engine takes some
    seconds for all of it."""
    speed_step: Speed = Field(2.0e-4, ge=1e-6, le=0.1)
    """The modes are updated after this change of speed; well below the width of the resonance, which is twice
    the damping ratio times the speed."""
    survival: Annotated[float, Unit("amplitudes at constant speed")] = Field(0.5, gt=0, le=1)
    """A peak that keeps less of its amplitude at constant speed has not survived the sweep."""


class LongRuns(Section):
    """The runs that still grow at the end of their confirmation, and those at the peaks.

    Made by `snakemake -j2 long_runs`.
    """

    revolutions: int = Field(500, ge=1, le=10000)
    """Three to ten seconds of contact; a saturation with a time constant up to a hundred revolutions is
    found."""


SWEEPS = Annotated[Sweeps, Field(default=Sweeps())]
LONG_RUNS = Annotated[LongRuns, Field(default=LongRuns())]
