"""Modal coordinates from step to step, eight in a vector, and the displacement of the tip that they make."""

from typing import NamedTuple

import numpy as np

from bladerub.contact.kernel import tilt
from bladerub.contact.kernel.records import by_lane
from bladerub.contact.schemes import Recurrence
from bladerub.numerics.machine_code import inlined
from bladerub.numerics.memory import (
    add_products,
    address_of,
    aligned,
    broadcast_each,
    load,
    no_sums,
    read,
    store,
    sum_of_products,
)
from bladerub.numerics.vectors import LANES, broadcast, halves, lane_sums

ROWS = 2 * LANES
"""Coordinates of the tip: radial displacement of each node, then tangential."""


class Modal(NamedTuple):
    """A `Recurrence` as the time loop reads it: modes padded with zeros to whole vectors."""

    n: int  # Number of modes, a multiple of 8
    now: np.ndarray  # (n,): Coefficients of the recurrence
    before: np.ndarray
    loss: np.ndarray
    # (n / 8, 16, 8): Displacement of the tip per unit of each mode, a block for each vector of modes
    tip: np.ndarray
    gain: np.ndarray  # (n,): Modal coordinates per unit of modal force
    # (16, 16): Displacement of the tip in the step of each force itself, m/N; (24, 24) with the tilt
    compliance: np.ndarray
    corrects: bool  # Whether forces act in the step they are evaluated in
    # (16, 16) or (24, 24): Displacement of the tip in a step, as `bladerub.contact.friction` counts it, per
    # unit of each force of the step, by the modes that the scheme resolves, m/N
    mobility: np.ndarray
    # (8,): The most that tangential forces of 1 N on all nodes take from the sliding distance of each, m
    stopping: np.ndarray
    tilt: np.ndarray | None  # (n / 8, 8, 8): Tilt of the profile per unit of each mode, where it turns


def pack(rule: Recurrence) -> Modal:
    """Arrange the coefficients of a scheme for the time loop."""
    n = rule.n_nodes
    tip = by_lane(rule.tip, n)
    mobility = (1.0 if rule.corrects else 0.5) * (rule.tip * rule.gain) @ rule.tip.T
    modal = Modal(
        n=rule.now.size + -rule.now.size % LANES,
        now=_padded(rule.now),
        before=_padded(rule.before),
        loss=_padded(rule.loss),
        tip=in_vectors(tip[:ROWS]),
        gain=_padded(rule.gain),
        compliance=_by_lane_both(rule.compliance, n),
        corrects=rule.corrects,
        mobility=_by_lane_both(mobility, n),
        stopping=by_lane(np.abs(mobility[n : 2 * n, n : 2 * n]).sum(axis=1), n),
        tilt=in_vectors(tip[ROWS:]) if len(tip) > ROWS else None,
    )
    return aligned(modal)


def _by_lane_both(matrix: np.ndarray, n_nodes: int) -> np.ndarray:
    return by_lane(by_lane(matrix, n_nodes).T, n_nodes).T


def _padded(rows: np.ndarray) -> np.ndarray:
    n = rows.shape[-1]
    padded = np.zeros((*rows.shape[:-1], n + -n % LANES))
    padded[..., :n] = rows
    return padded


def in_vectors(rows: np.ndarray) -> np.ndarray:
    """Arrange rows (r, n) of modes in blocks (n / 8, r, 8), one for each vector of modes."""
    padded = _padded(rows)
    return padded.reshape(len(rows), -1, LANES).swapaxes(0, 1)


@inlined
def advance_free(modal, q, q1, q2):
    """Move the modes freely by one step, in place of the oldest coordinates `q2`; project them on the tip.

    Returns the displacement of the tip (radial, tangential, m), the interface rows of eq. (6), its tilt (m
    per element), and the damping loss of the step before, spread over the lanes (J): its end is known only
    now.
    """
    loss = broadcast(0.0)
    sums, tilts = no_sums(), tilt.no_sums(modal.tilt)
    for k in range(0, modal.n, LANES):
        x, modal_loss = _recur(modal, k, q, q1, q2)
        loss = loss + modal_loss
        store(q2, k, x)
        sums, tilts = add_tip_displacement(modal, k, x, sums), tilt.add(modal.tilt, k, x, tilts)
    return *tip_displacement(sums), tilt.total(modal.tilt, tilts), loss


@inlined
def advance_forced(modal, force, q, q1, q2):
    """Move the modes as `advance_free`, under the contact forces (24,) of the step before."""
    loss = broadcast(0.0)
    forces, couples = broadcast_each(force), tilt.couples(modal.tilt, force)
    for k in range(0, modal.n, LANES):
        x, modal_loss = _recur(modal, k, q, q1, q2)
        loss = loss + modal_loss
        store(q2, k, x + _by_forces(modal, k, forces, couples))
    return *_project(modal, q2), loss


@inlined
def correct(modal, force, q):
    """Add the effect of contact forces (24,) to the modal coordinates; project these on the tip."""
    forces, couples = broadcast_each(force), tilt.couples(modal.tilt, force)
    for k in range(0, modal.n, LANES):
        store(q, k, load(q, k) + _by_forces(modal, k, forces, couples))
    return _project(modal, q)


@inlined
def _recur(modal, k, q, q1, q2):
    present = load(q, k)
    change = present - load(q2, k)
    x = load(modal.now, k) * present - load(modal.before, k) * load(q1, k)
    return x, load(modal.loss, k) * change * change


@inlined
def _by_forces(modal, k, forces, couples):
    by_forces = sum_of_products(address_of(modal.tip, ROWS * k), forces)
    return load(modal.gain, k) * (by_forces + tilt.by_couples(modal.tilt, k, couples))


@inlined
def _project(modal, q):
    sums, tilts = no_sums(), tilt.no_sums(modal.tilt)
    for k in range(0, modal.n, LANES):
        x = load(q, k)
        sums, tilts = add_tip_displacement(modal, k, x, sums), tilt.add(modal.tilt, k, x, tilts)
    return *tip_displacement(sums), tilt.total(modal.tilt, tilts)


@inlined
def add_tip_displacement(modal, k, x, sums):
    """Add to a sum for each coordinate of the tip what the modes `x`, from mode k on, displace at the tip."""
    return add_products(sums, address_of(modal.tip, ROWS * k), x)


@inlined
def tip_displacement(sums):
    """Radial and tangential displacement of the tip from the sums: the interface rows of eq. (6), m."""
    radial, tangential = halves(sums)
    return lane_sums(radial), lane_sums(tangential)


@inlined
def displaced(rows, response, force, radial, tangential, tilted):
    """Add to the displacement of the tip what contact forces (24,) cause, a row of `response` for each.

    Couples have a part in it where the profile turns, where `rows` is ``modal.tilt`` and not None.
    """
    width = ROWS if rows is None else ROWS + LANES
    more_radial = more_tangential = more_tilted = broadcast(0.0)  # two sums at the same time
    for i in range(0, width, 2):
        by, by_next = read(force, i), read(force, i + 1)
        radial = radial + load(response, width * i) * by
        tangential = tangential + load(response, width * i + LANES) * by
        more_radial = more_radial + load(response, width * (i + 1)) * by_next
        more_tangential = more_tangential + load(response, width * (i + 1) + LANES) * by_next
        if rows is not None:
            tilted = tilted + load(response, width * i + ROWS) * by
            more_tilted = more_tilted + load(response, width * (i + 1) + ROWS) * by_next
    return radial + more_radial, tangential + more_tangential, tilted + more_tilted
