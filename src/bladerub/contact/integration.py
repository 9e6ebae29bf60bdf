"""The march of a blade over the casing, part by part, and what is kept of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from bladerub.contact.kernel.loop import Rub


class Part(NamedTuple):
    """A whole revolution or a part of one, at one speed.

    Parameters
    ----------
    rub : Rub
        What marches.
    revolution : int
        Counted from 0.
    first, last : int
        Elements passed since the start of the revolution, at the start and at the end of the part.
    """

    rub: Rub
    revolution: int
    first: int
    last: int


@dataclass
class Track:
    """What is kept of a march.

    Parameters
    ----------
    displacement : (revolutions, N) ndarray
        Radial displacement of node 1, mean over the passage of each element, m; NaN after an early end.
    lowest, highest : (revolutions,) ndarray
        Range of that displacement in each revolution, m; NaN likewise.
    n_steps, n_contact_steps : int
        Steps made, and those of them with contact.
    made : float
        Revolutions made.
    """

    displacement: np.ndarray
    lowest: np.ndarray = field(init=False)
    highest: np.ndarray = field(init=False)
    n_steps: int = 0
    n_contact_steps: int = 0
    made: float = 0.0

    def __post_init__(self):
        self.lowest, self.highest = np.full((2, len(self.displacement)), np.nan)

    @property
    def is_whole(self) -> bool:
        """Whether the tip stayed within bounds to the end."""
        return self.made == len(self.displacement)

    @property
    def peak(self) -> np.ndarray:
        """Largest absolute displacement in each revolution, m."""
        return np.maximum(np.abs(self.lowest), np.abs(self.highest))

    @property
    def amplitude(self) -> np.ndarray:
        """Half the range of the displacement in each revolution, m."""
        return 0.5 * (self.highest - self.lowest)

    def verdict(self, limit: float) -> tuple[str, str]:
        """Status and message of the run, whose tip must not move by more than `limit` (m)."""
        if self.is_whole:
            return "completed", f"{len(self.displacement)} revolutions completed"
        return "unbounded", f"the tip moved by more than {limit:g} m after {self.made:.2f} revolutions"


def march(
    parts: Iterable[Part], revolutions: int, n_elements: int, progress: Callable[[int], None] | None = None
) -> Track:
    """March `parts`, which follow each other, until the last or until the tip leaves all bounds.

    Parameters
    ----------
    parts : iterable of Part
        Each is asked for when those before are done.
    revolutions, n_elements : int
        Length of the run, and elements in a revolution.
    progress : callable, optional
        Called with the number of revolutions done after each of them.
    """
    track = Track(np.full((revolutions, n_elements), np.nan))
    for rub, revolution, first, last in parts:
        made = rub.revolve(track.displacement[revolution, first:last], first)
        track.n_steps += made.n_steps
        track.n_contact_steps += made.n_contact_steps
        track.lowest[revolution] = np.fmin(track.lowest[revolution], made.lowest)
        track.highest[revolution] = np.fmax(track.highest[revolution], made.highest)
        track.made = revolution + (first + made.n_steps / rub.steps_per_element) / n_elements
        if made.n_steps < (last - first) * rub.steps_per_element:
            break
        if progress is not None and last == n_elements:
            progress(revolution + 1)
    return track
