"""What the time loop works on: records of arrays, which compiled code sees as addresses.

Rows of elements: row r has for each node the element r past the one it stands over at the start of a
revolution, so that all nodes meet the same few rows at the same time.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bladerub.contact.energy import N_ENTRIES
from bladerub.numerics.vectors import LANES, aligned


class Stator(NamedTuple):
    """Coating and casing as the blade tip meets them, in rows of elements.

    Parameters
    ----------
    initial_gap : (N, 8) ndarray
        Distance g₀ from the resting tip to the original surface of each element, eq. (8), m.
    minimum_gap : (N,) ndarray
        By elements passed since the start of the revolution: the smallest of all gaps that any node may meet
        then, if none moves further than `Tip.search_range` along the casing, m.
    law : (5, 8) ndarray
        `bladerub.contact.law.Element` of one element under each node, a row for each parameter.
    n_elements : int
        N.
    is_rigid : bool
        Whether the tip meets the casing itself instead of elements.
    normal_factor, tangential_factor : float
        −cos θ and −sin θ: direction of the force on the blade.
    self_compliance : (8,) ndarray
        Retreat of each node per unit of its own contact force in that direction, as the law of contact sees
        it, m/N.
    coulomb : bool
        Whether the tangential part of the force follows the sliding of the node by Coulomb's law.
    """

    initial_gap: np.ndarray
    minimum_gap: np.ndarray
    law: np.ndarray
    n_elements: int
    is_rigid: bool
    normal_factor: float
    tangential_factor: float
    self_compliance: np.ndarray
    coulomb: bool = False


class Tip(NamedTuple):
    """Where the interface nodes are, in element widths, and the profile they carry.

    Parameters
    ----------
    start : (8,) ndarray
        Position of each node at the start of a revolution, in rows, within [0, 1).
    per_metre : (8,) ndarray
        Elements per metre of tangential displacement.
    radius : (8,) ndarray
        Radius of curvature of the path of each node along the casing, m.
    lever : (8,) ndarray
        Distance of each node from the axis of rotation, m.
    half_width : float
        Of the profile, elements.
    curvature : float
        Of the profile, m per element width squared.
    search_range : float
        Tangential displacement up to which `Stator.minimum_gap` holds, m.
    limit : float
        Displacement beyond which the run is unbounded, m.
    """

    start: np.ndarray
    per_metre: np.ndarray
    radius: np.ndarray
    lever: np.ndarray
    half_width: float
    curvature: float
    search_range: float
    limit: float


class State(NamedTuple):
    """All that changes during a run.

    Parameters
    ----------
    q : (3, n) ndarray
        Modal coordinates now, one and two steps before, padded with zeros to whole vectors.
    u : (3, 24) ndarray
        Radial and tangential displacement of the tip at the same times, and the approach of its nodes, m.
    force : (2, 16) ndarray
        Contact forces on the blade now and one step before, N.
    normal_force, moment, tangential_factor : (2, 8) ndarray
        Of each node at the same times: size of the contact force (N), its moment about the axis (N m), and
        its tangential factor, that of the stator or what friction mobilises of it.
    response : (16,) ndarray
        Displacement of the tip by the forces of the last step in that step: where the search for forces
        begins, m.
    free_sliding : (24,) ndarray
        Sliding of the tip without the forces of this step: radial and tangential, m, and angle of rotation.
    wear : (N, 8) ndarray
        Permanent shortening of the elements, in the rows of `Stator`, m.
    ledger : (16, 8) ndarray
        Entries of `bladerub.contact.energy`, to be summed over the nodes.
    scratch : (5, 16) ndarray
        Of no meaning between steps.
    """

    q: np.ndarray
    u: np.ndarray
    force: np.ndarray
    normal_force: np.ndarray
    moment: np.ndarray
    tangential_factor: np.ndarray
    response: np.ndarray
    free_sliding: np.ndarray
    wear: np.ndarray
    ledger: np.ndarray
    scratch: np.ndarray


def at_rest(n_modes: int, n_elements: int) -> State:
    """State of a blade at rest before an unworn coating."""
    state = State(
        q=np.zeros((3, n_modes + -n_modes % LANES)),
        u=np.zeros((3, 3 * LANES)),
        force=np.zeros((2, 2 * LANES)),
        normal_force=np.zeros((2, LANES)),
        moment=np.zeros((2, LANES)),
        tangential_factor=np.zeros((2, LANES)),
        response=np.zeros(2 * LANES),
        free_sliding=np.zeros(3 * LANES),
        wear=np.zeros((n_elements, LANES)),
        ledger=np.zeros((N_ENTRIES, LANES)),
        scratch=np.zeros((5, 2 * LANES)),
    )
    return aligned(state)
