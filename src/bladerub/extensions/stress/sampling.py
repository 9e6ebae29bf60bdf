"""A run of a single blade whose motion is sampled while it is integrated.

It is the run of `bladerub.contact.run.simulate`, to the last bit but for the sums of its energies. What
moves the blade are the modes that the time loop resolves and, by what the others answer to them, the contact
forces: few numbers at each instant.
"""

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact import energy
from bladerub.contact.integration import Segment, integrate
from bladerub.contact.kernel import loop
from bladerub.contact.kernel.loop import Progress, Simulation
from bladerub.contact.kernel.row import take_turns
from bladerub.contact.modes import Modes, at_tip, mode_shapes_at
from bladerub.contact.result import RunResult
from bladerub.contact.run import run_result
from bladerub.contact.setup import set_up_modes
from bladerub.contact.spec import RunSpec
from bladerub.numerics.machine_code import njit_on_disk
from bladerub.numerics.memory import read
from bladerub.numerics.vectors import LANES


class SampledRun(NamedTuple):
    """A run and its motion: the reduced coordinates are ``amplitudes @ patterns``."""

    result: RunResult
    time: np.ndarray  # (s,), the instants until the end of the run, revolutions
    amplitudes: np.ndarray  # (s, k), of the resolved modes, then contact forces
    patterns: np.ndarray  # (k, n), reduced coordinates about the running position per unit of each


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def simulate_sampled(
    blade: ReducedBlade, spec: RunSpec, instants: int, progress: Callable[[int], None] | None = None
) -> SampledRun:
    """Simulate a run, and sample it at so many instants of each revolution, one an element at most.

    `progress` is called with the number of revolutions done after each of them. Raises `ValueError` as
    `bladerub.contact.run.simulate`.
    """
    n_elements, revolutions = spec.coating.n_elements, spec.revolutions
    omega, shapes = mode_shapes_at(blade, spec.f_omega)
    modes = Modes(omega, at_tip(blade, shapes, spec), blade.n_interface)
    rule, simulation = set_up_modes(modes, blade, spec)
    ends = np.rint(np.linspace(0, n_elements, min(instants, n_elements) + 1)).astype(np.int64)
    sampled = _Sampled(simulation, ends)
    initial = sum(energy.blade_energy(rule, simulation.state))
    whole = (Segment(sampled, revolution, 0, n_elements) for revolution in range(revolutions))
    history = integrate(whole, revolutions, n_elements, progress)
    q, force = np.concatenate(sampled.q), np.concatenate(sampled.force)
    n, groups, lanes = rule.omega.size, len(rule.tip) // rule.n_nodes, len(simulation.state.force[0]) // 3
    forces = force.reshape(len(force), 3, lanes)[:, :groups, : rule.n_nodes].reshape(len(force), -1)
    # what the resolved modes displace, and how the others answer to the contact forces
    moving = np.sqrt(rule.share[:n])[:, None] * shapes[:, :n].T
    answer = modes.tip * ((1.0 - rule.share) / omega**2) @ shapes.T
    times = np.add.outer(np.arange(revolutions), ends[1:] / n_elements).ravel()
    return SampledRun(
        run_result(blade, spec, rule, simulation, history, initial),
        times[: len(q)],
        np.hstack([q[:, :n], forces]),
        np.vstack([moving, answer]),
    )


class _Sampled:
    """For `integrate`, in the place of a simulation: sampled after elements `ends` of each revolution."""

    def __init__(self, simulation: Simulation, ends: np.ndarray):
        self.state, self.steps_per_element = simulation.state, simulation.steps_per_element
        self.q: list[np.ndarray] = []  # (s, n) of each revolution
        self.force: list[np.ndarray] = []
        self._simulation, self._ends = simulation, ends
        # what is compiled here has the usual lanes and law; other loops are rare, and go by parts in Python
        self._is_usual = isinstance(simulation, Simulation)

    def advance(self, displacement: np.ndarray, first: int) -> Progress:
        state, n = self.state, self._ends.size - 1
        q, force = np.empty((n, state.q.shape[1])), np.empty((n, state.force.shape[1]))
        run = _advance if self._is_usual else _advance_by_parts
        passed, made = run(self._simulation, self._ends, displacement, q, force)
        self.q.append(q[:passed])
        self.force.append(force[:passed])
        return made


def _advance(simulation, ends, displacement, q, force):
    address, per_element = displacement.ctypes.data, simulation.steps_per_element
    passed, *made = _integrate(*simulation.records, per_element, ends, address, q, force)
    return passed, Progress(*made)


def _advance_by_parts(simulation, ends, displacement, q, force):
    n_steps = n_flights = n_contact = 0
    low, high = np.inf, -np.inf
    for part, (first, last) in enumerate(pairwise(ends)):
        made = simulation.advance(displacement[first:last], int(first))
        n_steps, n_flights = n_steps + made.n_steps, n_flights + made.n_flights
        n_contact += made.n_contact_steps
        low, high = min(low, made.lowest), max(high, made.highest)
        if made.n_steps < (last - first) * simulation.steps_per_element:
            return part, Progress(n_steps, n_flights, n_contact, low, high)
        q[part], force[part] = simulation.state.q[0], simulation.state.force[0]
    return len(q), Progress(n_steps, n_flights, n_contact, low, high)


@njit_on_disk(nogil=True)
def _integrate(modal, flight, stator, tip, state, steps_per_element, ends, displacement, q, force):
    n_steps = n_flights = n_contact = 0
    low, high = np.inf, -np.inf
    flew, far = False, 0.0
    for part in range(len(q)):
        first, last = ends[part], ends[part + 1]
        turns, flew, far, steps, flights, contacts, lowest, highest = loop.integrate(
            modal,
            flight,
            stator,
            tip,
            state,
            steps_per_element,
            first,
            last,
            flew,
            far,
            displacement + 8 * first,
        )
        take_turns(state.q, modal.n, turns)
        take_turns(state.u, 4 * LANES, turns)
        n_steps, n_flights, n_contact = n_steps + steps, n_flights + flights, n_contact + contacts
        low, high = min(low, lowest), max(high, highest)
        if steps < (last - first) * steps_per_element:
            return part, n_steps, n_flights, n_contact, low, high
        for k in range(q.shape[1]):
            q[part, k] = read(state.q, k)
        for k in range(force.shape[1]):
            force[part, k] = read(state.force, k)
    return len(q), n_steps, n_flights, n_contact, low, high
