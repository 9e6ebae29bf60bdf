"""The tilt of a tip profile that turns with the blade (`bladerub.contact.tip`), a lane a node.

Each function takes the address ``modal.tilt`` of the rows of tilt, or None where the profile keeps its angle.
The compiler then takes the function in the decorator, and so leaves out what follows from a tilt.
"""

from collections.abc import Callable

from numba import types
from numba.extending import overload

from bladerub.contact.tip import highest
from bladerub.numerics.machine_code import INLINED
from bladerub.numerics.memory import (
    add_lane_products,
    add_to_number,
    address_of,
    broadcast_lanes,
    load,
    no_lane_sums,
    read,
    store,
    sum_of_lane_products,
)
from bladerub.numerics.vectors import LANES, absolute, broadcast, lane_sums

PLACE = 3 * LANES
"""Where the tilt is among the displacements of the tip: after radial, tangential and approach."""
COUPLE = 2 * LANES
"""Where the couples are among the contact forces: after radial and tangential."""


def _without_tilt(otherwise: Callable) -> Callable:
    def decorate(function):
        @overload(function, strict=False, jit_options=INLINED)
        def choose(rows, *_):
            return otherwise if isinstance(rows, types.NoneType) else function

        return function

    return decorate


@_without_tilt(lambda rows: broadcast(0.0))
def no_sums(rows):
    """Give the sums to which `add` adds."""
    return no_lane_sums()


@_without_tilt(lambda rows, k, x, sums: sums)
def add(rows, k, x, sums):
    """Add what the modes `x`, from mode k on, tilt."""
    return add_lane_products(sums, address_of(rows, LANES * k), x)


@_without_tilt(lambda rows, sums: sums)
def total(rows, sums):
    """Tilt of each node, m per element."""
    return lane_sums(sums)


@_without_tilt(lambda rows, force: broadcast(0.0))
def couples(rows, force):
    """Each couple in all lanes of a vector, for `by_couples`."""
    return broadcast_lanes(address_of(force, COUPLE))


@_without_tilt(lambda rows, k, couple_lanes: couple_lanes)
def by_couples(rows, k, couple_lanes):
    """Modal force of the couples on the modes from mode k on."""
    return sum_of_lane_products(address_of(rows, LANES * k), couple_lanes)


@_without_tilt(lambda rows, u, tilt: None)
def store_tilt(rows, u, tilt):
    """Store the tilt with the displacement of the tip."""
    store(u, PLACE, tilt)


@_without_tilt(lambda rows, u: broadcast(0.0))
def load_tilt(rows, u):
    """Load the tilt stored with a displacement of the tip."""
    return load(u, PLACE)


@_without_tilt(lambda rows, k, change, u: None)
def move(rows, k, change, u):
    """Add to the tilt stored with a displacement what a `change` of mode k alone makes of it."""
    for row in range(LANES):
        by = read(rows, LANES * (LANES * (k // LANES) + row) + k % LANES)
        add_to_number(u, PLACE + row, by * change)


@_without_tilt(lambda rows, approach, tilt, offset: approach)
def raised(rows, approach, tilt, offset):
    """Approach of the profile to the casing at `offset` elements from the node, m."""
    return approach + tilt * offset


@_without_tilt(lambda rows, tip, approach, tilt: approach)
def furthest(rows, tip, approach, tilt):
    """Largest approach of any point of the profile under the node, m."""
    return approach + highest(tip, absolute(tilt))
