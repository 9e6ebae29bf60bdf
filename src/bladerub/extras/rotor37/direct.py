"""Direct contact with the rigid casing at one speed, as in the open benchmarks of the literature.

Speed, damping, friction and gap are those of the example of blade and casing in NLstep (Monjaraz-Tec, Gross
and Krack, Computers and Structures 260, 2022, 106698), which follows Piollet, Nyssen and Batailly (J. Sound
Vib. 460, 2019, 114878): no centrifugal stiffening, 50 revolutions.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact.modes import modes_at
from bladerub.contact.result import RunResult
from bladerub.contact.run import simulate
from bladerub.contact.spec import RunSpec
from bladerub.extras.rotor37.numbers import of_direct_contact, of_displacement
from bladerub.extras.verification import impact
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec

SPEED = 1344.0  # rad/s; four times in a revolution is close to the first frequency
REVOLUTIONS = 50
FRICTION = (0.0, 0.15)
STEPS = 20  # time steps of `independent` in the passage of a coating element; half as many are tried as well


def unstiffened(blade: ReducedBlade) -> ReducedBlade:
    """Return the blade with the stiffness at rest, whatever the speed."""
    none = np.zeros_like(blade.mass)
    return replace(blade, stiffness_1=none, stiffness_2=none, stiffness_higher=())


def spec_of(config: Config, blade: ReducedBlade, friction: float) -> RunSpec:
    """Describe the run."""
    spec = run_spec(config, CoatingCase.rigid("bumps", friction), SPEED / (2 * np.pi * blade.f1_hz))
    return replace(spec, revolutions=REVOLUTIONS)


def runs(config: Config, blade: ReducedBlade) -> dict[str, RunResult]:
    """Simulate the cases, by name: with and without friction, and each with stiffening as well."""
    models = {"rest": unstiffened(blade), "stiffened": blade}
    return {
        f"{name}_mu{friction:g}": simulate(model, spec_of(config, blade, friction))
        for friction in FRICTION
        for name, model in models.items()
    }


def numbers(results: Mapping[str, RunResult]) -> pd.DataFrame:
    """Measure the results of `runs`."""
    measured = (of_direct_contact(name, result, REVOLUTIONS) for name, result in results.items())
    return pd.concat(measured, ignore_index=True)


def last_revolution(results: Mapping[str, RunResult]) -> pd.DataFrame:
    """Radial displacement of node 1 at 200 angles of the last revolution of each of `runs`."""
    parts = []
    for name, result in results.items():
        last = result.radial_displacement.reshape(REVOLUTIONS, -1)[-1]
        steps = np.arange(0, len(last), len(last) // 200)
        turned = (steps + 0.5) * 2 * np.pi / len(last)
        parts.append(pd.DataFrame({"case": name, "turned": turned, "radial_displacement": last[steps]}))
    return pd.concat(parts, ignore_index=True)


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def independent(config: Config, blade: ReducedBlade) -> pd.DataFrame:
    """Simulate the case without stiffening and friction by an integrator of its own: its `numbers`.

    That shares no code with the time loop (`bladerub.extras.verification.impact`): a massless boundary as in
    NLstep, Moreau's time stepping and stiff springs. ``modes`` are those that move.
    """
    model, spec = unstiffened(blade), spec_of(config, blade, 0.0)
    modes, damping = modes_at(model, spec.f_omega), spec.damping_ratio
    parts = []
    for steps in (STEPS // 2, STEPS):
        variant = replace(spec, steps_per_element=steps)
        step = impact.time_step(blade, variant)
        rules = {("massless", n): impact.massless_boundary(modes, damping, step, n) for n in (10, 20, 50)}
        rules["moreau_jean_0", modes.omega.size] = impact.moreau_jean(modes, damping, step, 0.0)
        rules["penalty_1e9", modes.omega.size] = impact.penalty(modes, damping, step, 1e9)
        for (treatment, n), rule in rules.items():
            result = impact.simulate(rule, model, variant)
            measures = of_displacement("rest_mu0", result.radial_displacement, REVOLUTIONS)
            parts.append(measures.assign(treatment=treatment, modes=n, steps=steps))
    columns = ["treatment", "modes", "steps", "number", "value", "unit"]
    return pd.concat(parts, ignore_index=True)[columns]
