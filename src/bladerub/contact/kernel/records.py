"""What the time loop works on: records of arrays, which compiled code sees as addresses.

Rows of elements: row r has for each node the element r past the one it stands over at the start of a
revolution, so that all nodes meet the same few rows at the same time.
"""

from typing import NamedTuple

import numpy as np

from bladerub.contact import law
from bladerub.contact.energy import N_ENTRIES
from bladerub.numerics.lanes import COORDINATES, lanes_for
from bladerub.numerics.memory import aligned
from bladerub.numerics.vectors import LANES

LAYER_NUMBERS = law.Layer.numbers if hasattr(law, "Layer") else 0
"""Numbers of each element that the law keeps to change its force between passages; 0 if it does not."""
N_FORMS = 12  # coefficients of a free flight for each mode (`bladerub.contact.kernel.free_flight`)
_MAY_BE_INFINITE = {"minimum_gap", "sideways"}
"""Fields that are compared only: where there is no casing, and of a tip that moves sideways alone."""


class Stator(NamedTuple):
    """Coating and casing as the blade tip meets them, in rows of elements."""

    # (N, 8): Distance g₀ from the resting tip to the original surface of each element, eq. (8), m
    initial_gap: np.ndarray
    # (N,): By elements passed since the start of the revolution: the smallest of all gaps that any node
    # may meet then, if none moves further than `Tip.search_range` along the casing, m
    minimum_gap: np.ndarray
    # (5, 8): `bladerub.contact.law.Element` of one element under each node, a row for each parameter
    law: np.ndarray
    n_elements: int  # N
    is_rigid: bool  # Whether the tip meets the casing itself instead of elements
    normal_factor: float  # −cos θ and −sin θ: direction of the force on the blade
    tangential_factor: float
    # (8,): Retreat of each node per unit of its own contact force in that direction, as the law of
    # contact sees it, m/N
    self_compliance: np.ndarray
    # Whether the tangential part of the force follows the sliding of the node by Coulomb's law
    coulomb: bool = False
    # (8,): The same of a further coordinate per unit of its own force, where there is one
    further_compliance: np.ndarray = np.empty(0)


class Tip(NamedTuple):
    """Where the interface nodes are, in element widths, and the profile they carry."""

    # (8,): Position of each node at the start of a revolution, in rows: within [0, 1), and how far the blade
    # is ahead (`bladerub.contact.start.Seat`)
    start: np.ndarray
    per_metre: np.ndarray  # (8,): Elements per metre of tangential displacement
    radius: np.ndarray  # (8,): Radius of curvature of the path of each node along the casing, m
    lever: np.ndarray  # (8,): Distance of each node from the axis of rotation, m
    half_width: float  # Of the profile, elements
    curvature: float  # Of the profile, m per element width squared
    search_range: float  # Tangential displacement up to which `Stator.minimum_gap` holds, m
    limit: float  # Displacement beyond which the run is unbounded, m


class State(NamedTuple):
    """All that changes during a run."""

    # (3, n): Modal coordinates now, one and two steps before, padded with zeros to whole vectors
    q: np.ndarray
    # (3, 32): Radial and tangential displacement of the tip at the same times, a further coordinate of its
    # nodes, and their approach (m)
    u: np.ndarray
    # (2, 24): Contact forces on the blade now and one step before, radial and tangential (N), and along the
    # further coordinates
    force: np.ndarray
    # (2, 8): Of each node at the same times: size of the contact force (N), its moment about the axis (N
    # m), and its tangential factor, that of the stator or what friction mobilises of it
    normal_force: np.ndarray
    moment: np.ndarray
    tangential_factor: np.ndarray
    # (24,): Coordinates of the tip by the forces of the last step in that step: where the search for forces
    # begins
    response: np.ndarray
    # (32,): Sliding of the tip without the forces of this step as in `u`, but for the angle of rotation
    free_sliding: np.ndarray
    wear: np.ndarray  # (N, 8): Permanent shortening of the elements, in the rows of `Stator`, m
    # Where the law has a layer, which changes between passages (`bladerub.contact.laws`), else without rows:
    strength: np.ndarray  # (N, 8): Forces of the elements over those by the law alone
    taken: np.ndarray  # (N, 16): What flow, then friction took there since the last passage, J
    layer: np.ndarray  # (N, 8 n): The n numbers that it keeps of each element
    ledger: np.ndarray  # (18, 8): Entries of `bladerub.contact.energy`, to be summed over the nodes
    scratch: np.ndarray  # (6, 16): Of no meaning between steps


COATING = ("wear", "strength", "taken", "layer")  # what of `State` belongs to the coating


def by_lane(rows: np.ndarray, n_nodes: int) -> np.ndarray:
    """Give each group of `n_nodes` rows a row for every lane.

    Lanes without a node move as the last node does, and never touch: they hold up nothing.
    """
    groups = rows.reshape(-1, n_nodes, *rows.shape[1:])
    node = np.minimum(np.arange(lanes_for(n_nodes)), n_nodes - 1)
    return groups.take(node, axis=1).reshape(-1, *rows.shape[1:])


def at_rest(n_modes: int, n_elements: int) -> State:
    """State of a blade at rest before an unworn coating."""
    shape = shapes(n_modes + -n_modes % LANES, n_elements)
    state = State(*(np.zeros(shape[name]) for name in State._fields))
    state.strength[:] = 1.0
    return aligned(state)


def shapes(n: int, n_elements: int) -> dict:
    """Shape of each array that the loop reads by address, by its field; `n` modes are whole vectors."""
    layered = n_elements if LAYER_NUMBERS else 0
    lanes, tip = (LANES,), COORDINATES * LANES
    of_modes, of_elements = (n,), (n_elements, LANES)
    return {
        **dict.fromkeys(("now", "before", "loss", "gain"), of_modes),
        **dict.fromkeys(("compliance", "mobility"), (tip, tip)),
        **dict.fromkeys(("stopping", "start", "per_metre", "radius", "lever", "self_compliance"), lanes),
        "tip": (n // LANES, tip, LANES),
        "forms": (n // LANES, N_FORMS, LANES),
        "initial_gap": of_elements,
        "minimum_gap": (n_elements,),
        "law": (len(law.Element._fields), LANES),
        "further_compliance": lanes if COORDINATES > 2 else (0,),
        "q": (3, n),
        "u": (3, 4 * LANES),
        "force": (2, 3 * LANES),
        **dict.fromkeys(("normal_force", "moment", "tangential_factor"), (2, LANES)),
        "response": (3 * LANES,),
        "free_sliding": (4 * LANES,),
        "wear": of_elements,
        "strength": (layered, LANES),
        "taken": (layered, 2 * LANES),
        "layer": (layered, LAYER_NUMBERS * LANES),
        "ledger": (N_ENTRIES, LANES),
        "scratch": (6, 2 * LANES),
    }


def check(record: NamedTuple, shapes: dict) -> None:
    """Check a record before compiled code reads it by address, where nothing is checked any more.

    Raises `ValueError`, which names the field, unless each array is a contiguous one of finite doubles, in
    the shape that it must have, and each number is finite (or infinite where that has a meaning).
    """
    for name, part in record._asdict().items():
        field = f"{type(record).__name__}.{name}"
        if isinstance(part, np.ndarray):
            shape = shapes[name]
            if part.dtype != float or part.shape != shape or not part.flags.c_contiguous:
                requirement = f"must be contiguous doubles {shape}"
                raise ValueError(f"{field}: {part.dtype} {part.shape}, strides {part.strides}; {requirement}")
        if not np.isfinite(part).all() and (name not in _MAY_BE_INFINITE or np.isnan(part).any()):
            raise ValueError(f"{field}: is no finite number everywhere; check blade, law and config")
