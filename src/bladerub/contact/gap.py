"""Gap between the vibrating tip and the coating, eqs. (7) and (8), a lane a node.

Node and casing meet on the cone of the flow path: displacements are those normal to it (radial) and along the
circumference (tangential). The casing is curved, so a node approaches it by tangential motion too.
"""

from bladerub.numerics.machine_code import inlined
from bladerub.numerics.memory import load
from bladerub.numerics.vectors import absolute, all_lanes, elementwise, sqrt


@inlined
def closest_position(tip, tangential, travel):
    """Position of the point of the casing closest to each node, eq. (7), in elements.

    `tangential` is the displacement (m), `travel` the elements passed since the start of the revolution.
    """
    return load(tip.start, 0) + travel + tangential * load(tip.per_metre, 0)


@inlined
def normal_approach(tip, radial, tangential):
    """Displacement of each node towards the casing, m: minus the product u · n of eq. (8)."""
    outward = load(tip.radius, 0) + radial
    return sqrt(outward * outward + tangential * tangential) - load(tip.radius, 0)


@inlined
def normal(tip, radial, tangential, approach):
    """Direction into the casing at each node, minus the n of eq. (8): radial and tangential component."""
    share = 1.0 / (load(tip.radius, 0) + approach)
    return share * (load(tip.radius, 0) + radial), share * tangential


@inlined
def rotation_distance(tip, angle, approach):
    """Distance by which a rotation by `angle` (rad) moves each displaced node along the casing, m."""
    return angle * (load(tip.lever, 0) + approach)


@elementwise
def penetration(approach, relief, initial_gap, wear):
    """Depth of the tip below the worn surface of an element, m: minus the gap g of eq. (8)."""
    return approach - relief - initial_gap - wear


@inlined
def is_above(tip, radial, tangential, approach, minimum_gap):
    """Whether all nodes are surely above the lowest surface in reach, and within the limit."""
    in_reach = (absolute(tangential) <= tip.search_range) & (absolute(radial) <= tip.limit)
    return all_lanes((approach <= minimum_gap) & in_reach)


@inlined
def is_within_limit(tip, radial, tangential):
    """Whether every displacement is a number below the limit."""
    return all_lanes((absolute(radial) <= tip.limit) & (absolute(tangential) <= tip.limit))
