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

    initial_gap: np.ndarray  # (N, 8): Distance g₀ from the resting tip to each unworn element, eq. (8), m
    # (N,): By elements passed since the start of the revolution: the smallest of all gaps that any node
    # may meet then, if none moves further than `Tip.search_range` along the casing, m
    minimum_gap: np.ndarray
    law: np.ndarray  # (5, 8): `bladerub.contact.law.Element` of an element under each node, a row a parameter
    n_elements: int  # N
    is_rigid: bool  # Whether the tip meets the casing itself instead of elements
    normal_factor: float  # −cos θ and −sin θ: direction of the force on the blade
    tangential_factor: float
    self_compliance: np.ndarray  # (8,): Retreat of each node per unit of its own force in that direction, m/N
    coulomb: bool = False  # Whether the tangential force follows the sliding of the node by Coulomb's law
    further_compliance: np.ndarray = np.empty(0)  # (8,): The same of a further coordinate, if there is one


class Tip(NamedTuple):
    """Where the interface nodes are, in element widths, and the profile they carry."""

    start: np.ndarray  # (8,): Row of each node at the start of a revolution, in [0, 1) but for `Seat.ahead`
    per_metre: np.ndarray  # (8,): Elements per metre of tangential displacement
    radius: np.ndarray  # (8,): Radius of curvature of the path of each node along the casing, m
    lever: np.ndarray  # (8,): Distance of each node from the axis of rotation, m
    half_width: float  # Of the profile, elements
    curvature: float  # Of the profile, m per element width squared
    search_range: float  # Tangential displacement up to which `Stator.minimum_gap` holds, m
    limit: float  # Displacement beyond which the run is unbounded, m


class State(NamedTuple):
    """All that changes during a run."""

    q: np.ndarray  # (3, n): Modal coordinates now, one and two steps before, in whole vectors
    u: np.ndarray  # (3, 32): Displacement of the tip then: radial, tangential, further; and its approach, m
    force: np.ndarray  # (2, 24): Contact forces now and a step before: radial, tangential (N), further
    normal_force: np.ndarray  # (2, 8): Size of the contact force of each node at the same times, N
    moment: np.ndarray  # (2, 8): Its moment about the axis, N m
    tangential_factor: np.ndarray  # (2, 8): That of the stator, or what friction mobilises of it
    response: np.ndarray  # (24,): Coordinates of the tip by the last forces: where their search begins
    free_sliding: np.ndarray  # (32,): Sliding without the forces of this step, as `u`; the rotation last
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
