"""From blade and run to the record of the tip for the time loop, and to where the tip starts."""

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import NamedTuple

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.kernel import records
from bladerub.contact.laws import module_for
from bladerub.contact.modes import Modes, tip_radii
from bladerub.contact.schemes import Recurrence
from bladerub.contact.spec import RunSpec
from bladerub.contact.strips import start_position
from bladerub.numerics.lanes import lanes_for
from bladerub.numerics.memory import aligned

SEARCH_RANGE = 4
"""Elements a node may move along the casing before the search for contact looks at it alone."""


class Seat(NamedTuple):
    """Where a blade is on the disk, and what it meets there."""

    ahead: float = 0.0  # Angle ahead of where a run starts, elements; whole ones are not counted
    longer: float = 0.0  # Tip radius beyond the nominal one, m
    coating: Mapping[str, np.ndarray] = {}  # `records.COATING` of a state, where blades share it


ALONE = Seat()


def by_lane_of(blade: ReducedBlade) -> Callable[[np.ndarray], np.ndarray]:
    """Return `records.by_lane` for numbers of the nodes of `blade`."""
    record_module = module_for(lanes_for(blade.n_interface), "contact.kernel.records")
    return partial(record_module.by_lane, n_nodes=blade.n_interface)


def tip_record(blade: ReducedBlade, spec: RunSpec, seat: Seat = ALONE) -> records.Tip:
    """Describe the blade tip for the time loop."""
    n_elements = spec.coating.n_elements
    radius, curvature_radius = tip_radii(blade)
    per_metre = n_elements / (2 * np.pi * radius)
    _check_reach(curvature_radius, per_metre, spec)
    by_lane = by_lane_of(blade)
    tip = records.Tip(
        start=by_lane(start_position(blade, spec) % 1.0 + seat.ahead),
        per_metre=by_lane(per_metre),
        radius=by_lane(curvature_radius),
        lever=by_lane(radius),
        half_width=spec.tip.half_width,
        curvature=spec.tip.curvature,
        search_range=SEARCH_RANGE / float(np.max(per_metre)),
        limit=spec.displacement_limit,
    )
    return aligned(tip)


def _check_reach(radius: np.ndarray, per_metre: np.ndarray, spec: RunSpec) -> None:
    """Check that no node leaves the displacement limit and the turn of elements that the loop wraps.

    Two ends of a step may be at both limits, so that the rows between them, each under a profile that stands
    anywhere within two elements, must be different ones: then indices are within (−N, 2 N).
    """
    limit, n_elements = spec.displacement_limit, spec.coating.n_elements
    width = max(spec.tip.half_width, 1.0)  # the rigid casing is read one row around a node
    with np.errstate(invalid="ignore"):
        reach = np.maximum(limit * per_metre, SEARCH_RANGE)
        wrong = ~((2 * (reach + width) + 4 <= n_elements) & (limit < radius))
    if wrong.any():
        node = int(wrong.argmax())
        around = n_elements / per_metre[node]
        raise ValueError(
            f"the displacement limit is {limit:.4g} m, and the circle of interface node {node + 1} of the "
            f"blade {around:.3g} m ({n_elements} coating elements): limit and half width of the tip profile "
            f"({spec.tip.half_width:g} elements) must be within half of it, and the limit below its radius; "
            "check the unit and the axis of the blade, or lower solver.displacement_limit"
        )


def deflect(state: records.State, modes: Modes, rule: Recurrence, spec: RunSpec, tip: records.Tip) -> None:
    """Deflect a blade in the first mode; the step before is the exact free motion back from there."""
    if not spec.initial_displacement:
        return
    x, damping, n = rule.omega[0] * rule.time_step, spec.damping_ratio, rule.omega.size
    damped = math.sqrt(1.0 - damping**2)
    back = math.exp(damping * x) * (math.cos(damped * x) - damping / damped * math.sin(damped * x))
    state.q[:, 0] = np.array([1.0, back, back]) * spec.initial_displacement / modes.tip[0, 0]
    record_module = module_for(lanes_for(rule.n_nodes), "contact.kernel.records")
    displacement = state.q[:, :n] @ record_module.by_lane(rule.tip, rule.n_nodes).T
    radial, tangential, *further = np.moveaxis(displacement.reshape(3, -1, tip.radius.size), 1, 0)
    approach = np.hypot(tip.radius + radial, tangential) - tip.radius
    if not max(np.abs(radial).max(), np.abs(tangential).max()) <= tip.limit:
        raise ValueError(
            f"initial_displacement = {spec.initial_displacement:g} m: moves a node of the tip beyond the "
            f"displacement limit, {tip.limit:g} m"
        )
    moved = np.concatenate([radial, tangential, approach, *further], axis=1)
    state.u[:, : moved.shape[1]] = moved
