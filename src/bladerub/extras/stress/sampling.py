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
from bladerub.contact.kernel import loop
from bladerub.contact.kernel.loop import Progress, Simulation
from bladerub.contact.laws import solver_digest
from bladerub.contact.modes import mode_shapes_at, modes_at
from bladerub.contact.result import RunResult
from bladerub.contact.run import History, Segment, integrate
from bladerub.contact.setup import set_up
from bladerub.contact.spec import RunSpec
from bladerub.numerics.machine_code import njit_on_disk
from bladerub.numerics.memory import address_of, read


class SampledRun(NamedTuple):
    """A run and its motion in single precision: the reduced coordinates are ``amplitudes @ patterns``."""

    result: RunResult
    time: np.ndarray  # (s,), the instants until the end of the run, revolutions
    amplitudes: np.ndarray  # (s, k), of the resolved modes, then contact forces
    patterns: np.ndarray  # (k, n), reduced coordinates about the running position per unit of each


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def simulate_sampled(
    blade: ReducedBlade, spec: RunSpec, instants: int, progress: Callable[[int], None] | None = None
) -> SampledRun:
    """Simulate a run, sampled at `instants` a revolution, one an element at most; raises as `simulate`."""
    n_elements, revolutions = spec.coating.n_elements, spec.revolutions
    modes, (_, shapes) = modes_at(blade, spec.f_omega, spec), mode_shapes_at(blade, spec.f_omega)
    rule, simulation = set_up(blade, spec, modes)
    ends = np.rint(np.linspace(0, n_elements, min(instants, n_elements) + 1)).astype(np.int64)
    n, groups, lanes = rule.omega.size, len(rule.tip) // rule.n_nodes, len(simulation.state.force[0]) // 3
    forces = np.add.outer(lanes * np.arange(groups), np.arange(rule.n_nodes)).ravel()
    sampled = _Sampled(simulation, ends, n, forces, revolutions)
    segments = (Segment(sampled, revolution, 0, n_elements) for revolution in range(revolutions))
    history = History(revolutions, rule, simulation)
    integrate(segments, history, progress)
    # what the resolved modes displace, and how the others answer to the contact forces
    moving = np.sqrt(rule.share[:n])[:, None] * shapes[:, :n].T
    answer = modes.tip * ((1.0 - rule.share) / modes.omega**2) @ shapes.T
    times = np.add.outer(np.arange(revolutions), ends[1:] / n_elements).ravel()
    patterns, n_sampled = np.vstack([moving, answer]).astype(np.float32), sampled.n_sampled
    result = history.run_result(blade, spec, rule, simulation)
    return SampledRun(result, times[:n_sampled], sampled.amplitudes[:n_sampled], patterns)


class _Sampled:
    """For `integrate`, in the place of a simulation: sampled after elements `ends` of each revolution."""

    def __init__(self, simulation, ends: np.ndarray, n: int, forces: np.ndarray, revolutions: int):
        self.state, self.steps_per_element = simulation.state, simulation.steps_per_element
        # of the first n modes, and the contact forces of these numbers
        self.amplitudes = np.empty((revolutions * (ends.size - 1), n + forces.size), np.float32)
        self.n_sampled = 0  # instants
        self._simulation, self._ends, self._forces = simulation, ends, forces
        # what is compiled here has the usual lanes and law; other loops are rare, and go by parts in Python
        self._is_usual = isinstance(simulation, Simulation)

    def advance(self, displacement: np.ndarray, first: int) -> Progress:
        run = _advance if self._is_usual else _advance_by_parts
        rows = self.amplitudes[self.n_sampled : self.n_sampled + self._ends.size - 1]
        n_instants, progress = run(self._simulation, self._ends, displacement, rows, self._forces)
        self.n_sampled += n_instants
        return progress


def _advance(simulation, ends, displacement, rows, forces):
    address, per_element = displacement.ctypes.data, simulation.steps_per_element
    n_instants, *progress = _integrate(simulation.records, per_element, ends, address, rows, forces)
    return n_instants, Progress(*progress)


def _advance_by_parts(simulation, ends, displacement, rows, forces):
    state, n, parts, n_instants = simulation.state, rows.shape[1] - forces.size, [], 0
    for first, last in pairwise(ends):
        parts.append(simulation.advance(displacement[first:last], int(first)))
        if parts[-1].n_steps < (last - first) * simulation.steps_per_element:
            break
        rows[n_instants] = np.concatenate([state.q[0, :n], state.force[0, forces]])
        n_instants += 1
    *counts, lowest, highest = zip(*parts, strict=True)
    return n_instants, Progress(*map(sum, counts), min(lowest), max(highest))


@njit_on_disk(solver_digest(), nogil=True)
def _integrate(records, steps_per_element, ends, displacement, rows, forces):
    n_steps = n_flights = n_contact = 0
    low, high = np.inf, -np.inf
    in_flight, bound = n_steps > 0, 0.0  # no constant: the loop would be compiled once more, for that one
    n = rows.shape[1] - forces.size
    for part in range(len(rows)):
        first, last = ends[part], ends[part + 1]
        means = address_of(displacement, first)
        in_flight, bound, steps, flights, contacts, lowest, highest = loop.integrate(
            records, steps_per_element, first, last, in_flight, bound, means
        )
        n_steps, n_flights, n_contact = n_steps + steps, n_flights + flights, n_contact + contacts
        low, high = min(low, lowest), max(high, highest)
        if steps < (last - first) * steps_per_element:
            return part, n_steps, n_flights, n_contact, low, high
        for k in range(n):
            rows[part, k] = _normal(read(records.state.q, k))
        for k, index in enumerate(forces):
            rows[part, n + k] = _normal(read(records.state.force, index))
    return len(rows), n_steps, n_flights, n_contact, low, high


@njit_on_disk(solver_digest())
def _normal(value):
    """Return the number, or 0 for one that is subnormal in single precision, since those are slow."""
    return value if abs(value) > 1e-37 else 0.0
