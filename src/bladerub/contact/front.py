"""The blades of a row on their way around one coating, each as far ahead as the others let it.

An element is under one blade at a time, since neighbours stand further apart than the displacement limit lets
them reach. So the order in which blades pass an element is known beforehand, and each can be integrated over
many elements at once.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact import energy
from bladerub.contact.integration import History, Segment
from bladerub.contact.modes import Modes, modes_at, tip_radii
from bladerub.contact.result import RunResult
from bladerub.contact.row_spec import RowBlade
from bladerub.contact.run import run_result
from bladerub.contact.setup import Seat, element_area, set_up_modes
from bladerub.contact.spec import RunSpec

_TURN = 2 * np.pi


class _Seated:
    """One blade of the row, and how far it is integrated."""

    def __init__(
        self, blade: ReducedBlade, spec: RunSpec, modes: Modes, own: RowBlade, wear: np.ndarray | None
    ):
        n_elements = spec.coating.n_elements
        position = own.angle % _TURN / _TURN * n_elements
        self.spec = replace(spec, damping_ratio=spec.damping_ratio * own.damping)
        self.row = int(position)  # of the shared coating, which it passes at the start
        modes = modes._replace(omega=modes.omega * (1.0 + own.frequency))
        seat = Seat(position - self.row, own.length, wear)
        self.rule, self.simulation = set_up_modes(modes, blade, self.spec, seat)
        self.initial = sum(energy.blade_energy(self.rule, self.simulation.state))
        self.history = History(spec.revolutions, n_elements)
        self.passed = 0  # elements since the start of the run
        self.worn = np.zeros(self.simulation.state.wear.shape[1])  # of the elements of each lane, m

    def wait(self) -> None:
        """Stay at rest until the first place where nothing is touched; `ValueError` if there is none."""
        clear = np.flatnonzero(np.roll(self.simulation.stator.minimum_gap, -self.row) > 0)
        if not clear.size:
            raise ValueError("row: a blade touches all around the casing at rest; make it shorter")
        self.passed = int(clear[0])
        self.history.displacement[0, : self.passed] = 0.0

    def advance(self, end: int) -> None:
        """Integrate up to `end` elements from the start, or to that in which the limit is left."""
        if end <= self.passed:
            return
        n_elements = self.spec.coating.n_elements
        wear, simulation = self.simulation.state.wear, self.simulation
        before = wear.sum(axis=0)
        while self.passed < end and self.history.is_within_limit:
            revolution, first = divmod(self.passed, n_elements)
            at = (self.row + first) % n_elements
            last = min(first + end - self.passed, n_elements, first + n_elements - at)
            segment = Segment(simulation, revolution, first, last)
            displacement = self.history.displacement[revolution, first:last]
            made = simulation.advance(displacement, at, resumes=first > 0)
            self.history.enter(made, segment)
            self.passed += made.n_steps // simulation.steps_per_element
        self.worn += wear.sum(axis=0) - before


class Front:
    """The blades of a row on their way around the casing.

    A blade may be integrated as far as the blade ahead has left the coating behind it: that one passes each
    element before, and none else passes it between. Raises `ValueError` as
    `bladerub.contact.row.simulate_row`.
    """

    def __init__(self, blade: ReducedBlade, spec: RunSpec, blades: Sequence[RowBlade]):
        self.blade, self.spec = blade, spec
        modes = modes_at(blade, spec.f_omega, spec)
        wear = None
        self.blades = []
        for own in blades:
            self.blades.append(_Seated(blade, spec, modes, own, wear))
            wear = self.blades[0].simulation.state.wear
        self.links = _links(self.blades, spec, _reach(blade, spec))
        if len(blades) > 1:
            for seated in self.blades:
                seated.wait()

    def march(self, end: int, progress: Callable[[int], None] | None = None) -> int | None:
        """Integrate all blades up to `end` elements from the start.

        Returns the first element in which a blade leaves the displacement limit, if any does: there it stays,
        and the others go to the end of that element or further.
        """
        left, done = None, 0
        while any(seated.passed < end and seated.history.is_within_limit for seated in self.blades):
            for link in self.links:
                link.blade.advance(min(end, link.ahead.passed + link.free))
                if not link.blade.history.is_within_limit:
                    left = link.blade.passed if left is None else min(left, link.blade.passed)
                    end = min(end, left + 1)
            slowest = min(seated.passed for seated in self.blades) // self.spec.coating.n_elements
            if progress is not None and slowest > done:
                done = slowest
                progress(done)
        return left

    def results(self) -> tuple[RunResult, ...]:
        """Sum up the run of each blade."""
        return tuple(
            run_result(self.blade, each.spec, each.rule, each.simulation, each.history, each.initial)
            for each in self.blades
        )

    def worn_volume(self) -> np.ndarray:
        """Volume (n_blades,) that each blade has worn off, m³."""
        area = element_area(self.blade, self.spec)
        return np.array([each.worn[: area.size] @ area for each in self.blades])


class _Link(NamedTuple):
    """A blade and the one ahead of it."""

    blade: _Seated
    ahead: _Seated
    free: int  # Elements between them that neither can touch


def _links(blades: list[_Seated], spec: RunSpec, reach: int) -> list[_Link]:
    """Link each blade with the one ahead; those furthest ahead first."""
    n_elements = spec.coating.n_elements
    if len(blades) == 1:
        return [_Link(blades[0], blades[0], n_elements * spec.revolutions)]
    around = sorted(range(len(blades)), key=lambda at: blades[at].row)
    links = []
    for at, next_at in zip(around, [*around[1:], around[0]], strict=True):
        distance = (blades[next_at].row - blades[at].row) % n_elements
        if distance <= reach:
            raise ValueError(
                f"row: blades {at + 1} and {next_at + 1} are {distance} of {n_elements} coating elements "
                f"apart; must be {reach + 1} or more, so that they cannot meet within the displacement limit"
            )
        links.append(_Link(blades[at], blades[next_at], distance - reach))
    return links[::-1]


def _reach(blade: ReducedBlade, spec: RunSpec) -> int:
    """Elements by which a blade must be ahead of another so that none is ever under both."""
    radius, _ = tip_radii(blade)
    per_metre = spec.coating.n_elements / (2 * np.pi * radius.min())
    at_most = spec.tip.half_width + spec.displacement_limit * per_metre  # to either side
    return math.ceil(2 * at_most) + 3  # a node stands anywhere within two elements, rows are whole
