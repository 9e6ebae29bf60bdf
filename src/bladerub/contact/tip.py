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
def mean_coverage(share, share_before, per_advance):
    """Mean of `coverage` while it goes from `share_before` to `share`.

    `per_advance` is one over the elements that the tip passes meanwhile, one at most. The share changes by as
    much, or by less where it leaves 0 or 1 on the way, or reaches them. Under a `half_width` below 1 it may
    rise and fall meanwhile, which this misses.
    """
    change = absolute(share - share_before)
    bend = 0.5 * change * (1.0 - change * per_advance)
    gap = 1.0 - maximum(share, share_before)
    return 0.5 * (share + share_before) + where(gap > 0.0, 0.0 - bend, bend)


@elementwise
def highest(tip, tilt):
    """Height of the highest point of a profile above the node, m, under a `tilt` of 0 or more (m/element)."""
    offset = minimum(tilt / (2.0 * tip.curvature), edge(tip))
    return offset * (tilt - tip.curvature * offset)
