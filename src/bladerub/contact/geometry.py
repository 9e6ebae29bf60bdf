"""Where the nodes of the vibrating tip are on the casing, a lane a node."""

from __future__ import annotations

from numba import njit

from bladerub.contact.vectors import everywhere, load, magnitude, root


@njit(inline="always")
def rise_of(tip, radial, tangential):
    """Height of each node above its place at rest: tangential vibration closes the clearance too, m."""
    along = load(tip.radius, 0) + radial
    return root(along * along + tangential * tangential) - load(tip.radius, 0)


@njit(inline="always")
def position_of(tip, tangential, passed):
    """Position of each node along the casing, in rows of elements."""
    return load(tip.start, 0) + passed + tangential * load(tip.per_metre, 0)


@njit(inline="always")
def force_of(stator, tip, radial, tangential, rise, push):
    """Radial and tangential force on the blade: along the normal where each node now is, turned by θ."""
    along = load(tip.radius, 0) + radial
    share = push / (load(tip.radius, 0) + rise)
    return (
        share * (stator.radial * along - stator.tangential * tangential),
        share * (stator.radial * tangential + stator.tangential * along),
    )


@njit(inline="always")
def is_within_bounds(tip, radial, tangential):
    """Whether every displacement is a number below the limit."""
    return everywhere((magnitude(radial) <= tip.limit) & (magnitude(tangential) <= tip.limit))
