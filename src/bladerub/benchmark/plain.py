"""The time loop written plainly with NumPy, for the exponential scheme and abradable coatings.

What `bladerub.contact.kernel.loop` computes, but for the energy ledger and the search for forces node by
node, which no run of the study needs: modes, tip and contact forces a step at a time, in whole arrays of
modes, nodes and bars. It runs as it stands, and compiled by numba.
"""

from __future__ import annotations

import numpy as np

from bladerub.contact.kernel.loop import ATTEMPTS, SETTLED, Rub
from bladerub.contact.schemes import Recurrence


def arguments(rule: Recurrence, rub: Rub) -> tuple:
    """Take from a run what `march` wants, copying what it changes."""
    stator, tip = rub.stator, rub.tip
    n = rule.omega.size
    return (
        (rule.now, rule.before, rule.tip * rule.gain, np.ascontiguousarray(rule.tip), rule.compliance),
        (stator.elastic, stator.hardening, stator.strength, stator.own_compliance),
        (tip.start, tip.per_metre, tip.radius),
        (tip.half_width, tip.drop, tip.limit, stator.radial, stator.tangential),
        stator.gap,
        stator.floor,
        rub.state.wear.copy(),
        rub.state.q[:, :n].copy(),
        rub.steps_per_element,
    )


def march(modes, bars, nodes, numbers, gap, floor, wear, q, steps_per_element, displacement):
    """March the run by as many steps as `displacement` (n,) takes, that of node 1, m; `wear` is moved on."""
    now, before, push, tip, compliance = modes
    elastic, hardening, strength, own = bars
    start, per_metre, radius = nodes
    half_width, drop, limit, direction_radial, direction_tangential = numbers
    force = np.zeros(16)
    n_elements = len(gap)
    for step in range(displacement.size):
        q_next = now * q[0] - before * q[1] + force @ push
        q[2], q[1] = q[1], q[0]
        q[0] = q_next
        u = tip @ q_next
        passed = (step + 1) / steps_per_element % n_elements
        rise = np.sqrt((radius + u[:8]) ** 2 + u[8:] ** 2) - radius
        if force.any() or rise.max() > floor[step // steps_per_element % n_elements]:
            free = u
            u = free + force @ compliance
            rise = np.sqrt((radius + u[:8]) ** 2 + u[8:] ** 2) - radius
            for _ in range(ATTEMPTS):
                position = start + passed + u[8:] * per_metre
                first = int(np.floor(position.min() - half_width))
                rows = np.arange(first, int(np.floor(position.max() + half_width)) + 1)
                offset = (rows + 0.5).reshape(-1, 1) - position
                share = np.minimum(np.maximum(half_width + 0.5 - np.abs(offset), 0.0), 1.0)
                worn = wear[rows % n_elements]
                surface = drop * offset**2 + gap[rows % n_elements] + worn
                trial = elastic * (rise - surface)
                excess = np.maximum(trial - strength - hardening * worn, 0.0)
                shortening = np.where((share > 0) & (trial > 0), excess / (elastic + hardening), 0.0)
                met = np.sum(share * np.maximum(trial - elastic * shortening, 0.0), axis=0)
                slope = np.where(excess > 0, elastic * hardening / (elastic + hardening), elastic)
                stiffness = np.sum(share * np.where(trial > 0, slope, 0.0), axis=0)
                along = radius + u[:8]
                unit = met / np.sqrt(along**2 + u[8:] ** 2)
                force = np.concatenate(
                    (
                        unit * (direction_radial * along - direction_tangential * u[8:]),
                        unit * (direction_radial * u[8:] + direction_tangential * along),
                    )
                )
                u = free + force @ compliance
                error = rise - np.sqrt((radius + u[:8]) ** 2 + u[8:] ** 2) + radius
                if np.abs(error).max() <= SETTLED:
                    break
                rise = rise - error / (1.0 + own * stiffness)
            wear[rows % n_elements] = worn + shortening
            if np.abs(u).max() > limit:
                break
        displacement[step] = u[0]
