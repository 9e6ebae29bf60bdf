"""The time loop written plainly with NumPy, for the exponential scheme and abradable coatings.

What `bladerub.contact.kernel.loop` computes, but for the energy ledger and the search for forces node by
node, which no run of the study needs: modes, tip and contact forces a step at a time, in whole arrays of
modes, nodes and elements. It runs in Python, and compiled by numba.
"""

from collections.abc import Callable
from functools import cache, partial

import numpy as np

from bladerub.contact.kernel.loop import Simulation
from bladerub.contact.kernel.newton import MAX_ITERATIONS, TOLERANCE
from bladerub.contact.kernel.records import by_lane
from bladerub.contact.laws import module_of
from bladerub.contact.schemes import Recurrence
from bladerub.contact.spec import ElementLaw
from bladerub.contact.tip import coverage, relief


def arguments(law: ElementLaw, rule: Recurrence, simulation: Simulation) -> tuple:
    """Take from a run what `integrate` needs, copying what it changes."""
    lanes = partial(by_lane, n_nodes=rule.n_nodes)
    to_tip, compliance = lanes(rule.tip), lanes(np.transpose(lanes(rule.compliance)))
    modes = rule.now, rule.before, to_tip * rule.gain, to_tip, compliance
    wear, q = simulation.state.wear.copy(), simulation.state.q[:, : rule.omega.size].copy()
    stator = simulation.stator
    element = module_of(law).Element(*stator.law)
    return modes, element, stator, simulation.tip, wear, q, simulation.steps_per_element


@cache
def integrator(element_law: ElementLaw) -> Callable:
    """Return the loop for a law of the elements: a function of `arguments` and ``displacement``."""
    law = module_of(element_law)

    def integrate(modes, element, stator, tip, wear, q, steps_per_element, displacement):
        """Make as many steps as `displacement` (n,) takes, that of node 1, m; `wear` is changed in place."""
        coefficient, coefficient_before, by_force, to_tip, compliance = modes
        normal_factor, tangential_factor = stator.normal_factor, stator.tangential_factor
        gap, n_elements, radius = stator.initial_gap, stator.n_elements, tip.radius
        n = radius.size
        force = np.zeros(2 * n)
        for step in range(displacement.size):
            q_next = coefficient * q[0] - coefficient_before * q[1] + force @ by_force
            q[2], q[1] = q[1], q[0]
            q[0] = q_next
            u = to_tip @ q_next
            travel = (step + 1) / steps_per_element % n_elements
            approach = np.sqrt((radius + u[:n]) ** 2 + u[n:] ** 2) - radius
            if force.any() or approach.max() > stator.minimum_gap[step // steps_per_element % n_elements]:
                free = u
                u = free + force @ compliance
                approach = np.sqrt((radius + u[:n]) ** 2 + u[n:] ** 2) - radius
                for _ in range(MAX_ITERATIONS):
                    position = tip.start + travel + u[n:] * tip.per_metre
                    first = int(np.floor(position.min() - tip.half_width))
                    rows = np.arange(first, int(np.floor(position.max() + tip.half_width)) + 1)
                    offset = (rows + 0.5).reshape(-1, 1) - position
                    share = coverage(tip, offset)
                    worn = wear[rows % n_elements]
                    depth = approach - relief(tip, offset) - gap[rows % n_elements] - worn
                    element_force, increment = law.return_mapping(element, depth, worn)
                    slope, _ = law.tangent(element, depth, worn)
                    normal_force = np.sum(share * element_force, axis=0)
                    stiffness = np.sum(share * slope, axis=0)
                    outward = radius + u[:n]
                    unit = normal_force / np.sqrt(outward**2 + u[n:] ** 2)
                    force = np.concatenate(
                        (
                            unit * (normal_factor * outward - tangential_factor * u[n:]),
                            unit * (normal_factor * u[n:] + tangential_factor * outward),
                        )
                    )
                    u = free + force @ compliance
                    residual = approach - np.sqrt((radius + u[:n]) ** 2 + u[n:] ** 2) + radius
                    if np.abs(residual).max() <= TOLERANCE:
                        break
                    approach = approach - residual / (1.0 + stator.self_compliance * stiffness)
                wear[rows % n_elements] = worn + np.where(share > 0, increment, 0.0)
                if np.abs(u).max() > tip.limit:
                    break
            displacement[step] = u[0]

    return integrate
