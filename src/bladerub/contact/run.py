"""One run from rest: `RunSpec` → `RunResult`."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.ndimage import minimum_filter1d

from bladerub.blade.model import N_INTERFACE, ReducedBlade
from bladerub.contact import casing, energy, law
from bladerub.contact.integration import Part, march
from bladerub.contact.kernel import loop
from bladerub.contact.kernel.free_flight import LONGEST, Leap, leap_of
from bladerub.contact.kernel.modal import pack
from bladerub.contact.kernel.vectors import aligned
from bladerub.contact.modes import Modes, modes_at
from bladerub.contact.schemes import SCHEMES, Contact, Recurrence, normal_compliance
from bladerub.contact.spec import Coating, RunResult, RunSpec

STRAY = 4
"""Elements a node may move along the casing before the search for contact looks at it alone."""


def simulate(blade: ReducedBlade, spec: RunSpec, progress: Callable[[int], None] | None = None) -> RunResult:
    """Let the blade rub at one constant speed.

    1. Eq. (1) is solved in the modal coordinates of the reduced blade at this speed, with modal
       damping, by the scheme that the spec names (contract: `bladerub.contact.schemes`).
    2. The step is the largest one not above ``spec.max_time_step`` of which a whole number, and
       ``spec.steps_per_element`` at least, makes the passage of one coating element.
    3. Displacements are increments about the running position of the blade, and so are clearances.
    4. The contact force of a node is along the normal to the casing where the node is, turned by θ
       against the rotation, or by Coulomb's law against the sliding of the node
       (`bladerub.contact.friction`); tangential displacement is positive with the rotation.
    5. The blade starts at rest, deflected in its first mode where the spec says so.

    Parameters
    ----------
    blade : ReducedBlade
        The blade.
    spec : RunSpec
        Stator, speed and length of the run.
    progress : callable, optional
        Called with the number of revolutions done after each of them.

    Returns
    -------
    RunResult
        With ``status`` ``"completed"``, or ``"unbounded"`` when the tip left all bounds: what was
        computed until then is kept.

    Raises
    ------
    ValueError
        If the speed is outside the range of the blade, or the step too long for the scheme.
    """
    n_elements, revolutions = spec.coating.n_elements, spec.revolutions
    rule, rub = set_up(blade, spec)
    initial = sum(energy.blade_energy(rule, rub.state))
    whole = (Part(rub, revolution, 0, n_elements) for revolution in range(revolutions))
    track = march(whole, revolutions, n_elements, progress)
    status, message = track.verdict(spec.displacement_limit)
    return RunResult(
        status=status,
        message=message,
        angle=element_angle(n_elements),
        wear=by_angle(blade, spec, rub.state.wear),
        radial_displacement=track.displacement.ravel(),
        revolution_peak=track.peak,
        revolution_amplitude=track.amplitude,
        time_step=rule.time_step,
        n_steps=track.n_steps,
        n_contact_steps=track.n_contact_steps,
        n_reversed_steps=int(rub.state.ledger[energy.REVERSED, 0]),
        slowest_sliding=1.0 - float(rub.state.ledger[energy.RETREAT].max()) * rub.steps_per_element,
        n_modes=rule.omega.size,
        energy=energy.close(rule, rub.state, initial, rub.angle_per_step),
    )


def set_up(blade: ReducedBlade, spec: RunSpec) -> tuple[Recurrence, loop.Rub]:
    """Bring blade and run into the form of the time loop, at rest.

    Raises
    ------
    ValueError
        As `simulate`.
    """
    return set_up_modes(modes_at(blade, spec.f_omega), blade, spec)


def set_up_modes(modes: Modes, blade: ReducedBlade, spec: RunSpec) -> tuple[Recurrence, loop.Rub]:
    """Do as `set_up`, with the modes at this speed."""
    steps_per_element, time_step = _time_step(blade, spec)
    contact = Contact(
        _bar_stiffness(blade, spec) * 2 * spec.tip.half_width,  # the shares under the tip add up to its width
        -math.cos(spec.coating.theta),
        -math.sin(spec.coating.theta),
    )
    rule = SCHEMES[spec.scheme](modes, spec.damping_ratio, time_step, contact)
    tip = _tip(blade, spec)
    stator = _stator(blade, spec, tip, rule)
    flight = _flight(rule, tip, steps_per_element)
    start = _start(modes, rule, spec, tip)
    return rule, loop.Rub(pack(rule), flight, stator, tip, start, steps_per_element)


def kernel_warm_up() -> None:
    """Compile the time loop, so that its machine code is on disk before runs start."""
    modes = Modes(np.ones(1), np.zeros((2 * N_INTERFACE, 1)))
    zeros = np.zeros(N_INTERFACE)
    rule = SCHEMES["exponential"](modes, 0.0, 1e-6, Contact(zeros + 1.0, -1.0, 0.0))
    gap = np.ones((8, N_INTERFACE))
    stator = loop.Stator(gap, gap[:, 0].copy(), np.ones((5, 8)), 8, False, -1.0, 0.0, zeros)
    tip = loop.Tip(zeros, zeros, zeros + 1.0, zeros + 1.0, 2.0, 0.0, 0.0, 1.0)
    records = pack(rule), leap_of(rule, 1, 0.0), aligned(stator), aligned(tip), loop.at_rest(1, 8)
    loop.Rub(*records, 1).revolve(np.zeros(8))


def _lowest_within(reach: float, gap: np.ndarray) -> np.ndarray:
    return minimum_filter1d(gap, 2 * math.ceil(reach) + 1, axis=1, mode="wrap")


def element_angle(n_elements: int) -> np.ndarray:
    """Casing angle (N,) of the element centres, rad."""
    return (np.arange(n_elements) + 0.5) * (2 * np.pi / n_elements)


def _time_step(blade: ReducedBlade, spec: RunSpec) -> tuple[int, float]:
    passage = 1.0 / (spec.f_omega * blade.f1_hz * spec.coating.n_elements)
    steps_per_element = max(spec.steps_per_element, math.ceil(passage / spec.max_time_step))
    return steps_per_element, passage / steps_per_element


def _flight(rule: Recurrence, tip: loop.Tip, steps_per_element: int) -> Leap:
    parts = math.ceil(steps_per_element / LONGEST)
    slope = tip.stray / float(np.min(tip.radius - tip.limit))
    return leap_of(rule, steps_per_element // parts, slope)


def _start(modes: Modes, rule: Recurrence, spec: RunSpec, tip: loop.Tip) -> loop.State:
    """At rest, deflected in the first mode; the step before is the exact free motion back from there."""
    state = loop.at_rest(rule.omega.size, spec.coating.n_elements)
    if spec.initial_displacement:
        x, damping = rule.omega[0] * rule.time_step, spec.damping_ratio
        damped = math.sqrt(1.0 - damping**2)
        back = math.exp(damping * x) * (math.cos(damped * x) - damping / damped * math.sin(damped * x))
        n = rule.omega.size
        state.q[:, 0] = np.array([1.0, back, back]) * spec.initial_displacement / modes.tip[0, 0]
        radial, tangential = np.split(state.q[:, :n] @ rule.tip.T, 2, axis=1)
        rise = np.hypot(tip.radius + radial, tangential) - tip.radius
        state.u[:] = np.concatenate([radial, tangential, rise], axis=1)
    return state


def bar_area(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    """Area (8,) of one bar under each node, m²."""
    return strip_width(blade) * 2 * np.pi * _radius(blade) / spec.coating.n_elements


def _bar_stiffness(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    """Elastic stiffness (8,) of one bar under each node, N/m; infinite for the rigid casing."""
    return spec.coating.E * _slope(blade, spec)


def _slope(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    return spec.coating.modulus_unit * bar_area(blade, spec) / spec.coating.thickness


def _stator(blade: ReducedBlade, spec: RunSpec, tip: loop.Tip, rule: Recurrence) -> loop.Stator:
    coating = spec.coating
    radial, tangential = -math.cos(coating.theta), -math.sin(coating.theta)
    chord_fraction = _chord_fraction(blade)
    clearance = spec.clearance[0] + (spec.clearance[1] - spec.clearance[0]) * chord_fraction
    gap = casing.gap(spec.casing, clearance[:, None], element_angle(coating.n_elements))
    rows = np.array(
        [np.roll(of_node, -at) for of_node, at in zip(gap, _first_element(blade, spec), strict=True)]
    )
    reach = spec.tip.half_width + 1 + STRAY + 1  # + 1 each: a node stands anywhere within an element
    stator = loop.Stator(
        gap=rows.T,
        floor=_lowest_within(reach, rows).min(axis=0),
        law=_law(blade, spec),
        n_elements=coating.n_elements,
        is_rigid=coating.is_rigid,
        radial=radial,
        tangential=tangential,
        own_compliance=_own_compliance(rule, coating),
        reverses=coating.reverses,
    )
    return aligned(stator)


def _law(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    if spec.coating.is_rigid:
        return np.zeros((len(law.Element._fields), N_INTERFACE))
    return np.array(law.element(spec.coating, bar_area(blade, spec)))


def _own_compliance(rule: Recurrence, coating: Coating) -> np.ndarray:
    radial, tangential = -math.cos(coating.theta), -math.sin(coating.theta)
    own = np.diag(normal_compliance(rule.compliance, radial, tangential))
    backward = np.diag(normal_compliance(rule.compliance, radial, -tangential))
    if coating.is_rigid and min(np.min(own), np.min(backward)) <= 0:
        raise ValueError(
            f"friction {math.tan(coating.theta):g} on the rigid casing: must be so low that no node of this "
            "blade is drawn into the casing by its own friction (Painlevé's paradox)"
        )
    return np.maximum(own, 0.0)


def _tip(blade: ReducedBlade, spec: RunSpec) -> loop.Tip:
    n_elements = spec.coating.n_elements
    y, z = blade.node_position[:, 1], blade.node_position[:, 2]
    radius = _radius(blade)
    # Where the flow path is a cone, its normal section curves less than its circle (Meusnier)
    outward = (blade.radial_direction[:, 1] * y + blade.radial_direction[:, 2] * z) / radius
    per_metre = n_elements / (2 * np.pi * radius)
    tip = loop.Tip(
        start=_start_position(blade, spec) % 1.0,
        per_metre=per_metre,
        radius=radius / outward,
        lever=radius,
        half_width=spec.tip.half_width,
        curvature=spec.tip.curvature,
        stray=STRAY / float(np.max(per_metre)),
        limit=spec.displacement_limit,
    )
    return aligned(tip)


def _start_position(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    """Position (8,) of each node at the start of a revolution, in elements, within [0, N)."""
    angle = spec.casing.start_angle + np.arctan2(blade.node_position[:, 1], blade.node_position[:, 2])
    n_elements = spec.coating.n_elements
    return angle / (2 * np.pi) * n_elements % n_elements


def _first_element(blade: ReducedBlade, spec: RunSpec) -> np.ndarray:
    """Element (8,) that each node stands over at the start of a revolution: the first row."""
    return _start_position(blade, spec).astype(int)


def by_angle(blade: ReducedBlade, spec: RunSpec, rows: np.ndarray) -> np.ndarray:
    """Bring (N, 8) rows of elements into the order (8, N) of the angle."""
    first = _first_element(blade, spec)
    return np.array([np.roll(of_node, at) for of_node, at in zip(rows.T, first, strict=True)])


def _radius(blade: ReducedBlade) -> np.ndarray:
    return np.hypot(blade.node_position[:, 1], blade.node_position[:, 2])


def strip_width(blade: ReducedBlade) -> np.ndarray:
    """Axial width (8,) of the coating strip under each interface node, m: its share of the axial chord."""
    x = blade.node_position[:, 0]
    middle = np.concatenate([x[:1], (x[1:] + x[:-1]) / 2, x[-1:]])
    return np.abs(np.diff(middle))


def _chord_fraction(blade: ReducedBlade) -> np.ndarray:
    x = blade.node_position[:, 0]
    return (x - x[0]) / (x[-1] - x[0])
