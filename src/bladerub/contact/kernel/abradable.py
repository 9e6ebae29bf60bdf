"""Contact law of the tip's nodes with the bars of the coating under them, a lane a node.

Rows of bars: row r has for each node the bar that is r elements past the one it stands over at the start of
a revolution, so that all nodes meet the same few rows at the same time.
"""

from __future__ import annotations

import math

from numba import njit

from bladerub.contact import law
from bladerub.contact.kernel.vectors import (
    LANES,
    absolute,
    broadcast,
    largest_lane,
    load,
    load_fields,
    maximum,
    minimum,
    smallest_lane,
    store,
    where,
)
from bladerub.contact.tip import coverage, relief

LEVEL = 1e-12
"""Change of penetration below which the force of a bar is taken as constant over a step, m."""


@njit(inline="always")
def wrap(index, n_elements):
    """Bring an index less than one turn outside into [0, N)."""
    if index >= n_elements:
        return index - n_elements
    if index < 0:
        return index + n_elements
    return index


@njit(inline="always")
def rows_under(tip, behind, ahead):
    """First and last row that the profile covers of any node between positions `behind` and `ahead`."""
    return math.floor(smallest_lane(behind) - tip.half_width), math.floor(
        largest_lane(ahead) + tip.half_width
    )


@njit(forceinline=True)
def push_at(stator, tip, wear, position, rows, rise):
    """Press the bars under each node to the height `rise`, as in Fig. 4, but leave them as they are.

    Returns
    -------
    push, stiffness : vector
        Force of the bars, N, and what it gains per height, N/m.
    margin : vector
        Change of height over which it is linear, m: no bar comes to bear, yields or is let go.
    """
    element = load_fields(law.Element, stator.law)
    push, stiffness, margin = broadcast(0.0), broadcast(0.0), broadcast(math.inf)
    first, last = rows
    for row in range(first, last + 1):
        at = wrap(row, stator.n_elements) * LANES
        offset = (row + 0.5) - position
        share = coverage(tip, offset)
        worn = load(wear, at)
        depth = rise - relief(tip, offset) - load(stator.gap, at) - worn
        force, _ = law.return_mapping(element, depth, worn)
        slope, linear = law.tangent(element, depth, worn)
        push = push + share * force
        stiffness = stiffness + share * slope
        margin = minimum(margin, linear)
    return push, stiffness, margin


@njit(forceinline=True)
def settle(stator, tip, wear, position, rise, position_before, rise_before):
    """Leave the bars as the tip presses them at the end of a step, and account for it.

    An element partly under the tip counts as bars of which a share is under it: as the edge of the profile
    moves on, whole bars are pressed down or let go, at the cost or to the profit of the rotation. Between the
    ends of the step, height and profile go straight from one to the other, and the law of the bars is
    integrated exactly along that way.

    Parameters
    ----------
    position, rise : vector
        Of the nodes at the end of the step: rows, less than N from those before, and m.
    position_before, rise_before : vector
        The same at its start.

    Returns
    -------
    stored : vector
        Elastic energy in the bars, J.
    loss : vector
        Energy taken by wear in this step, J.
    supplied : vector
        Work of the rotation on the bars in this step, J.
    """
    element = load_fields(law.Element, stator.law)
    stored, loss, supplied = broadcast(0.0), broadcast(0.0), broadcast(0.0)
    first, last = rows_under(tip, minimum(position, position_before), maximum(position, position_before))
    way, climb = position - position_before, rise - rise_before
    shift, slope = relief(tip, way), 2.0 * tip.curvature * way
    for row in range(first, last + 1):
        at = wrap(row, stator.n_elements) * LANES
        offset = (row + 0.5) - position
        share, share_before = coverage(tip, offset), coverage(tip, offset + way)
        lowering = slope * offset + shift  # of the profile over this bar, in the step
        worn = load(wear, at)
        depth = rise - relief(tip, offset) - load(stator.gap, at) - worn
        deeper = climb + lowering
        force, shortening = law.return_mapping(element, depth, worn)
        force_before, _ = law.return_mapping(element, depth - deeper, worn)
        under = share > 0.0
        shortening, force = where(under, shortening, 0.0), where(under, force, 0.0)
        store(wear, at, worn + shortening)
        energy, energy_before = law.stored_energy(element, force), law.stored_energy(element, force_before)
        taken = law.dissipated_energy(element, worn, shortening)
        stored = stored + share * energy
        loss = loss + taken
        mean_share = 0.5 * (share + share_before)
        moved = absolute(deeper) > LEVEL
        mean_force = where(moved, (energy - energy_before + taken) / where(moved, deeper, 1.0), force)
        staying = (
            mean_share * mean_force * lowering
            + 0.5 * (energy + energy_before) * (share - share_before)
            + (1.0 - mean_share) * taken
        )
        supplied = supplied + where(
            under,
            where(share_before > 0.0, staying, share * energy + taken),
            broadcast(0.0) - share_before * energy_before,
        )
    return stored, loss, supplied
