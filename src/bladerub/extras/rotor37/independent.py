"""The direct contact of Rotor 37 by an integrator that shares no code with the time loop.

It has the mass and stiffness of the same reduced blade, and a massless boundary as the program of the example
(`bladerub.extras.verification.impact`); or Moreau's time stepping, or stiff springs. Without friction.
"""

from dataclasses import replace

import pandas as pd
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact.modes import modes_at
from bladerub.extras.rotor37 import direct
from bladerub.extras.rotor37.numbers import of_displacement
from bladerub.extras.verification import impact
from bladerub.settings.study import Config

STEPS = 20
"""Time steps in the passage of a coating element; half as many are tried as well."""

COLUMNS = ["treatment", "modes", "steps", "number", "value", "unit"]


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def table(config: Config, blade: ReducedBlade) -> pd.DataFrame:
    """Simulate the case without stiffening and friction: the numbers of `direct`, by each way to compute it.

    ``modes`` are those that move; the massless boundary has the others as static displacement.
    """
    model = direct.unstiffened(blade)
    spec = direct.spec_of(config, blade, 0.0)
    modes, damping = modes_at(model, spec.f_omega), spec.damping_ratio
    parts = []
    for steps in (STEPS // 2, STEPS):
        variant = replace(spec, steps_per_element=steps)
        step = impact.time_step(blade, variant)
        rules = {("massless", n): impact.massless_boundary(modes, damping, step, n) for n in (10, 20, 50)} | {
            ("moreau_jean_0", modes.omega.size): impact.moreau_jean(modes, damping, step, 0.0),
            ("penalty_1e9", modes.omega.size): impact.penalty(modes, damping, step, 1e9),
        }
        for (treatment, n), rule in rules.items():
            result = impact.simulate(rule, model, variant)
            numbers = of_displacement("rest_mu0", result.radial_displacement, direct.REVOLUTIONS)
            parts.append(numbers.assign(treatment=treatment, modes=n, steps=steps)[COLUMNS])
    return pd.concat(parts, ignore_index=True)
