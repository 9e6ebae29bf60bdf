"""From blade and run to the records that the time loop works on, and to where the tip starts."""

import math
from collections.abc import Mapping
from functools import partial
from typing import NamedTuple

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact import casing
from bladerub.contact.kernel import records
from bladerub.contact.laws import element_parameters, module_of
from bladerub.contact.modes import Modes, tip_radii
from bladerub.contact.schemes import Recurrence, normal_compliance
from bladerub.contact.spec import Coating, RunSpec
from bladerub.contact.strips import element_angle, element_area, running_clearance, start_position
from bladerub.numerics.memory import aligned

SEARCH_RANGE = 4  # elements a node may move along the casing before the search for contact looks at it alone

_NEVER = 1.0  # gap of a lane without a node, m: nothing moves so far


class Seat(NamedTuple):
    """Where a blade is on the disk, and what it meets there."""

    ahead: float = 0.0  # Angle ahead of where a run starts, elements; whole ones are not counted
    longer: float = 0.0  # Tip radius beyond the nominal one, m
    coating: Mapping[str, np.ndarray] = {}  # `records.COATING` of a state, where blades share it


ALONE = Seat()


def tip_record(blade: ReducedBlade, spec: RunSpec, seat: Seat = ALONE) -> records.Tip:
    """Describe the blade tip for the time loop."""
    n_elements = spec.coating.n_elements
    radius, curvature_radius = tip_radii(blade)
    per_metre = n_elements / (2 * np.pi * radius)
    _check_reach(curvature_radius, per_metre, spec)
    by_lane = partial(records.by_lane, n_nodes=blade.n_interface)
    tip = records.Tip(
        start=by_lane(start_position(blade, spec) % 1.0 + seat.ahead),
        per_metre=by_lane(per_metre),
        radius=by_lane(curvature_radius),
        lever=by_lane(radius),
        half_width=spec.tip.half_width,
        curvature=spec.tip.curvature,
        search_range=min(SEARCH_RANGE / float(np.max(per_metre)), spec.displacement_limit),
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


def stator_record(blade: ReducedBlade, spec: RunSpec, rule: Recurrence, seat: Seat = ALONE) -> records.Stator:
    """Describe coating and casing for the time loop, in rows of elements."""
    coating = spec.coating
    normal_factor, tangential_factor = force_direction(coating)
    by_lane = partial(records.by_lane, n_nodes=blade.n_interface)
    self_compliance, further = map(by_lane, np.split(_self_compliance(rule, coating), [blade.n_interface]))
    area = by_lane(element_area(blade, spec))
    if coating.is_rigid:
        parameters = np.zeros((len(module_of(coating.element_law).Element._fields), area.size))
    else:
        parameters = element_parameters(coating, area, rule.time_step)
    clearance, angle = running_clearance(blade, spec)[:, None], element_angle(coating.n_elements)
    gap, first = casing.gap(spec.casing, clearance, angle) - seat.longer, start_position(blade, spec)
    rows = np.array([np.roll(of_node, -int(shift)) for of_node, shift in zip(gap, first, strict=True)])
    unused = np.full((coating.n_elements, area.size - len(rows)), _NEVER)
    stator = records.Stator(
        initial_gap=np.hstack([rows.T, unused]),
        minimum_gap=minimum_gap(rows, spec.tip.half_width + seat.ahead),
        law=parameters,
        n_elements=coating.n_elements,
        is_rigid=coating.is_rigid,
        normal_factor=normal_factor,
        tangential_factor=tangential_factor,
        self_compliance=self_compliance,
        coulomb=coating.coulomb,
        further_compliance=further,
    )
    return aligned(stator)


def minimum_gap(rows: np.ndarray, half_width: float) -> np.ndarray:
    """Smallest gap (N,) that any node may meet in the passage of an element, from the gaps (j, N) in rows."""
    reach = half_width + 1 + SEARCH_RANGE + 1  # + 1 each: a node stands anywhere within an element
    half = math.ceil(reach)
    around = np.pad(rows.min(axis=0), half, mode="wrap")
    return np.lib.stride_tricks.sliding_window_view(around, 2 * half + 1).min(axis=1)


def _self_compliance(rule: Recurrence, coating: Coating) -> np.ndarray:
    normal_factor, tangential_factor = force_direction(coating)
    matrix, n = rule.compliance, rule.n_nodes
    forward = np.diag(normal_compliance(matrix, n, normal_factor, tangential_factor))
    backward = np.diag(normal_compliance(matrix, n, normal_factor, -tangential_factor))
    if coating.is_rigid and min(np.min(forward), np.min(backward)) <= 0:
        raise ValueError(
            f"friction {math.tan(coating.theta):g} on the rigid casing: must be so low that no node of this "
            "blade is drawn into the casing by its own friction (Painlevé's paradox)"
        )
    return np.maximum(forward, 0.0)


def force_direction(coating: Coating) -> tuple[float, float]:
    """Direction of the contact force on the blade: −cos θ and −sin θ."""
    return -math.cos(coating.theta), -math.sin(coating.theta)


def deflect(state: records.State, modes: Modes, rule: Recurrence, spec: RunSpec, tip: records.Tip) -> None:
    """Deflect a blade in the first mode; the step before is the exact free motion back from there."""
    if not spec.initial_displacement:
        return
    x, damping, n = rule.omega[0] * rule.time_step, spec.damping_ratio, rule.omega.size
    damped = math.sqrt(1.0 - damping**2)
    back = math.exp(damping * x) * (math.cos(damped * x) - damping / damped * math.sin(damped * x))
    state.q[:, 0] = np.array([1.0, back, back]) * spec.initial_displacement / modes.tip[0, 0]
    displacement = state.q[:, :n] @ records.by_lane(rule.tip, rule.n_nodes).T
    radial, tangential, *_ = displacement.reshape(3, -1, tip.radius.size).swapaxes(0, 1)
    approach = np.hypot(tip.radius + radial, tangential) - tip.radius
    if not max(np.abs(radial).max(), np.abs(tangential).max()) <= tip.limit:
        raise ValueError(
            f"initial_displacement = {spec.initial_displacement:g} m: moves a node of the tip beyond the "
            f"displacement limit, {tip.limit:g} m"
        )
    state.u[:, : displacement.shape[1]] = displacement
    state.u[:, -tip.radius.size :] = approach
