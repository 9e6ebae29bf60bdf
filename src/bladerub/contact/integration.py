"""Integration of a run segment by segment, and what is kept of it."""

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact import energy
from bladerub.contact.kernel.loop import Progress, Simulation
from bladerub.contact.schemes import Recurrence
from bladerub.contact.spec import RunSpec
from bladerub.contact.strips import by_angle, element_angle


class Segment(NamedTuple):
    """A whole revolution or a part of one, at one speed."""

    simulation: Simulation
    revolution: int  # Counted from 0
    first: int  # Elements passed since the start of the revolution, at the start of the segment
    last: int  # The same at its end


class History:
    """What is kept of an integration; NaN after an early end."""

    def __init__(self, revolutions: int, n_elements: int):
        # Radial displacement of node 1, mean over the passage of each element, m
        self.displacement = np.empty((0, n_elements))
        # Range of that displacement in each revolution, m
        self.lowest, self.highest = np.empty((2, 0))
        self.extend(revolutions)
        self.n_steps = self.n_contact_steps = 0
        self.revolutions_made = 0.0
        self.is_within_limit = True

    def extend(self, revolutions: int) -> None:
        """Make room for so many revolutions in all."""
        more = revolutions - len(self.displacement)
        self.displacement = np.pad(self.displacement, ((0, more), (0, 0)), constant_values=np.nan)
        self.lowest, self.highest = (
            np.pad(end, (0, more), constant_values=np.nan) for end in (self.lowest, self.highest)
        )

    def enter(self, progress: Progress, segment: Segment) -> None:
        """Enter what was integrated of a segment."""
        simulation, revolution, first, last = segment
        self.n_steps += progress.n_steps
        self.n_contact_steps += progress.n_contact_steps
        self.lowest[revolution] = np.fmin(self.lowest[revolution], progress.lowest)
        self.highest[revolution] = np.fmax(self.highest[revolution], progress.highest)
        travel = first + progress.n_steps / simulation.steps_per_element
        self.revolutions_made = revolution + travel / self.displacement.shape[1]
        self.is_within_limit = progress.n_steps == (last - first) * simulation.steps_per_element

    def outcome(
        self, blade: ReducedBlade, spec: RunSpec, rule: Recurrence, simulation: Simulation, initial: float
    ) -> dict[str, Any]:
        """Fields of `bladerub.contact.result.Outcome`; the blade had `initial` energy (J) at the start."""
        revolutions, n_elements = self.displacement.shape
        status, message = "completed", f"{revolutions} revolutions completed"
        limit, elapsed = spec.displacement_limit, self.revolutions_made
        if not self.is_within_limit:
            status = "unbounded"
            message = f"the tip moved by more than {limit:g} m after {elapsed:.2f} revolutions"
        elif elapsed != revolutions:
            status, message = "stopped", f"another blade left the limit after {elapsed:.2f} revolutions"
        lowest, highest = (  # no number where the first step of a revolution left the limit
            np.where(np.isfinite(end), end, np.nan) for end in (self.lowest, self.highest)
        )
        state, layer = simulation.state, simulation.layer
        return {
            "status": status,
            "message": message,
            "angle": element_angle(n_elements),
            "wear": by_angle(blade, spec, state.wear),
            "radial_displacement": self.displacement.ravel(),
            "revolution_peak": np.maximum(np.abs(lowest), np.abs(highest)),
            "revolution_amplitude": 0.5 * (highest - lowest),
            "n_steps": self.n_steps,
            "n_contact_steps": self.n_contact_steps,
            "energy": energy.balance(rule, state, initial, simulation.angle_per_step),
            "layer": {
                name: by_angle(blade, spec, rows)
                for name, rows in (layer.outcome(state) if layer else {}).items()
            },
        }


def integrate(
    segments: Iterable[Segment], history: History, progress: Callable[[int], None] | None = None
) -> None:
    """Integrate consecutive segments into `history`, until the last or a displacement exceeds the limit.

    Each segment is asked for when those before are done; `progress` is called with the number of revolutions
    done after each of them.
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
