"""What the vibration on the rigid casing converges to, whatever the modes, the step and the impact.

An impact excites all modes of the blade at once. So a run may depend on the modes that are kept, on the time
step and on the law of impact that a discrete model needs. Runs are repeated with each of them changed.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact import run
from bladerub.contact.modes import Modes, modes_at
from bladerub.contact.schemes import SCHEMES
from bladerub.contact.setup import fixed_steps
from bladerub.contact.spec import RunSpec
from bladerub.contact.steps import with_steps
from bladerub.extras.verification import impact
from bladerub.extras.verification.differences import amplitude_on
from bladerub.settings.study import Config
from bladerub.study.grid import run_spec, speeds
from bladerub.study.paper import RIGID

PLAIN_SPEED = (0.25, 4)  # a speed away from the peaks, and the engine order looked at there
NEIGHBOURS = 2  # speeds of the study to either side of a peak that are looked at as well
RESTITUTIONS = {f"moreau_jean_{e:g}": e for e in (0.0, 0.5, 0.9)}
STIFFNESSES = {f"penalty_1e{power}": 10.0**power for power in (8, 9, 10)}  # N/m


class Alternative(NamedTuple):
    """Another way to compute a run."""

    treatment: str  # one of `SCHEMES`, of `RESTITUTIONS` and `STIFFNESSES`, or ``massless``
    finer: int  # the study's time step over this one; of a scheme, the step of its own tolerance
    modes: int | None = None  # kept, all by default


OWN = Alternative("exponential", 1)
NEARBY = (OWN, Alternative("moreau_jean_0", 8), *(Alternative("massless", 8, modes) for modes in (20, 40)))
ALTERNATIVES = (
    *NEARBY,
    *(Alternative("exponential", finer) for finer in (2, 4, 8)),
    *(Alternative("central_differences", finer) for finer in (1, 2)),
    Alternative("moreau_jean_0", 16),
    *(Alternative(name, 8) for name in (*RESTITUTIONS, *STIFFNESSES) if name != "moreau_jean_0"),
    *(Alternative("massless", 8, modes) for modes in (10, 60, 80)),
    *(Alternative("moreau_jean_0", 8, modes) for modes in (10, 20, 40, 60)),
)
"""What is tried at `PLAIN_SPEED` and at the peaks; `NEARBY` at the speeds next to them."""
COLUMNS = [
    *("f_omega", "treatment", "modes", "steps", "order", "complete", "amplitude", "amplitude_change"),
    *("largest_revolution", "median_revolution", "largest_displacement"),
]


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def table(blade: ReducedBlade, config: Config, peaks: pd.DataFrame) -> pd.DataFrame:
    """Repeat runs at the rigid casing's peaks of ``peaks.csv``: a row for each speed and alternative."""
    rows = []
    last = slice(-config.analysis.spectrum_revolutions, None)  # the revolutions of the study's spectra
    for f_omega, order, alternatives in _listed(config, peaks):
        spec, modes, study_amplitude = run_spec(config, RIGID, f_omega), modes_at(blade, f_omega), math.nan
        for alternative in alternatives:
            if (alternative.modes or 0) >= modes.omega.size:
                continue
            outcome, steps = _simulate(blade, spec, modes, alternative)
            amplitude = amplitude_on(order, outcome, config.analysis)
            study_amplitude = amplitude if alternative == OWN else study_amplitude
            treatment, n_modes = alternative.treatment, alternative.modes or modes.omega.size
            complete = treatment == "massless" or not (alternative.modes or treatment in STIFFNESSES)
            revolutions = outcome.revolution_amplitude[last]
            sizes = amplitude, amplitude / study_amplitude - 1, revolutions.max(), np.median(revolutions)
            displacement = outcome.revolution_peak[last].max()
            rows.append((f_omega, treatment, n_modes, steps, order, complete, *sizes, displacement))
    return pd.DataFrame(rows, columns=COLUMNS)


def _listed(config: Config, peaks: pd.DataFrame) -> Iterator[tuple[float, float, tuple[Alternative, ...]]]:
    """List speed, engine order and alternatives."""
    yield *PLAIN_SPEED, ALTERNATIVES
    grid = np.array(speeds(config))
    rigid = peaks[(peaks.casing == RIGID.casing) & np.isinf(peaks.E) & (peaks.theta == RIGID.theta)]
    for peak in rigid.dropna(subset=["f_peak"]).itertuples():
        index = int(np.argmin(np.abs(grid - peak.f_peak)))
        for place in range(max(index - NEIGHBOURS, 0), min(index + NEIGHBOURS + 1, grid.size)):
            yield float(grid[place]), peak.order, ALTERNATIVES if place == index else NEARBY


def _simulate(
    blade: ReducedBlade, spec: RunSpec, modes: Modes, how: Alternative
) -> tuple[impact.Motion | run.RunResult, int]:
    """Make the run; return its outcome and its time steps in the passage of an element."""
    if how.treatment in SCHEMES:
        spec = replace(spec, scheme=how.treatment)
    steps = fixed_steps(blade, spec).steps_per_element * how.finer
    spec = with_steps(spec, steps)
    if how.treatment in SCHEMES:
        return run.simulate(blade, spec), steps
    step, damping = impact.time_step(blade, spec), spec.damping_ratio
    if how.treatment == "massless":
        rule = impact.massless_boundary(modes, damping, step, how.modes)
    elif how.treatment in STIFFNESSES:
        rule = impact.penalty(modes, damping, step, STIFFNESSES[how.treatment])
    else:
        kept = impact.first(modes, how.modes)
        rule = impact.moreau_jean(kept, damping, step, RESTITUTIONS[how.treatment])
    return impact.simulate(rule, blade, spec), steps
