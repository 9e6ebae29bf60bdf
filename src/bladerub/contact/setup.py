"""From blade and run to what the time loop works on."""

import math
from collections.abc import Callable
from types import ModuleType

import numba
import numpy as np
from numba.core.errors import NumbaError

from bladerub.blade.model import N_INTERFACE, ReducedBlade
from bladerub.contact.kernel import records
from bladerub.contact.kernel.free_flight import MOST_STEPS
from bladerub.contact.kernel.loop import Simulation
from bladerub.contact.laws import compile_error, element_parameters, module_for, module_of, motion
from bladerub.contact.modes import Modes, modes_at
from bladerub.contact.schemes import SCHEMES, Contact, Recurrence
from bladerub.contact.spec import PLASTIC, ElementLaw, RunSpec
from bladerub.contact.start import ALONE, Seat, deflect, force_direction, stator_record, tip_record
from bladerub.contact.steps import own_steps, steps_per_element, with_steps
from bladerub.contact.strips import element_area, element_passage
from bladerub.contact.tip import edge
from bladerub.numerics.lanes import lanes_for


def set_up(
    blade: ReducedBlade, spec: RunSpec, modes: Modes | None = None, seat: Seat = ALONE
) -> tuple[Recurrence, Simulation]:
    """Prepare a run from rest, perhaps by other `modes` than those at its speed; raises as `simulate`."""
    modes = modes or modes_at(blade, spec.f_omega, spec)
    coating, law = spec.coating, module_of(spec.coating.element_law)
    contact, passage = _contact(blade, spec), element_passage(blade, spec)
    n_steps = _n_steps(modes, contact, blade, spec)
    rule = SCHEMES[spec.scheme](modes, spec.damping_ratio, passage / n_steps, contact)
    tip = tip_record(blade, spec, seat)
    stator = stator_record(blade, spec, rule, seat)
    kernel = _kernel(modes.n_nodes, coating.element_law, spec.turns)
    state = kernel("records").at_rest(rule.omega.size, coating.n_elements)
    deflect(state, modes, rule, spec, tip)
    state = state._replace(**seat.coating)
    slope = tip.search_range / float(np.min(tip.radius - tip.limit))
    leap = n_steps // math.ceil(n_steps / MOST_STEPS)
    flight = kernel("free_flight").free_flight(rule, leap, slope, edge(tip))
    layer = None
    if hasattr(law, "Layer"):
        area = records.by_lane(element_area(blade, spec), modes.n_nodes)
        layer = law.Layer(law, coating, area, passage * coating.n_elements)
    simulation = kernel("loop").Simulation
    return rule, simulation(kernel("modal").pack(rule), flight, stator, tip, state, n_steps, layer)


def compile_kernel(tip_turns: bool = False, n_nodes: int = N_INTERFACE, law: ElementLaw = PLASTIC) -> None:
    """Compile the time loop, so that its machine code is on disk before runs start.

    That for profiles that turn is another one, that for a tip with more than eight nodes, and that for
    another law of the elements. Raises `BadInput` if that law cannot be compiled.
    """
    loop = _kernel(n_nodes, law, tip_turns)("loop")
    example = {np.ndarray: 0, int: 0, float: 0.0, bool: False}  # an array is read by its address
    kinds = loop.Modal, loop.FreeFlight, records.Stator, records.Tip, loop.State
    parts = (kind(*map(example.get, kind.__annotations__.values())) for kind in kinds)
    arguments = loop.Records(*parts), 1, 0, 1, False, 0.0, 0
    try:
        loop.integrate.compile(tuple(map(numba.typeof, arguments)))
    except NumbaError as error:
        if law == PLASTIC:
            raise
        raise compile_error(law, error) from error


def _kernel(n_nodes: int, law: ElementLaw, turns: bool) -> Callable[[str], ModuleType]:
    """Return what gives the modules of `bladerub.contact.kernel` for such a tip and law, by name."""
    return lambda name: module_for(lanes_for(n_nodes), f"contact.kernel.{name}", law, turns)


def time_step(blade: ReducedBlade, spec: RunSpec) -> float:
    """Time step of the run, s: what a whole number of makes the passage of an element."""
    return element_passage(blade, spec) / fixed_steps(blade, spec).steps_per_element


def fixed_steps(blade: ReducedBlade, spec: RunSpec) -> RunSpec:
    """Return the run with the steps per element that it takes as its own; raises as `modes_at`."""
    modes, contact = modes_at(blade, spec.f_omega, spec), _contact(blade, spec)
    return with_steps(spec, _n_steps(modes, contact, blade, spec))


def _contact(blade: ReducedBlade, spec: RunSpec) -> Contact:
    element = np.full(blade.n_interface, np.inf)
    if not spec.coating.is_rigid:
        row = module_of(spec.coating.element_law).Element._fields.index("elastic")
        element = element_parameters(spec.coating, element_area(blade, spec))[row]
    stiffness = element * 2 * spec.tip.half_width  # the shares under the tip add up to its width
    if spec.turns:
        stiffness = np.concatenate([stiffness, motion().stiffness(element, spec.tip)])
    return Contact(stiffness, *force_direction(spec.coating))


def _n_steps(modes: Modes, contact: Contact, blade: ReducedBlade, spec: RunSpec) -> int:
    passage = element_passage(blade, spec)
    return own_steps(passage, spec.steps_per_element, spec.max_time_step) or steps_per_element(
        spec, modes, contact, passage, _depends_on_rate(blade, spec)
    )


def _depends_on_rate(blade: ReducedBlade, spec: RunSpec) -> bool:
    """Whether the time step changes what the law of the elements does."""
    if spec.coating.is_rigid:
        return False
    area = element_area(blade, spec)
    at_rest, fast = (element_parameters(spec.coating, area, h) for h in (math.inf, 1e-6))
    return not np.array_equal(at_rest, fast)
