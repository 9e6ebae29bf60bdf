"""A run of a file computed again, with the motion of whole blades at some instants, which the file lacks."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact.energy import forces_of_nodes
from bladerub.contact.modes import at_tip, mode_shapes_at
from bladerub.contact.spec import RunSpec
from bladerub.contact.strips import by_angle
from bladerub.extras.rows.row import set_up_row
from bladerub.extras.rows.spec import Row
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.plan import PlannedRun, planned_run
from bladerub.study.solver import rows
from bladerub.study.store import StoredRun


class Recording(NamedTuple):
    """Motion of the N blades of a row, and their coating, at some instants."""

    time: np.ndarray  # (s,): The instants, in revolutions from the start of the run
    # (s, N, n): Reduced coordinates of each blade, increments about its running position
    coordinates: np.ndarray
    wear: np.ndarray  # (s, 8, n_elements): Worn depth under each node, by casing angle, m
    # (N, r): Largest absolute radial displacement of node 1 of each blade in each revolution that was
    # computed to its end, m; NaN where it was at rest
    revolution_peak: np.ndarray


def claimed_run(config: Config, file: str, run: StoredRun) -> PlannedRun:
    """Plan again what a stored run says it is; KeyError for a missing attribute or casing."""
    attributes, case = run.attributes, CoatingCase.described(run.attributes)
    spec = replace(run_spec(config, case, attributes["f_omega"]), revolutions=attributes["revolutions"])
    # as of a short run asked for alone
    shortest = min(config.analysis.spectrum_revolutions, spec.revolutions)
    config = config.replaced("analysis.spectrum_revolutions", shortest)
    row = rows().stored(run) if "row" in run.data else None
    return planned_run(config, spec, file, "radial_displacement" in run.data, row)


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def record(
    blade: ReducedBlade, spec: RunSpec, row: Row | None, instants: Sequence, progress: Callable | None = None
) -> Recording:
    """Simulate as `bladerub.extras.rows.row.simulate_row` a row, or the blade alone; record it at instants.

    These ascend, as numbers of elements that have passed since the start; nothing is computed after the last,
    before which no blade may leave the displacement limit.
    """
    _, seats, simulation = set_up_row(blade, spec, row or Row.even(1))
    n_elements, end = spec.coating.n_elements, instants[-1]
    stops, wear = set(instants), []
    motions: list[list[tuple[np.ndarray, np.ndarray]]] = [[] for _ in seats]
    peak = np.full((len(seats), end // n_elements), np.nan)
    for first, last in pairwise(sorted({*range(0, end + 1, n_elements), *instants})):
        _, blade_progress = simulation.advance(np.empty((len(seats), last - first)), first)
        revolution = first // n_elements
        for largest, motion in zip(peak, blade_progress, strict=True):
            if motion.n_steps and revolution < largest.size:
                largest[revolution] = np.fmax(largest[revolution], max(-motion.lowest, motion.highest))
        if last in stops:
            for seat, motion in zip(seats, motions, strict=True):
                state, rule = seat.simulation.state, seat.rule
                motion.append((state.q[0, : rule.omega.size].copy(), forces_of_nodes(state, rule)[0].copy()))
            wear.append(by_angle(blade, spec, seats[0].simulation.state.wear).copy())
        if progress is not None and last % n_elements == 0:
            progress(last // n_elements)
    shapes = mode_shapes_at(blade, spec.f_omega)[1]
    tip = at_tip(blade, shapes, spec)
    coordinates = []
    for seat, motion in zip(seats, motions, strict=True):
        amplitudes, forces = map(np.array, zip(*motion, strict=True))
        # what the resolved modes displace, and how the others answer to the contact forces
        share, n = seat.rule.share, seat.rule.omega.size
        modal = forces @ tip * (1.0 - share) / seat.modes.omega**2
        modal[:, :n] += amplitudes * np.sqrt(share[:n])
        coordinates.append(modal @ shapes.T)
    return Recording(np.array(instants) / n_elements, np.stack(coordinates, axis=1), np.array(wear), peak)
