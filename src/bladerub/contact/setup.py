"""From blade and run to what the time loop works on."""

import math
from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from types import ModuleType
from typing import NamedTuple

import numpy as np
from numba.core.errors import NumbaError

from bladerub.blade.model import N_INTERFACE, ReducedBlade
from bladerub.contact import casing
from bladerub.contact.kernel import records
from bladerub.contact.kernel.free_flight import MOST_STEPS
from bladerub.contact.kernel.loop import Simulation
from bladerub.contact.laws import element_parameters, module_for, module_of
from bladerub.contact.modes import Modes, modes_at, tip_radii
from bladerub.contact.motion import motion
from bladerub.contact.schemes import SCHEMES, Contact, Recurrence, normal_compliance
from bladerub.contact.spec import PLASTIC, Casing, Coating, ElementLaw, RunSpec
from bladerub.contact.steps import own_steps, steps_per_element, with_steps
from bladerub.contact.tip import edge
from bladerub.io.errors import BadInput
from bladerub.numerics.lanes import lanes_for
from bladerub.numerics.machine_code import innermost
from bladerub.numerics.memory import aligned

_NEVER = 1.0  # gap of a lane without a node, m: nothing moves so far

_WRITTEN_IN = (
    "its functions are marked elementwise, and written with + - * / > <= and where, maximum, minimum, "
    "absolute and sqrt of bladerub.numerics.vectors"
)

SEARCH_RANGE = 4
"""Elements a node may move along the casing before the search for contact looks at it alone."""


class Seat(NamedTuple):
    """Where a blade is on the disk, and what it meets there."""

    ahead: float = 0.0  # Angle ahead of where a run starts, elements; whole ones are not counted
    longer: float = 0.0  # Tip radius beyond the nominal one, m
    coating: Mapping[str, np.ndarray] = {}  # `records.COATING` of a state, where blades share it


ALONE = Seat()


def set_up(blade: ReducedBlade, spec: RunSpec) -> tuple[Recurrence, Simulation]:
    """Prepare a run from rest; raises `ValueError` as `bladerub.contact.run.simulate`."""
    return set_up_modes(modes_at(blade, spec.f_omega, spec), blade, spec)


def set_up_modes(
    modes: Modes, blade: ReducedBlade, spec: RunSpec, seat: Seat = ALONE
) -> tuple[Recurrence, Simulation]:
    """Prepare a run as `set_up`, with the modes at its speed."""
    coating, law = spec.coating, module_of(spec.coating.element_law)
    contact, passage = _contact(blade, spec), element_passage(blade, spec)
    n_steps = _n_steps(modes, contact, blade, spec)
    rule = SCHEMES[spec.scheme](modes, spec.damping_ratio, passage / n_steps, contact)
    tip = tip_record(blade, spec, seat)
    stator = stator_record(blade, spec, rule, seat)
    kernel = _kernel(modes.n_nodes, coating.element_law, spec.turns)
    state = kernel("records").at_rest(rule.omega.size, coating.n_elements, _kept_by(law))
    _deflect(state, modes, rule, spec, tip)
    state = state._replace(**seat.coating)
    slope = tip.search_range / float(np.min(tip.radius - tip.limit))
    leap = n_steps // math.ceil(n_steps / MOST_STEPS)
    flight = kernel("free_flight").free_flight(rule, leap, slope, edge(tip))
    layer = None
    if hasattr(law, "Layer"):
        area = _by_lane_of(blade)(element_area(blade, spec))
        layer = law.Layer(law, coating, area, passage * coating.n_elements)
    simulation = kernel("loop").Simulation
    return rule, simulation(kernel("modal").pack(rule), flight, stator, tip, state, n_steps, layer)


def compile_kernel(tip_turns: bool = False, n_nodes: int = N_INTERFACE, law: ElementLaw = PLASTIC) -> None:
    """Compile the time loop, so that its machine code is on disk before runs start.

    That for profiles that turn is another one, that for a tip with more than eight nodes, and that for
    another law of the elements. Raises `BadInput` if that law cannot be compiled.
    """
    modes = Modes(np.ones(1), np.zeros(((3 if tip_turns else 2) * n_nodes, 1)), n_nodes)
    lanes = lanes_for(n_nodes)
    zeros = np.zeros(lanes)
    stiffness = np.ones(len(modes.tip) - n_nodes)
    rule = SCHEMES["exponential"](modes, 0.0, 1e-6, Contact(stiffness, -1.0, 0.0))
    gap, elements = np.ones((8, lanes)), np.ones((len(module_of(law).Element._fields), lanes))
    turning = zeros if tip_turns else np.empty(0)
    stator = records.Stator(gap, gap[:, 0].copy(), elements, 8, False, -1.0, 0.0, zeros, False, turning)
    tip = records.Tip(zeros, zeros, zeros + 1.0, zeros + 1.0, 2.0, 0.0, 0.0, 1.0)
    kernel = _kernel(n_nodes, law, tip_turns)
    flight = kernel("free_flight").free_flight(rule, 1, 0.0, 0.0)
    state = kernel("records").at_rest(1, 8, _kept_by(module_of(law)))
    modal, simulation = kernel("modal").pack(rule), kernel("loop").Simulation
    try:
        simulation(modal, flight, aligned(stator), aligned(tip), state, 1).advance(np.zeros(8))
    except NumbaError as error:
        if law == PLASTIC:
            raise
        raise BadInput(f"law {law.label}: cannot be compiled ({innermost(error)}); {_WRITTEN_IN}") from error


def _kernel(n_nodes: int, law: ElementLaw, turns: bool) -> Callable[[str], ModuleType]:
    """Return what gives the modules of `bladerub.contact.kernel` for such a tip and law, by name."""
    return lambda name: module_for(lanes_for(n_nodes), f"contact.kernel.{name}", law, turns)


def _kept_by(law: ModuleType) -> int:
    """Numbers that the layer of a law keeps of each element."""
    return law.Layer.numbers if hasattr(law, "Layer") else 0


def element_angle(n_elements: int) -> np.ndarray:
    """Casing angle (N,) of the element centres, rad."""
    return (np.arange(n_elements) + 0.5) * (2 * np.pi / n_elements)


def element_passage(blade: ReducedBlade, spec: RunSpec) -> float:
    """Time in which one coating element passes, s."""
    return 1.0 / (spec.f_omega * blade.f1_hz * spec.coating.n_elements)


def time_step(blade: ReducedBlade, spec: RunSpec) -> float:
    """Time step of the run, s: what a whole number of makes the passage of an element."""
    return element_passage(blade, spec) / fixed_steps(blade, spec).steps_per_element


def fixed_steps(blade: ReducedBlade, spec: RunSpec) -> RunSpec:
    """Return the run with the steps per element that it takes as its own; raises as `modes_at`."""
    modes, contact = modes_at(blade, spec.f_omega, spec), _contact(blade, spec)
    return with_steps(spec, _n_steps(modes, contact, blade, spec))


def element_area(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    """Area (8,) of one element under each node, m²."""
    radius, _ = tip_radii(blade)
    return strip_width(blade) * 2 * np.pi * radius / spec.coating.n_elements


def running_clearance(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    """Clearance (8,) of each interface node, linear along the chord, m."""
    x, (leading, trailing) = blade.node_position[:, 0], spec.clearance
    return leading + (trailing - leading) * ((x - x[0]) / (x[-1] - x[0]))


def strip_width(blade: ReducedBlade) -> np.ndarray:
    """Axial width (8,) of the coating strip under each interface node, m: its share of the axial chord."""
    x = blade.node_position[:, 0]
    middle = np.concatenate([x[:1], (x[1:] + x[:-1]) / 2, x[-1:]])
    return np.abs(np.diff(middle))


def by_angle(blade: ReducedBlade, spec: RunSpec, rows: np.ndarray) -> np.ndarray:
    """Bring (N, lanes) rows of elements into the order (j, N) of the angle, for the j nodes."""
    first = _first_element(blade, spec)
    return np.array([np.roll(of_node, shift) for of_node, shift in zip(rows.T, first, strict=False)])


def stator_record(blade: ReducedBlade, spec: RunSpec, rule: Recurrence, seat: Seat = ALONE) -> records.Stator:
    """Describe coating and casing for the time loop, in rows of elements."""
    coating = spec.coating
    normal_factor, tangential_factor = _force_direction(coating)
    compliances = np.split(_self_compliance(rule, coating), [blade.n_interface])
    by_lane = _by_lane_of(blade)
    area = by_lane(element_area(blade, spec))
    if coating.is_rigid:
        parameters = np.zeros((len(module_of(coating.element_law).Element._fields), area.size))
    else:
        parameters = element_parameters(coating, area, rule.time_step)
    clearance = tuple(running_clearance(blade, spec).tolist())
    first, width = tuple(_first_element(blade, spec).tolist()), spec.tip.half_width + seat.ahead
    gap, lowest = _gaps(spec.casing, clearance, seat.longer, first, coating.n_elements, width, area.size)
    stator = records.Stator(
        initial_gap=gap,
        minimum_gap=lowest,
        law=parameters,
        n_elements=coating.n_elements,
        is_rigid=coating.is_rigid,
        normal_factor=normal_factor,
        tangential_factor=tangential_factor,
        self_compliance=by_lane(compliances[0]),
        coulomb=coating.coulomb,
        further_compliance=by_lane(compliances[1]) if compliances[1].size else compliances[1],
    )
    return aligned(stator)


@lru_cache(maxsize=32)  # the runs of a coating, and of most studies, have the same
def _gaps(
    shape: Casing,
    clearance: tuple[float, ...],
    longer: float,
    first: tuple[int, ...],
    n_elements: int,
    half_width: float,
    lanes: int,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the gaps of `records.Stator`."""
    gap = casing.gap(shape, np.array(clearance)[:, None], element_angle(n_elements)) - longer
    rows = np.array([np.roll(of_node, -shift) for of_node, shift in zip(gap, first, strict=True)])
    unused = np.full((n_elements, lanes - len(rows)), _NEVER)
    return np.hstack([rows.T, unused]), minimum_gap(rows, half_width)


def minimum_gap(rows: np.ndarray, half_width: float) -> np.ndarray:
    """Smallest gap (N,) that any node may meet in the passage of an element, from the gaps (8, N) in rows."""
    reach = half_width + 1 + SEARCH_RANGE + 1  # + 1 each: a node stands anywhere within an element
    half = math.ceil(reach)
    around = np.pad(rows.min(axis=0), half, mode="wrap")
    return np.lib.stride_tricks.sliding_window_view(around, 2 * half + 1).min(axis=1)


def tip_record(blade: ReducedBlade, spec: RunSpec, seat: Seat = ALONE) -> records.Tip:
    """Describe the blade tip for the time loop."""
    n_elements = spec.coating.n_elements
    radius, curvature_radius = tip_radii(blade)
    per_metre = n_elements / (2 * np.pi * radius)
    _check_reach(curvature_radius, per_metre, spec)
    by_lane = _by_lane_of(blade)
    tip = records.Tip(
        start=by_lane(_start_position(blade, spec) % 1.0 + seat.ahead),
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


def _contact(blade: ReducedBlade, spec: RunSpec) -> Contact:
    element = np.full(blade.n_interface, np.inf)
    if not spec.coating.is_rigid:
        row = module_of(spec.coating.element_law).Element._fields.index("elastic")
        element = element_parameters(spec.coating, element_area(blade, spec))[row]
    stiffness = element * 2 * spec.tip.half_width  # the shares under the tip add up to its width
    if spec.turns:
        stiffness = np.concatenate([stiffness, motion().stiffness(element, spec.tip)])
    return Contact(stiffness, *_force_direction(spec.coating))


def _n_steps(modes: Modes, contact: Contact, blade: ReducedBlade, spec: RunSpec) -> int:
    passage = element_passage(blade, spec)
    return own_steps(passage, spec.steps_per_element, spec.max_time_step) or steps_per_element(
        spec, modes, contact, passage, _law_order(blade, spec)
    )


def _law_order(blade: ReducedBlade, spec: RunSpec) -> int:
    """Order of the law in the time step: 1 where it depends on the rate, by backward Euler."""
    if spec.coating.is_rigid:
        return 2
    area = element_area(blade, spec)
    at_rest, fast = (element_parameters(spec.coating, area, h) for h in (math.inf, 1e-6))
    return 2 if np.array_equal(at_rest, fast) else 1


def _force_direction(coating: Coating) -> tuple[float, float]:
    """Direction of the contact force on the blade: −cos θ and −sin θ."""
    return -math.cos(coating.theta), -math.sin(coating.theta)


def _by_lane_of(blade: ReducedBlade) -> Callable[[np.ndarray], np.ndarray]:
    """Return `records.by_lane` for numbers of the nodes of `blade`."""
    record_module = module_for(lanes_for(blade.n_interface), "contact.kernel.records")
    return partial(record_module.by_lane, n_nodes=blade.n_interface)


def _deflect(state: records.State, modes: Modes, rule: Recurrence, spec: RunSpec, tip: records.Tip) -> None:
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


def _self_compliance(rule: Recurrence, coating: Coating) -> np.ndarray:
    normal_factor, tangential_factor = _force_direction(coating)
    matrix, n = rule.compliance, rule.n_nodes
    forward = np.diag(normal_compliance(matrix, n, normal_factor, tangential_factor))
    backward = np.diag(normal_compliance(matrix, n, normal_factor, -tangential_factor))
    if coating.is_rigid and min(np.min(forward), np.min(backward)) <= 0:
        raise ValueError(
            f"friction {math.tan(coating.theta):g} on the rigid casing: must be so low that no node of this "
            "blade is drawn into the casing by its own friction (Painlevé's paradox)"
        )
    return np.maximum(forward, 0.0)


def _start_position(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    """Position (8,) of each node at the start of a revolution, in elements, within [0, N)."""
    angle = spec.casing.start_angle + np.arctan2(blade.node_position[:, 1], blade.node_position[:, 2])
    n_elements = spec.coating.n_elements
    return angle / (2 * np.pi) * n_elements % n_elements


def _first_element(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    """Element (8,) that each node stands over at the start of a revolution: the first row."""
    return _start_position(blade, spec).astype(int)
