"""Circumferential profile of the blade tip under one interface node (Fig. 3).

The profile is a parabola. It carries elements up to ``half_width`` on either side of the node. An element at
the edge is partly covered: its force counts by the covered share, which fades over the width of one element,
from ``half_width - 0.5`` to ``half_width + 0.5``. The parabola goes on to there. So the force does not jump
when an element passes the edge, and the shares always add up to the width of the profile.
"""

from bladerub.numerics.vectors import absolute, elementwise, maximum, minimum


@elementwise
def relief(tip, offset):
    """Depth of the profile below its highest point (Fig. 3), m.

    Parameters
    ----------
    tip : bladerub.contact.spec.TipProfile
        Or the time loop's record of the tip.
    offset : float
        Tangential distance from the node, in element widths.
    """
    return tip.curvature * (offset * offset)


@elementwise
def coverage(tip, offset):
    """Share (0 to 1) of an element that the profile covers (Fig. 3).

    Parameters
    ----------
    tip : bladerub.contact.spec.TipProfile
        Or the time loop's record of the tip.
    offset : float
        Tangential distance of the element's centre from the node, in element widths.
    """
    return maximum(minimum(tip.half_width + 0.5 - absolute(offset), 1.0), 0.0)
