"""How a coating is swept; without the solver, for the planning of the jobs."""

from dataclasses import dataclass, replace

from bladerub.contact.spec import RunSpec
from bladerub.io.errors import BadInput
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec


@dataclass(frozen=True)
class SweepSpec:
    """One passage through the speeds, which are normalised."""

    run: RunSpec  # at the speed where the passage begins; it stays there for its ``revolutions``, if any
    f_end: float  # speed where it ends, above or below the first
    rate: float  # change of the speed in a second, positive, 1/s
    speed_step: float  # largest change between two steps of constant speed


DIRECTIONS = ("up", "down")


def sweep_spec(config: Config, case: CoatingCase, direction: str, rate: float) -> SweepSpec:
    """Describe one sweep in SI units; it begins at rest, on a new coating."""
    settings, highest = config.sweeps, config.reduction.f_omega_max
    if settings.start >= highest:
        requirement = f"must be below reduction.f_omega_max = {highest:g}"
        raise BadInput(f"sweeps.start = {settings.start:g}: {requirement}")
    ends = settings.start, settings.stop or highest
    start, stop = ends if direction == "up" else ends[::-1]
    run = replace(run_spec(config, case, start), revolutions=0)
    return SweepSpec(run, stop, rate, settings.speed_step)
