"""The motion of the whole blade in one revolution of a run, which the run itself does not keep."""

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact.energy import forces_of_nodes
from bladerub.contact.modes import at_tip, mode_shapes_at
from bladerub.contact.schemes import Recurrence
from bladerub.contact.setup import set_up
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
    coordinates = _reduced_coordinates(blade, spec, rule, np.array(amplitudes), np.array(forces))
    return Recording(revolution - 1 + stops[1:] / n_elements, coordinates, displacement, peak)


def _reduced_coordinates(
    blade: ReducedBlade, spec: RunSpec, rule: Recurrence, amplitudes: np.ndarray, forces: np.ndarray
) -> np.ndarray:
    """Sum up (s, n) what the resolved modes displace and how the others answer to the contact forces."""
    omega, shapes = mode_shapes_at(blade, spec.f_omega)
    n = rule.omega.size
    tip = at_tip(blade, shapes, spec)
    static = forces @ tip * (1.0 - rule.share) / omega**2
    static[:, :n] += amplitudes * np.sqrt(rule.share[:n])
    return static @ shapes.T
