"""The time loop of a row: its blades pass the elements together, each by `bladerub.contact.kernel.loop`.

A disk that couples the blades acts on them by impulses, half of each before and half after the passage of an
element: the splitting of Strang (1968), of second order in the time of the passage.
"""

from collections.abc import Sequence
from itertools import chain
from typing import NamedTuple

import numpy as np
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from bladerub.contact.kernel.loop import Progress, Records, Simulation, integrate
from bladerub.contact.laws import solver_digest
from bladerub.numerics.machine_code import inlined, njit_on_disk, within
from bladerub.numerics.memory import WIDTH, add_to_number, address_of, place_at, read, write
from bladerub.numerics.vectors import LANES


class Coupling(NamedTuple):
    """How the disk couples N blades by the first k of their mass-normalised modes; k = 0 if it is stiff."""

    # (k, N, N): Change of the modal velocity of one blade in half a passage of an element, per unit of the
    # modal coordinate of another, 1/s
    impulse: np.ndarray
    # (k, N): Modal coordinate one step ago per unit of modal velocity now, in free motion, s
    backward: np.ndarray
    # (k, N): Kinetic energy per ``(q⁺ − q)²`` and elastic energy per ``q⁺ q``, 1/s²
    kinetic: np.ndarray
    elastic: np.ndarray


class RowSimulation:
    """Blades and the coating that they share, ready to be integrated.

    Blade b is over row ``first[b]`` of the elements at the start, at rest until ``begins[b]`` elements have
    passed, and ``apart[b]`` elements ahead of the next one behind it. Up to `at_once` elements pass before
    those half-way between two blades, if they conduct heat, are seen to. `work` (N,) is what the disk has
    done on each blade, J.
    """

    def __init__(
        self,
        blades: Sequence[Simulation],
        first: Sequence[int],
        begins: Sequence[int],
        coupling: Coupling,
        apart: Sequence[int],
        at_once: int,
    ):
        self.blades, self.coupling = blades, coupling  # whose arrays stay alive here
        self.first, self.begins, self.apart, self.at_once = np.array(first), np.array(begins), apart, at_once
        self.work = np.zeros(len(blades))
        self._kinds = blades[0].records
        self._rows = rows_of([blade.records for blade in blades])

    def advance(self, displacement: np.ndarray, first: int) -> tuple[int, list[Progress]]:
        """Integrate the passage of n elements, from the one that is the `first` since the start.

        `displacement` (N, n) is filled as by `Simulation.advance`, and left as it is for a blade at rest.
        Returns the number of elements passed and what each blade did: all end with the element in which one
        leaves the displacement limit.
        """
        (n_blades, n), blade = displacement.shape, self.blades[0]
        counts = np.zeros((n_blades, 3), dtype=np.int64)
        ranges = np.full((n_blades, 2), (np.inf, -np.inf))
        travel, at_once = 0, self.at_once if blade.layer else n
        while travel < n:
            part = np.ascontiguousarray(displacement[:, travel : travel + at_once])
            over = (self.first + first + travel) % blade.stator.n_elements
            n_passed, within = _integrate_row(
                *(self._kinds, self._rows, blade.steps_per_element, over, self.begins - first - travel),
                *(part, counts, ranges, self.coupling, self.work),
            )
            displacement[:, travel : travel + at_once] = part
            if blade.layer and (within or n_blades > 1):  # a single run that ends does not rest, either
                self._rest(first + travel, n_passed)
            travel += n_passed
            if not within:
                break
        return travel, [
            Progress(*map(int, count), *map(float, extent))
            for count, extent in zip(counts, ranges, strict=True)
        ]

    def _rest(self, first: int, n_elements: int) -> None:
        """Let the elements half-way to the blades behind be, after `n_elements` more elements."""
        blade = self.blades[0]
        for row, apart in zip(self.first + first, self.apart, strict=True):
            row -= (apart - self.at_once) // 2
            blade.layer.rest(blade.state, row, row + n_elements, apart / blade.stator.n_elements)


def rows_of(blades: Sequence[Records]) -> np.ndarray:
    """Put the records of each blade into a row of 64 bits a field, for `records_at`."""
    rows = np.zeros((len(blades), sum(map(len, blades[0]))), dtype=np.int64)
    for row, records in zip(rows, blades, strict=True):
        for column, part in enumerate(chain(*records)):
            (row.view(float) if isinstance(part, float) else row)[column] = part
    return rows


@intrinsic
def records_at(context, kinds, address):
    """Load the `Records` of a blade from its row at `address`, see `rows_of`.

    `kinds` are those of any of the blades: truth values are the same for all.
    """

    def generate(context, builder, signature, arguments):
        row, records = 0, []
        for kind, record in zip(kinds, cgutils.unpack_tuple(builder, arguments[0]), strict=True):
            parts = cgutils.unpack_tuple(builder, record)
            for number, part in enumerate(kind):
                if isinstance(part, types.Integer | types.Float):
                    place = place_at(builder, arguments[1], row + number, context.get_value_type(part))
                    parts[number] = builder.load(place)
            row += len(parts)
            records.append(context.make_tuple(builder, kind, parts))
        return context.make_tuple(builder, kinds, records)

    return kinds(kinds, types.intp), generate


@njit_on_disk(solver_digest(), nogil=True)
def _integrate_row(
    kinds, rows, steps_per_element, over, begins, displacement, counts, ranges, coupling, work
):
    n_blades, n_elements = displacement.shape
    is_coupled = coupling.impulse.shape[0] > 0
    is_flying, reach = np.zeros(n_blades, dtype=np.bool_), np.zeros(n_blades)
    element, within = 0, True
    while element < n_elements and within:
        if is_coupled:
            _couple(coupling, kinds, rows, work, begins, element)
        together = 1
        for b in range(n_blades):
            if element < begins[b]:
                continue
            records = _records(kinds, rows, b)
            n_around = records.stator.n_elements
            row = (over[b] + element) % n_around
            if n_blades == 1 and not is_coupled:  # adds up what is summed as a single run does
                together = min(n_elements - element, n_around - row)
            mean = displacement.ctypes.data + 8 * (n_elements * b + element)
            is_flying[b], reach[b], n_steps, n_flights, n_contact, lowest, highest = integrate(
                records, steps_per_element, row, row + together, is_flying[b], reach[b], mean
            )
            counts[b, 0] += n_steps
            counts[b, 1] += n_flights
            counts[b, 2] += n_contact
            ranges[b, 0] = min(ranges[b, 0], lowest)
            ranges[b, 1] = max(ranges[b, 1], highest)
            within = within and n_steps == together * steps_per_element
        if is_coupled:
            _couple(coupling, kinds, rows, work, begins, element)
            is_flying[:] = False  # what `reach` bounds was the motion without the impulse
        element += together
    return element, within


@inlined
def _records(kinds, rows, b):
    """Load the records of blade `b`."""
    return records_at(kinds, rows.ctypes.data + 8 * rows.shape[1] * b)


@within
def _couple(coupling, kinds, rows, work, begins, element):
    """Change the velocities by half an impulse of the disk, and enter its work.

    A velocity stands in the coordinates of one step before; so does that of the tip, whose path the work of
    the contact forces is found from.
    """
    n_modes, n_blades = coupling.backward.shape
    for b in range(n_blades):
        if element < begins[b]:  # it is held
            continue
        records = _records(kinds, rows, b)
        modal, state = records.modal, records.state
        tip_before = address_of(state.u, 4 * LANES)
        for k in range(n_modes):
            velocity = 0.0
            for other in range(n_blades):
                velocity += coupling.impulse[k, b, other] * read(_records(kinds, rows, other).state.q, k)
            present, before = read(state.q, k), read(state.q, modal.n + k)
            change = coupling.backward[k, b] * velocity
            shifted = before + change
            write(state.q, modal.n + k, shifted)
            work[b] += coupling.kinetic[k, b] * ((present - shifted) ** 2 - (present - before) ** 2)
            work[b] += coupling.elastic[k, b] * present * change
            shape = address_of(modal.tip, WIDTH * (k - k % LANES) + k % LANES)  # of mode k, at the tip
            for row in range(WIDTH):
                add_to_number(tip_before, row, read(shape, LANES * row) * change)
