"""From blade and run to the record of coating and casing that the time loop works on."""

import math
from functools import lru_cache

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact import casing
from bladerub.contact.kernel import records
from bladerub.contact.laws import element_parameters, module_of
from bladerub.contact.schemes import Recurrence, normal_compliance
from bladerub.contact.spec import Casing, Coating, RunSpec
from bladerub.contact.start import ALONE, SEARCH_RANGE, Seat, by_lane_of
from bladerub.contact.strips import element_angle, element_area, first_element, running_clearance
from bladerub.numerics.memory import aligned

_NEVER = 1.0  # gap of a lane without a node, m: nothing moves so far


def stator_record(blade: ReducedBlade, spec: RunSpec, rule: Recurrence, seat: Seat = ALONE) -> records.Stator:
    """Describe coating and casing for the time loop, in rows of elements."""
    coating = spec.coating
    normal_factor, tangential_factor = force_direction(coating)
    compliances = np.split(_self_compliance(rule, coating), [blade.n_interface])
    by_lane = by_lane_of(blade)
    area = by_lane(element_area(blade, spec))
    if coating.is_rigid:
        parameters = np.zeros((len(module_of(coating.element_law).Element._fields), area.size))
    else:
        parameters = element_parameters(coating, area, rule.time_step)
    clearance = tuple(running_clearance(blade, spec).tolist())
    first, width = tuple(first_element(blade, spec).tolist()), spec.tip.half_width + seat.ahead
    gap, lowest = _gaps(spec.casing, clearance, seat.longer, first, coating.n_elements, width, area.size)
    stator = records.Stator(
        initial_gap=gap,
        minimum_gap=lowest,
        law=parameters,
        n_elements=coating.n_elements,
        is_rigid=coating.is_rigid,
        normal_factor=normal_factor,
        tangential_factor=tangential_factor,
        self_compliance=by_lane(compliances[0]),
        coulomb=coating.coulomb,
        further_compliance=by_lane(compliances[1]) if compliances[1].size else compliances[1],
    )
    return aligned(stator)


@lru_cache(maxsize=32)  # the runs of a coating, and of most studies, have the same
def _gaps(
    shape: Casing,
    clearance: tuple[float, ...],
    longer: float,
    first: tuple[int, ...],
    n_elements: int,
    half_width: float,
    lanes: int,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the gaps of `records.Stator`."""
    gap = casing.gap(shape, np.array(clearance)[:, None], element_angle(n_elements)) - longer
    rows = np.array([np.roll(of_node, -shift) for of_node, shift in zip(gap, first, strict=True)])
    unused = np.full((n_elements, lanes - len(rows)), _NEVER)
    return np.hstack([rows.T, unused]), minimum_gap(rows, half_width)


def minimum_gap(rows: np.ndarray, half_width: float) -> np.ndarray:
    """Smallest gap (N,) that any node may meet in the passage of an element, from the gaps (8, N) in rows."""
    reach = half_width + 1 + SEARCH_RANGE + 1  # + 1 each: a node stands anywhere within an element
    half = math.ceil(reach)
    around = np.pad(rows.min(axis=0), half, mode="wrap")
    return np.lib.stride_tricks.sliding_window_view(around, 2 * half + 1).min(axis=1)


def _self_compliance(rule: Recurrence, coating: Coating) -> np.ndarray:
    normal_factor, tangential_factor = force_direction(coating)
    matrix, n = rule.compliance, rule.n_nodes
    forward = np.diag(normal_compliance(matrix, n, normal_factor, tangential_factor))
    backward = np.diag(normal_compliance(matrix, n, normal_factor, -tangential_factor))
    if coating.is_rigid and min(np.min(forward), np.min(backward)) <= 0:
        raise ValueError(
            f"friction {math.tan(coating.theta):g} on the rigid casing: must be so low that no node of this "
            "blade is drawn into the casing by its own friction (Painlevé's paradox)"
        )
    return np.maximum(forward, 0.0)


def force_direction(coating: Coating) -> tuple[float, float]:
    """Direction of the contact force on the blade: −cos θ and −sin θ."""
    return -math.cos(coating.theta), -math.sin(coating.theta)
