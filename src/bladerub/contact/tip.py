"""Circumferential profile of the blade tip under one interface node (Fig. 3).

The profile is a parabola. It carries elements up to ``half_width`` on either side of the node. An element at
the edge is partly covered: its force counts by the covered share, which fades over the width of one element,
from ``half_width - 0.5`` to ``half_width + 0.5``. The parabola goes on to there. So the force does not jump
when an element passes the edge, and the shares always add up to the width of the profile.
"""

from bladerub.numerics.vectors import absolute, elementwise, maximum, minimum, where


@elementwise
def relief(tip, offset):
    """Depth of the profile below its highest point (Fig. 3), m, at `offset` element widths from the node.

    `tip` is a `bladerub.contact.spec.TipProfile`, or the time loop's record of the tip.
    """
    return tip.curvature * (offset * offset)


@elementwise
def edge(tip):
    """Distance from the node to where the profile ends, in element widths."""
    return tip.half_width + 0.5


@elementwise
def coverage(tip, offset):
    """Share (0 to 1) of an element that the profile covers (Fig. 3); its centre is `offset` from the node."""
    return maximum(minimum(edge(tip) - absolute(offset), 1.0), 0.0)


@elementwise
def covered_distance(tip, offset):
    """Integral of `coverage` over the offset from 0 to `offset`, in element widths."""
    share = coverage(tip, offset)
    rest = 0.5 * share * share + maximum(edge(tip) - absolute(offset) - 1.0, 0.0)  # what is left of it
    distance = tip.half_width - rest
    return where(offset > 0.0, distance, 0.0 - distance)


@elementwise
def highest(tip, tilt):
    """Height of the highest point of a profile above the node, m, under a `tilt` of 0 or more (m/element)."""
    offset = minimum(tilt / (2.0 * tip.curvature), edge(tip))
    return offset * (tilt - tip.curvature * offset)
