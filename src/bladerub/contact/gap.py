"""Where the nodes of the vibrating tip are on the casing, a lane a node."""

from __future__ import annotations

from numba import njit

from bladerub.contact.kernel.vectors import absolute, all_lanes, load, sqrt


@njit(inline="always")
def rise_of(tip, radial, tangential):
    """Height of each node above its place at rest: tangential vibration closes the clearance too, m."""
    along = load(tip.radius, 0) + radial
    return sqrt(along * along + tangential * tangential) - load(tip.radius, 0)


@njit(inline="always")
def position_of(tip, tangential, passed):
    """Position of each node along the casing, in rows of elements."""
    return load(tip.start, 0) + passed + tangential * load(tip.per_metre, 0)


@njit(inline="always")
def normal_of(tip, radial, tangential, rise):
    """Outward normal of the casing where each node now is, by its own radial and tangential direction."""
    share = 1.0 / (load(tip.radius, 0) + rise)
    return share * (load(tip.radius, 0) + radial), share * tangential


@njit(inline="always")
def force_of(stator, along, normal_radial, normal_tangential, push):
    """Radial and tangential force on the blade: along the normal where each node now is, turned by θ.

    `along`, of each node, is ``stator.tangential`` or what friction leaves of it.
    """
    return (
        push * (stator.radial * normal_radial - along * normal_tangential),
        push * (stator.radial * normal_tangential + along * normal_radial),
    )


@njit(inline="always")
def is_within_bounds(tip, radial, tangential):
    """Whether every displacement is a number below the limit."""
    return all_lanes((absolute(radial) <= tip.limit) & (absolute(tangential) <= tip.limit))
