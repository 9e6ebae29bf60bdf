"""Runs from rest, `RunSpec` → `RunResult`: their integration segment by segment, and what is kept of it."""

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact import energy
from bladerub.contact.kernel.loop import Progress, Simulation
from bladerub.contact.result import RunResult
from bladerub.contact.schemes import Recurrence
from bladerub.contact.setup import set_up
from bladerub.contact.spec import RunSpec
from bladerub.contact.strips import by_angle, element_angle
from bladerub.io.errors import BadInput


def simulate(blade: ReducedBlade, spec: RunSpec, progress: Callable[[int], None] | None = None) -> RunResult:
    """Simulate the contact of a blade with the coating at one constant speed.

    1. Eq. (1) is solved in the modal coordinates of the reduced blade at this speed, with modal
       damping, by the scheme that the spec names (contract: `bladerub.contact.schemes`).
    2. A whole number of steps makes the passage of one coating element: as few as the tolerance of the run
       allows (`bladerub.contact.steps`).
    3. Displacements are increments about the running position of the blade, and so are clearances.
    4. The contact force of a node is along the normal to the casing where the node is, turned by θ
       against the rotation, or by Coulomb's law against the sliding of the node
       (`bladerub.contact.friction`); tangential displacement is positive with the rotation.
    5. The blade starts at rest, deflected in its first mode where the spec says so.

    `bladerub.contact.reference` has the whole model on a page. `progress` is called with the number of
    revolutions done after each of them. What was computed until a displacement exceeded the limit is kept.
    Raises `ValueError` if the speed is outside the range of the blade, the step too long for the scheme, or
    if the law of the coating gives what is no number.
    """
    return simulate_longer(blade, spec, lambda result: 0, progress)[0]


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def simulate_longer(
    blade: ReducedBlade,
    spec: RunSpec,
    longer: Callable[[RunResult], int],
    progress: Callable[[int], None] | None = None,
) -> list[RunResult]:
    """Simulate a run as `simulate`, and on to so many revolutions as ``longer(result)`` says, if any.

    Returns the run, then the longer one if there is, which is that from rest to the last bit.
    """
    rule, simulation = set_up(blade, spec)
    history, n_elements = History(0, rule, simulation), spec.coating.n_elements

    def result_after(revolutions: int) -> RunResult:
        done = len(history.displacement)
        history.extend(revolutions)
        integrate(
            (Segment(simulation, n, 0, n_elements) for n in range(done, revolutions)), history, progress
        )
        return history.run_result(blade, spec, rule, simulation)

    results = [result_after(spec.revolutions)]
    if revolutions := longer(results[0]):
        results.append(result_after(revolutions))
    return results


class Segment(NamedTuple):
    """A whole revolution or a part of one, at one speed."""

    simulation: Simulation
    revolution: int  # Counted from 0
    first: int  # Elements passed since the start of the revolution, at the start of the segment
    last: int  # The same at its end


class History:
    """What is kept of an integration, which begins with this simulation; NaN after an early end."""

    def __init__(self, revolutions: int, rule: Recurrence, simulation: Simulation):
        self.initial = sum(energy.blade_energy(rule, simulation.state))  # Energy of the blade, J
        # Radial displacement of node 1, mean over the passage of each element, m
        self.displacement = np.empty((0, simulation.stator.n_elements))
        self.range = np.empty((0, 2))  # Lowest and highest of that in each revolution, m
        self.extend(revolutions)
        self.n_steps = self.n_contact_steps = 0
        self.revolutions_made = 0.0
        self.is_within_limit = True

    def extend(self, revolutions: int) -> None:
        """Make room for so many revolutions in all."""
        more = (0, revolutions - len(self.displacement)), (0, 0)
        self.displacement, self.range = (
            np.pad(rows, more, constant_values=np.nan) for rows in (self.displacement, self.range)
        )

    def enter(self, progress: Progress, segment: Segment) -> None:
        """Enter what was integrated of a segment."""
        simulation, revolution, first, last = segment
        self.n_steps += progress.n_steps
        self.n_contact_steps += progress.n_contact_steps
        lowest, highest = self.range[revolution]
        self.range[revolution] = np.fmin(lowest, progress.lowest), np.fmax(highest, progress.highest)
        travel = first + progress.n_steps / simulation.steps_per_element
        self.revolutions_made = revolution + travel / self.displacement.shape[1]
        self.is_within_limit = progress.n_steps == (last - first) * simulation.steps_per_element

    def outcome(
        self, blade: ReducedBlade, spec: RunSpec, rule: Recurrence, simulation: Simulation
    ) -> dict[str, Any]:
        """Fields of `bladerub.contact.result.Outcome`, where this is the simulation at the end."""
        revolutions, n_elements = self.displacement.shape
        status, message = "completed", f"{revolutions} revolutions completed"
        limit, elapsed = spec.displacement_limit, self.revolutions_made
        if not self.is_within_limit:
            status = "unbounded"
            message = f"the tip moved by more than {limit:g} m after {elapsed:.2f} revolutions"
        elif elapsed != revolutions:
            status, message = "stopped", f"another blade left the limit after {elapsed:.2f} revolutions"
        # no number where the first step of a revolution left the limit
        lowest, highest = np.where(np.isfinite(self.range), self.range, np.nan).T
        amplitude = 0.5 * (highest - lowest)
        amplitude[int(elapsed) :] = np.nan  # half a range is one of a whole revolution alone
        state, layer = simulation.state, simulation.layer
        ledger = energy.balance(rule, state, self.initial, simulation.angle_per_step)
        if not (np.isfinite(ledger.residual) and np.isfinite(state.wear).all()):
            coating = spec.coating
            raise BadInput(
                f"law {coating.element_law.label}: gives what is no number, in {elapsed:.2f} revolutions at "
                f"E = {coating.E:g}, K = {coating.K:g}"
            )
        return {
            "status": status,
            "message": message,
            "angle": element_angle(n_elements),
            "wear": by_angle(blade, spec, state.wear),
            "radial_displacement": self.displacement.ravel(),
            "revolution_peak": np.maximum(np.abs(lowest), np.abs(highest)),
            "revolution_amplitude": amplitude,
            "n_steps": self.n_steps,
            "n_contact_steps": self.n_contact_steps,
            "energy": ledger,
            "layer": {
                name: by_angle(blade, spec, rows)
                for name, rows in (layer.outcome(state) if layer else {}).items()
            },
        }

    def run_result(
        self, blade: ReducedBlade, spec: RunSpec, rule: Recurrence, simulation: Simulation
    ) -> RunResult:
        """Sum up a run at one speed."""
        ledger = simulation.state.ledger
        return RunResult(
            **self.outcome(blade, spec, rule, simulation),
            time_step=rule.time_step,
            n_reversed_steps=int(ledger[energy.REVERSED, 0]),
            slowest_sliding=1.0 - float(ledger[energy.RETREAT].max()) * simulation.steps_per_element,
            n_fallback_steps=int(ledger[energy.FALLBACK, 0]),
            n_unconverged_steps=int(ledger[energy.UNCONVERGED, 0]),
            n_modes=rule.omega.size,
        )


def integrate(
    segments: Iterable[Segment], history: History, progress: Callable[[int], None] | None = None
) -> None:
    """Integrate consecutive segments into `history`, until the last or a displacement exceeds the limit.

    A segment is asked for when those before are done; `progress` is called with the revolutions done.
    """
    n_elements = history.displacement.shape[1]
    for segment in segments:
        simulation, revolution, first, last = segment
        result = simulation.advance(history.displacement[revolution, first:last], first)
        history.enter(result, segment)
        if not history.is_within_limit:
            break
        if progress is not None and last == n_elements:
            progress(revolution + 1)
