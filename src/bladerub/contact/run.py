"""One run from rest: `RunSpec` → `RunResult`."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.ndimage import minimum_filter1d

from bladerub.blade.model import N_INTERFACE, ReducedBlade
from bladerub.contact import casing, kernel
from bladerub.contact.modes import Modes, Recurrence, central_differences, modes_at
from bladerub.contact.spec import Energy, RunResult, RunSpec

STRAY = 4
"""Elements a node may move along the casing before the search for contact looks at it alone."""


def simulate(blade: ReducedBlade, spec: RunSpec, progress: Callable[[int], None] | None = None) -> RunResult:
    """Let the blade rub at one constant speed, from rest.

    1. Eq. (1) is solved in the modal coordinates of the reduced blade at this speed, with modal
       damping, by explicit central differences of constant step.
    2. Each step predicts the motion without contact, evaluates the contact forces at the predicted
       position of the tip, and corrects the motion by them.
    3. The step is the largest one not above ``spec.max_time_step`` of which a whole number makes the
       passage of one coating element.
    4. Displacements are increments about the running position of the blade, and so are clearances.
    5. The tangential contact force opposes the rotation; tangential displacement is positive with it.

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
        If the speed is outside the range of the blade, or the step too long for its highest mode.
    """
    n_elements, revolutions = spec.coating.n_elements, spec.revolutions
    steps_per_element, time_step = _time_step(blade, spec)
    modes = modes_at(blade, spec.f_omega)
    rule = central_differences(modes, spec.damping_ratio, time_step)
    tip = _tip(blade, spec)
    stator = _stator(blade, spec, tip)
    state = kernel.State(
        q=np.zeros((3, modes.omega.size)),
        u=np.zeros((3, 2 * N_INTERFACE)),
        wear=np.zeros((N_INTERFACE, n_elements)),
        work=np.zeros(4),
    )
    displacement = np.full((revolutions, n_elements), np.nan)
    peak = np.full(revolutions, np.nan)
    n_steps = n_contact_steps = 0
    status, message = "completed", f"{revolutions} revolutions completed"
    for revolution in range(revolutions):
        made, touched, peak[revolution] = kernel.revolve(
            rule, stator, tip, state, steps_per_element, displacement[revolution]
        )
        n_steps += made
        n_contact_steps += touched
        if made < steps_per_element * n_elements:
            status = "unbounded"
            message = (
                f"the tip moved by more than {spec.displacement_limit:g} m "
                f"after {n_steps / (steps_per_element * n_elements):.2f} revolutions"
            )
            break
        if progress is not None:
            progress(revolution + 1)
    return RunResult(
        status=status,
        message=message,
        angle=_element_angle(n_elements),
        wear=state.wear,
        radial_displacement=displacement.ravel(),
        revolution_peak=peak,
        time_step=time_step,
        n_steps=n_steps,
        n_contact_steps=n_contact_steps,
        energy=_energy(modes, rule, state, time_step),
    )


def kernel_warm_up() -> None:
    """Compile the time loop, so that its machine code is on disk before runs start."""
    n = 2
    modes, tips = np.zeros(n), np.zeros((2 * N_INTERFACE, n))
    rule = Recurrence(modes, modes, tips, modes, tips, np.zeros((2 * N_INTERFACE, 2 * N_INTERFACE)))
    zeros = np.zeros(N_INTERFACE)
    table = np.ones((N_INTERFACE, 8))
    stator = kernel.Stator(table, table, table[0], zeros, zeros, zeros, -1.0, 0.0)
    tip = kernel.Tip(zeros, zeros, zeros + 1.0, 2.0, 0.0, 0.0, 1.0)
    state = kernel.State(np.zeros((3, n)), np.zeros((3, 2 * N_INTERFACE)), 0 * table, np.zeros(4))
    kernel.revolve(rule, stator, tip, state, 1, np.zeros(8))


def _lowest_within(reach: float, gap: np.ndarray) -> np.ndarray:
    return minimum_filter1d(gap, 2 * math.ceil(reach) + 1, axis=1, mode="wrap")


def _element_angle(n_elements: int) -> np.ndarray:
    return (np.arange(n_elements) + 0.5) * (2 * np.pi / n_elements)


def _time_step(blade: ReducedBlade, spec: RunSpec) -> tuple[int, float]:
    passage = 1.0 / (spec.f_omega * blade.f1_hz * spec.coating.n_elements)
    steps_per_element = math.ceil(passage / spec.max_time_step)
    return steps_per_element, passage / steps_per_element


def _stator(blade: ReducedBlade, spec: RunSpec, tip: kernel.Tip) -> kernel.Stator:
    coating = spec.coating
    area = strip_width(blade) / tip.per_metre
    slope = coating.modulus_unit * area / coating.thickness
    chord_fraction = _chord_fraction(blade)
    clearance = spec.clearance[0] + (spec.clearance[1] - spec.clearance[0]) * chord_fraction
    gap = casing.gap(spec.casing, clearance[:, None], _element_angle(coating.n_elements))
    lowest_gap = _lowest_within(spec.tip.half_width + 1, gap)
    start = tip.start.astype(int)
    met = np.array([np.roll(lowest, -at) for lowest, at in zip(lowest_gap, start, strict=True)])
    return kernel.Stator(
        gap=gap,
        lowest_gap=lowest_gap,
        floor=_lowest_within(STRAY + 1, met).min(axis=0),  # + 1: the node starts within an element
        elastic=coating.E * slope,
        hardening=coating.K * slope,
        strength=coating.yield_stress * coating.modulus_unit * area,
        radial=-math.cos(coating.theta),
        tangential=-math.sin(coating.theta),
    )


def _tip(blade: ReducedBlade, spec: RunSpec) -> kernel.Tip:
    n_elements = spec.coating.n_elements
    y, z = blade.node_position[:, 1], blade.node_position[:, 2]
    radius = np.hypot(y, z)
    start = (spec.casing.start_angle + np.arctan2(y, z)) / (2 * np.pi) * n_elements
    per_metre = n_elements / (2 * np.pi * radius)
    return kernel.Tip(
        start=start % n_elements,
        per_metre=per_metre,
        radius=radius,
        half_width=spec.tip.half_width,
        edge_drop=spec.tip.edge_drop,
        stray=STRAY / float(np.max(per_metre)),
        limit=spec.displacement_limit,
    )


def strip_width(blade: ReducedBlade) -> np.ndarray:
    """Axial width (8,) of the coating strip under each interface node, m: its share of the axial chord."""
    x = blade.node_position[:, 0]
    middle = np.concatenate([x[:1], (x[1:] + x[:-1]) / 2, x[-1:]])
    return np.abs(np.diff(middle))


def _chord_fraction(blade: ReducedBlade) -> np.ndarray:
    x = blade.node_position[:, 0]
    return (x - x[0]) / (x[-1] - x[0])


def _energy(modes: Modes, rule: Recurrence, state: kernel.State, time_step: float) -> Energy:
    q, before, oldest = state.q
    last_loss = float(np.sum(rule.loss * (q - oldest) ** 2))
    return Energy(
        kinetic=float(0.5 * np.sum(((q - before) / time_step) ** 2)),
        elastic=float(0.5 * np.sum(modes.omega**2 * q * before)),
        work_radial=float(state.work[0]),
        work_tangential=float(state.work[1]),
        damping=float(state.work[2]) + last_loss,
        wear=float(state.work[3]),
    )
