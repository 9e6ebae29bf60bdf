"""One sweep through a range of speeds in time: `SweepSpec` → `SweepResult`.

1. The speed changes at a constant rate, in small steps. Over each step, to whole elements of the casing, it
   is constant and the blade is integrated as in `bladerub.contact.run`.
2. Between two steps the stiffness changes by eq. (2). Displacement and velocity of the blade are continuous
   there and so is the contact force; the state is transferred to the modes at the new speed.
3. The rotation thereby does the work ``½ uᵀ ΔK u`` on the blade, an entry of the ledger
   (`SweepResult.work_stiffness`).
4. As in eq. (1), displacements are increments about the running position, which itself changes with the
   speed. The force of the angular acceleration (Euler's) is left out: in a sweep through the range of the
   paper in five seconds it is below a hundredth of the centrifugal one from f_Ω = 0.1 on.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact import energy
from bladerub.contact.kernel.loop import Simulation
from bladerub.contact.kernel.records import COATING
from bladerub.contact.modes import Modes, mode_shapes_at, modes_at
from bladerub.contact.result import Outcome
from bladerub.contact.run import History, Segment, integrate
from bladerub.contact.schemes import Recurrence
from bladerub.contact.setup import set_up
from bladerub.contact.spec import RunSpec
from bladerub.extras.passages.sweep_grid import SweepSpec


@dataclass(frozen=True)
class SweepResult(Outcome):
    """Outcome of one sweep, as `Outcome`; its ledger lacks what the change of stiffness does."""

    f_omega: np.ndarray  # (revolutions,), mean speed of each, normalised
    time: np.ndarray  # (revolutions,), middle of each, s from the start
    work_stiffness: float  # of the rotation on the blade through the change of its stiffness, J

    @property
    def residual(self) -> float:
        """What the ledger of blade and casing misses, over the work exchanged; 0 without contact."""
        stiffened = replace(self.energy, work_rotation=self.energy.work_rotation + self.work_stiffness)
        return stiffened.residual


class SpeedStep(NamedTuple):
    """Elements `first` to `last`, counted from the start of the run, at the speed `f_omega`."""

    f_omega: float
    first: int
    last: int


def speed_steps(spec: SweepSpec, f1_hz: float) -> list[SpeedStep]:
    """Divide a sweep into steps of constant speed, the mean of each; `f1_hz` is of the blade at rest, Hz."""
    n_elements, start = spec.run.coating.n_elements, spec.run.f_omega
    n_steps_of_speed = max(1, int(np.ceil(abs(spec.f_end - start) / spec.speed_step - 1e-9)))
    edges = np.linspace(start, spec.f_end, n_steps_of_speed + 1)
    speeds = 0.5 * (edges[1:] + edges[:-1])
    duration = abs(spec.f_end - start) / n_steps_of_speed / spec.rate
    revolutions = spec.run.revolutions + np.concatenate([[0.0], np.cumsum(speeds * f1_hz * duration)])
    cuts = np.append(0, np.rint(revolutions * n_elements).astype(int))
    cuts[-1] = max(1, -(-cuts[-1] // n_elements)) * n_elements  # to the end of the last revolution
    planned = map(SpeedStep, [start, *speeds.tolist()], cuts[:-1].tolist(), cuts[1:].tolist())
    return [step for step in planned if step.last > step.first]


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def simulate_sweep(blade: ReducedBlade, spec: SweepSpec) -> SweepResult:
    """Simulate contact while the speed changes; `ValueError` as `simulate`, if a speed is out of range."""
    n_elements, plan = spec.run.coating.n_elements, speed_steps(spec, blade.f1_hz)
    stage, work = _stage_at(blade, spec.run, plan[0].f_omega), 0.0

    def segments() -> Iterator[Segment]:
        nonlocal stage, work
        for step in plan:
            if step is not plan[0]:
                before, stage = stage, _stage_at(blade, spec.run, step.f_omega)
                work += _transfer(blade, before, stage)
            first = step.first
            while first < step.last:
                revolution, element = divmod(first, n_elements)
                last = min(step.last, (revolution + 1) * n_elements)
                yield Segment(stage.simulation, revolution, element, element + last - first)
                first = last

    history = History(plan[-1].last // n_elements, stage.rule, stage.simulation)
    integrate(segments(), history)
    outcome = history.outcome(blade, spec.run, stage.rule, stage.simulation)
    f_omega, time = _by_revolution(plan, n_elements, blade.f1_hz)
    return SweepResult(**outcome, f_omega=f_omega, time=time, work_stiffness=work)


def _by_revolution(plan: list[SpeedStep], n_elements: int, f1_hz: float) -> tuple[np.ndarray, np.ndarray]:
    """Mean speed and middle of each revolution."""
    cuts = np.array([0, *(step.last for step in plan)])
    duration = np.diff(cuts) / (n_elements * f1_hz * np.array([step.f_omega for step in plan]))
    elapsed = np.concatenate([[0.0], np.cumsum(duration)])
    ends = np.interp(np.arange(0, cuts[-1] + 1, n_elements), cuts, elapsed)
    return 1.0 / (f1_hz * np.diff(ends)), 0.5 * (ends[1:] + ends[:-1])


class _Stage(NamedTuple):
    """The blade at one speed: all its modes, and the simulation in them."""

    modes: Modes
    shapes: np.ndarray
    rule: Recurrence
    simulation: Simulation


def _stage_at(blade: ReducedBlade, run: RunSpec, f_omega: float) -> _Stage:
    modes, (_, shapes) = modes_at(blade, f_omega, run), mode_shapes_at(blade, f_omega)
    return _Stage(modes, shapes, *set_up(blade, replace(run, f_omega=f_omega), modes))


def _transfer(blade: ReducedBlade, old: _Stage, new: _Stage) -> float:
    """Transfer the state of `old` to `new`; return the work of the change of stiffness, J."""
    state, old_state = new.simulation.state, old.simulation.state
    for name in ("force", "normal_force", "moment", "tangential_factor", "response", "ledger", *COATING):
        getattr(state, name)[:] = getattr(old_state, name)
    state.ledger[energy.TORQUE] *= old.simulation.angle_per_step / new.simulation.angle_per_step

    into = new.shapes.T @ blade.mass @ old.shapes  # from modal coordinates to modal coordinates
    force = energy.forces_of_nodes(old_state, old.rule)[0]
    static, static_new = (stage.modes.tip.T @ force / stage.modes.omega**2 for stage in (old, new))
    n, n_new = old.rule.omega.size, new.rule.omega.size
    share, share_new = np.sqrt(old.rule.share[:n]), np.sqrt(new.rule.share[:n_new])
    vibration, velocity = _free_motion(old.rule, old_state.q, force)

    total = static.copy()
    total[:n] += share * vibration
    moved = into @ total
    work = 0.5 * (np.sum((new.modes.omega * moved) ** 2) - np.sum((old.modes.omega * total) ** 2))

    vibration = into[:n_new, :n] @ vibration + share_new * (into @ static - static_new)[:n_new]
    state.q[:, :n_new] = _rows(new.rule, vibration, into[:n_new, :n] @ velocity, force)
    if np.array_equal(old_state.q[2], old_state.q[0]):  # a free flight, whose damping loss is entered
        state.q[2] = state.q[0]
    back = new.rule.time_step / old.rule.time_step
    state.u[0] = old_state.u[0]
    state.u[1] = old_state.u[0] + back * (old_state.u[1] - old_state.u[0])
    state.u[2] = old_state.u[0] + 2 * back * (old_state.u[1] - old_state.u[0])
    radius = new.simulation.tip.radius
    for row in state.u:
        radial, tangential, _, approach = row.reshape(4, -1)
        approach[:] = np.hypot(radius + radial, tangential) - radius
    return float(work)


def _frequency(rule: Recurrence) -> tuple[np.ndarray, np.ndarray]:
    """Angular frequency and decay (1/s) of the recurrence itself."""
    phase = np.arccos(rule.now / (2.0 * np.sqrt(rule.before)))
    return phase / rule.time_step, -0.5 * np.log(rule.before) / rule.time_step


def _free_motion(rule: Recurrence, q: np.ndarray, force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Displacement and velocity of each resolved mode about its rest under `force`."""
    frequency, decay = _frequency(rule)
    h = rule.time_step
    equilibrium = rule.tip.T @ force / rule.omega**2
    present, before = q[:2, : rule.omega.size] - equilibrium
    sine = (present * np.cos(frequency * h) - before * np.exp(-decay * h)) / np.sin(frequency * h)
    return present, frequency * sine - decay * present


def _rows(rule: Recurrence, vibration: np.ndarray, velocity: np.ndarray, force: np.ndarray) -> np.ndarray:
    """Coordinates (3, n) now, one and two steps before, of that motion."""
    frequency, decay = _frequency(rule)
    sine = (velocity + decay * vibration) / frequency
    time = -rule.time_step * np.arange(3)[:, None]
    turned = vibration * np.cos(frequency * time) + sine * np.sin(frequency * time)
    return rule.tip.T @ force / rule.omega**2 + np.exp(-decay * time) * turned
