"""Integration of a run segment by segment, and what is kept of it."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from bladerub.contact.kernel.loop import Simulation


class Segment(NamedTuple):
    """A whole revolution or a part of one, at one speed."""

    simulation: Simulation  # What is integrated
    revolution: int  # Counted from 0
    # Elements passed since the start of the revolution, at the start and at the end of the segment
    first: int
    last: int


@dataclass
class History:
    """What is kept of an integration."""

    # (revolutions, N): Radial displacement of node 1, mean over the passage of each element, m; NaN after
    # an early end
    displacement: np.ndarray
    # (revolutions,): Range of that displacement in each revolution, m; NaN likewise
    lowest: np.ndarray = field(init=False)
    highest: np.ndarray = field(init=False)
    n_steps: int = 0  # Steps made, and those of them with contact
    n_contact_steps: int = 0
    revolutions_made: float = 0.0  # Revolutions made

    def __post_init__(self):
        self.lowest, self.highest = np.full((2, len(self.displacement)), np.nan)

    @property
    def peak(self) -> np.ndarray:
        """Largest absolute displacement in each revolution, m."""
        return np.maximum(np.abs(self.lowest), np.abs(self.highest))

    @property
    def amplitude(self) -> np.ndarray:
        """Half the range of the displacement in each revolution, m."""
        return 0.5 * (self.highest - self.lowest)

    def outcome(self, limit: float) -> tuple[str, str]:
        """Status and message of the run, whose tip must not move by more than `limit` (m)."""
        if self.revolutions_made == len(self.displacement):
            return "completed", f"{len(self.displacement)} revolutions completed"
        made = self.revolutions_made
        return "unbounded", f"the tip moved by more than {limit:g} m after {made:.2f} revolutions"


def integrate(
    segments: Iterable[Segment],
    revolutions: int,
    n_elements: int,
    progress: Callable[[int], None] | None = None,
) -> History:
    """Integrate consecutive segments, until the last or until a displacement exceeds the limit.

    Each segment is asked for when those before are done; `progress` is called with the number of revolutions
    done after each of them.
    """
    history = History(np.full((revolutions, n_elements), np.nan))
    for simulation, revolution, first, last in segments:
        made = simulation.advance(history.displacement[revolution, first:last], first)
        history.n_steps += made.n_steps
        history.n_contact_steps += made.n_contact_steps
        history.lowest[revolution] = np.fmin(history.lowest[revolution], made.lowest)
        history.highest[revolution] = np.fmax(history.highest[revolution], made.highest)
        passed = first + made.n_steps / simulation.steps_per_element
        history.revolutions_made = revolution + passed / n_elements
        if made.n_steps < (last - first) * simulation.steps_per_element:
            break
        if progress is not None and last == n_elements:
            progress(revolution + 1)
    return history
