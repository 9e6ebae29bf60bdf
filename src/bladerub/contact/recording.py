"""The motion of whole blades at some instants of a run, which the run itself does not keep."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact.energy import forces_of_nodes
from bladerub.contact.modes import at_tip, mode_shapes_at
from bladerub.contact.row import set_up_row
from bladerub.contact.row_spec import Row
from bladerub.contact.schemes import Recurrence
from bladerub.contact.setup import by_angle, set_up
from bladerub.contact.spec import RunSpec


class Recording(NamedTuple):
    """Motion of the blade at some instants."""

    time: np.ndarray  # (s,): The instants, in revolutions from the start of the run
    # (s, n): Reduced coordinates of the blade, increments about its running position
    coordinates: np.ndarray
    # (n_elements,): Of node 1 in the recorded revolution, mean over the passage of each element, m
    radial_displacement: np.ndarray
    # (r,): Largest absolute radial displacement of node 1 in each revolution, the recorded one being the
    # last, m
    revolution_peak: np.ndarray


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def record(
    blade: ReducedBlade,
    spec: RunSpec,
    revolution: int,
    n_instants: int,
    progress: Callable[[int], None] | None = None,
) -> Recording:
    """Simulate a run as `bladerub.contact.run.simulate` does, and record one revolution.

    Parameters
    ----------
    blade : ReducedBlade
        The blade.
    spec : RunSpec
        The run.
    revolution : int
        Which revolution to record, counted from 1; nothing is computed after it. The tip must stay within
        bounds until its end.
    n_instants : int
        How many instants, evenly spread but each at the end of the passage of an element, so at most
        ``spec.coating.n_elements``. The last one is the end of the revolution.
    progress : callable, optional
        Called with the number of revolutions done after each of them.

    Raises
    ------
    ValueError
        As `simulate`.
    """
    rule, simulation = set_up(blade, spec)
    n_elements = spec.coating.n_elements
    stops = np.rint(np.linspace(0, n_elements, n_instants + 1)).astype(int)
    displacement, peak = np.empty(n_elements), np.zeros(revolution)
    amplitudes, forces = [], []
    for number in range(revolution):
        recorded = number == revolution - 1
        for first, last in pairwise(stops if recorded else (0, n_elements)):
            made = simulation.advance(displacement[first:last], first)
            peak[number] = max(peak[number], abs(made.lowest), abs(made.highest))
            if recorded:
                amplitudes.append(simulation.state.q[0, : rule.omega.size].copy())
                forces.append(forces_of_nodes(simulation.state, rule)[0].copy())
        if progress is not None:
            progress(number + 1)
    omega = mode_shapes_at(blade, spec.f_omega)[0]
    coordinates = _reduced_coordinates(blade, spec, rule, omega, np.array(amplitudes), np.array(forces))
    return Recording(revolution - 1 + stops[1:] / n_elements, coordinates, displacement, peak)


class RowRecording(NamedTuple):
    """Motion of the N blades of a row, and their coating, at some instants."""

    time: np.ndarray  # (s,): The instants, in revolutions from the start of the run
    coordinates: np.ndarray  # (s, N, n): Reduced coordinates of each blade, as `Recording.coordinates`
    wear: np.ndarray  # (s, 8, n_elements): Worn depth under each node, by casing angle, m
    # (N, r): Largest absolute radial displacement of node 1 of each blade in each revolution that was
    # computed to its end, m; NaN where it was at rest
    revolution_peak: np.ndarray


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def record_row(
    blade: ReducedBlade,
    spec: RunSpec,
    row: Row,
    instants: Sequence[int],
    progress: Callable[[int], None] | None = None,
) -> RowRecording:
    """Simulate a row as `bladerub.contact.row.simulate_row` does, and record it at some instants.

    Parameters
    ----------
    blade : ReducedBlade
        The nominal blade.
    spec : RunSpec
        The run. No blade may leave the displacement limit before the last instant.
    row : Row
        The blades.
    instants : sequence of int
        Ascending, as numbers of elements that have passed since the start; nothing is computed after the
        last one.
    progress : callable, optional
        Called with the number of revolutions done after each of them.

    Raises
    ------
    ValueError
        As `simulate_row`.
    """
    seats, simulation, _ = set_up_row(blade, spec, row)
    n_elements, whole = spec.coating.n_elements, range(0, instants[-1] + 1, spec.coating.n_elements)
    wanted, wear = set(instants), []
    amplitudes, forces = [], []
    peak = np.full((len(seats), instants[-1] // n_elements), np.nan)
    for first, last in pairwise(sorted({*whole, *instants, 0})):
        _, made = simulation.advance(np.empty((len(seats), last - first)), first)
        revolution = first // n_elements
        if revolution < peak.shape[1]:
            largest = [max(abs(of.lowest), abs(of.highest)) if of.n_steps else np.nan for of in made]
            peak[:, revolution] = np.fmax(peak[:, revolution], largest)
        if last in wanted:
            amplitudes.append([seat.simulation.state.q[0, : seat.rule.omega.size].copy() for seat in seats])
            forces.append([forces_of_nodes(seat.simulation.state, seat.rule)[0].copy() for seat in seats])
            wear.append(by_angle(blade, spec, seats[0].simulation.state.wear).copy())
        if progress is not None and last % n_elements == 0:
            progress(last // n_elements)
    coordinates = [
        _reduced_coordinates(
            blade,
            spec,
            seat.rule,
            seat.modes.omega,
            np.array([of[b] for of in amplitudes]),
            np.array([of[b] for of in forces]),
        )
        for b, seat in enumerate(seats)
    ]
    time = np.array(instants) / n_elements
    return RowRecording(time, np.stack(coordinates, axis=1), np.array(wear), peak)


def _reduced_coordinates(
    blade: ReducedBlade,
    spec: RunSpec,
    rule: Recurrence,
    omega: np.ndarray,
    amplitudes: np.ndarray,
    forces: np.ndarray,
) -> np.ndarray:
    """Sum up (s, n) what the resolved modes displace and how the others answer to the contact forces.

    `omega` are the natural angular frequencies of the blade.
    """
    _, shapes = mode_shapes_at(blade, spec.f_omega)
    n = rule.omega.size
    tip = at_tip(blade, shapes, spec)
    static = forces @ tip * (1.0 - rule.share) / omega**2
    static[:, :n] += amplitudes * np.sqrt(rule.share[:n])
    return static @ shapes.T
