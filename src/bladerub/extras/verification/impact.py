"""Contact with the rigid casing by an integrator of its own, with other treatments of impact.

With the time loop it shares the modes of the blade and the description of the run, no more. It is for a
casing of any shape without friction. A `Rule` is made by one of

* `moreau_jean`: impulses change the velocity of the nodes that the step would take into the casing, by
  Newton's law of restitution (Jean, Comput. Methods Appl. Mech. Eng. 177 (1999) 235). Midpoint rule.
* `massless_boundary`: some modes move, all others respond by their static displacement, as if they had no
  mass (Monjaraz-Tec, Gross and Krack, Comput. Struct. 260 (2022) 106698). Forces keep the nodes out.
* `penalty`: the casing is a spring under each node.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit

from bladerub.blade.model import ReducedBlade
from bladerub.contact.casing import shape
from bladerub.contact.modes import Modes, tip_radii
from bladerub.contact.spec import RunSpec

_ANGLES = 72_000  # at which the shape of the casing is taken; linear between

TOLERANCE = 1e-10  # change of an impulse, over the largest, at which the impulses of a step have converged
MAX_SWEEPS = 1000


class Rule(NamedTuple):
    """One step of each mode, and what impulses (16,) on the tip add to it."""

    flow: np.ndarray  # (4, n): Free motion, q⁺ = flow[0] q + flow[1] v and v⁺ = flow[2] q + flow[3] v
    kick: np.ndarray  # (2, n): Changes of q⁺ and v⁺ per unit of modal impulse, s and 1
    tip: np.ndarray  # (n, 16): Displacement of the tip per unit of each mode, kg^-1/2
    shift: np.ndarray  # (16, 16): Displacement of the tip at the end of the step per unit of impulse, s/kg
    softness: float  # Depth of the casing's surface there per unit of impulse, s/kg
    bounce: np.ndarray  # (16, 16): Velocity of the tip per unit of impulse, 1/kg
    restitution: float  # Of the velocity; NaN where impulses limit the position


class Wall(NamedTuple):
    """The casing as the nodes meet it: arrays (8,) in m and rad."""

    curvature_radius: np.ndarray  # Of the path of each node
    radius: np.ndarray  # Distance of each node from the axis of rotation
    angle: np.ndarray  # Of each node at the start
    clearance: np.ndarray  # Gap where the shape is 0
    inward: np.ndarray  # (n,): Inward displacement of the casing at even angles from 0 on
    slope: np.ndarray  # (n,): Its derivative, m
    speed: float  # Of rotation, rad/s


class Motion(NamedTuple):
    """Outcome of a run; fields as in `bladerub.contact.result.RunResult`."""

    radial_displacement: np.ndarray
    revolution_peak: np.ndarray
    revolution_amplitude: np.ndarray


def moreau_jean(modes: Modes, damping_ratio: float, step: float, restitution: float) -> Rule:
    """Set up Moreau's time stepping for all of `modes`, at a `step` in s."""
    x = modes.omega * step
    implicit = 1 + damping_ratio * x + x**2 / 4
    pull, keep = -modes.omega * x / implicit, (1 - damping_ratio * x - x**2 / 4) / implicit
    flow = np.array([1 + step / 2 * pull, step / 2 * (1 + keep), pull, keep])
    bounce = (modes.tip / implicit) @ modes.tip.T
    kick = np.array([step / 2 / implicit, 1 / implicit])
    return Rule(flow, kick, np.ascontiguousarray(modes.tip.T), step / 2 * bounce, 0.0, bounce, restitution)


def massless_boundary(modes: Modes, damping_ratio: float, step: float, n_modes: int) -> Rule:
    """Set up the motion of the first `n_modes` of `modes` and the static displacement of all others."""
    static = (modes.tip[:, n_modes:] / modes.omega[n_modes:] ** 2) @ modes.tip[:, n_modes:].T
    return _by_position(first(modes, n_modes), damping_ratio, step, static, 0.0)


def penalty(modes: Modes, damping_ratio: float, step: float, stiffness: float) -> Rule:
    """Set up the motion of all of `modes` against springs of `stiffness` (N/m)."""
    return _by_position(modes, damping_ratio, step, np.zeros((2 * modes.n_nodes,) * 2), 1 / stiffness)


def first(modes: Modes, n_modes: int | None) -> Modes:
    """Return the first `n_modes` of `modes`, all by default."""
    return Modes(modes.omega[:n_modes], modes.tip[:, :n_modes], modes.n_nodes)


def _by_position(modes: Modes, damping_ratio: float, step: float, static: np.ndarray, soft: float) -> Rule:
    """Exact free motion; the force of a step acts at its start, such that its end agrees with the contact."""
    damped = modes.omega * math.sqrt(1 - damping_ratio**2)
    decay, sine = np.exp(-damping_ratio * modes.omega * step), np.sin(damped * step) / damped
    cosine, slope = np.cos(damped * step), damping_ratio * modes.omega * sine
    flow = decay * np.array([cosine + slope, sine, -(modes.omega**2) * sine, cosine - slope])
    shift = (modes.tip * flow[1]) @ modes.tip.T + static / step
    tip = np.ascontiguousarray(modes.tip.T)
    return Rule(flow, flow[[1, 3]], tip, shift, soft / step, 0 * shift, math.nan)


def time_step(blade: ReducedBlade, spec: RunSpec) -> float:
    """Step of which there are ``spec.steps_per_element`` in the passage of an element, s."""
    return 1 / (spec.f_omega * blade.f1_hz * spec.coating.n_elements * spec.steps_per_element)


def simulate(rule: Rule, blade: ReducedBlade, spec: RunSpec) -> Motion:
    """Simulate a run on the rigid casing by `rule`, which was set up for its `time_step`."""
    casing, (leading, trailing), (x, y, z) = spec.casing, spec.clearance, blade.node_position.T
    angle = np.arange(_ANGLES) * 2 * np.pi / _ANGLES
    inward = casing.amplitude * shape(casing, angle)
    radius, curvature_radius = tip_radii(blade)
    wall = Wall(
        curvature_radius,
        radius,
        casing.start_angle + np.arctan2(y, z),
        leading + (trailing - leading) * (x - x[0]) / (x[-1] - x[0]) + casing.amplitude - casing.interference,
        inward,
        (np.roll(inward, -1) - np.roll(inward, 1)) * _ANGLES / (4 * np.pi),
        2 * np.pi * spec.f_omega * blade.f1_hz,
    )
    start = np.zeros(len(rule.tip))
    start[0] = spec.initial_displacement / rule.tip[0, 0]
    counts = (spec.revolutions, spec.coating.n_elements, spec.steps_per_element)
    mean, low, high = _march(rule, wall, time_step(blade, spec), counts, start)
    return Motion(mean.ravel(), np.maximum(abs(low), abs(high)), (high - low) / 2)


@njit(error_model="numpy", fastmath={"contract", "reassoc"})
def _march(rule, wall, step, counts, q):
    """Integrate; return radial displacement of node 1: mean in each passage, range in each revolution."""
    revolutions, n_elements, steps = counts
    mean = np.zeros((revolutions, n_elements))
    low, high = np.full(revolutions, np.inf), np.full(revolutions, -np.inf)
    v, before = np.zeros_like(q), np.zeros_like(q)
    for i in range(revolutions * n_elements * steps):
        u = np.zeros(rule.tip.shape[1])
        for m in range(q.size):
            before[m], coordinate, flow = v[m], q[m], rule.flow[:, m]
            q[m], v[m] = flow[0] * coordinate + flow[1] * v[m], flow[2] * coordinate + flow[3] * v[m]
            for k in range(u.size):
                u[k] += q[m] * rule.tip[m, k]
        turned = wall.speed * step * ((i + 1) % (n_elements * steps))
        angle = wall.angle + turned + u[wall.radius.size :] / wall.radius
        depth = _depth(wall, u, angle)
        if depth.max() > 0:
            impulse = _impulse(rule, wall, u, angle, depth, before @ rule.tip, v @ rule.tip)
            modal = rule.tip @ impulse
            u += rule.shift @ impulse
            q += rule.kick[0] * modal
            v += rule.kick[1] * modal
        revolution, remainder = divmod(i, n_elements * steps)
        mean[revolution, remainder // steps] += u[0] / steps
        low[revolution], high[revolution] = min(low[revolution], u[0]), max(high[revolution], u[0])
    return mean, low, high


@njit
def _depth(wall, u, angle):
    """Depth (8,) of each node below the surface of the casing, m, at its `angle` there."""
    n = wall.radius.size
    distance = np.hypot(wall.curvature_radius + u[:n], u[n:])
    return distance - wall.curvature_radius - wall.clearance + _at(wall.inward, angle)


@njit
def _at(table, angle):
    """Interpolate a table over the turn, linearly."""
    place = angle * table.size / (2 * np.pi)
    below = np.floor(place)
    share = place - below
    first = below.astype(np.int64)
    return (1 - share) * table[first % table.size] + share * table[(first + 1) % table.size]


@njit(error_model="numpy")
def _impulse(rule, wall, u, angle, depth, before, free):
    """Impulses (16,) on the tip at `u`, whose velocity is `before` and, without them, `free` (16,)."""
    n = wall.radius.size
    radial, tangential = wall.curvature_radius + u[:n], u[n:]
    length = np.hypot(radial, tangential)
    normal = np.concatenate((radial / length, tangential / length))
    by_angle = _at(wall.slope, angle)  # of the depth
    deeper = normal.copy()  # depth by displacement
    deeper[n:] += by_angle / wall.radius
    by_velocity = not math.isnan(rule.restitution)
    full = rule.bounce if by_velocity else rule.shift
    full = deeper.reshape(-1, 1) * full * normal
    retreat = rule.softness * np.eye(n)  # of each node by the normal impulse on each
    for i in range(2 * n):
        for j in range(2 * n):
            retreat[i % n, j % n] += full[i, j]
    excess = depth
    if by_velocity:
        impact, onward = deeper * before, deeper * free
        impact = impact[:n] + impact[n:] + by_angle * wall.speed
        onward = onward[:n] + onward[n:] + by_angle * wall.speed
        excess = np.where(depth > 0, onward + rule.restitution * np.maximum(impact, 0.0), -np.inf)
    magnitude = _complementary(retreat, excess)
    return -normal * np.concatenate((magnitude, magnitude))


@njit(error_model="numpy")
def _complementary(retreat, excess):
    """Solve ``0 <= p`` complementary to ``retreat p - excess >= 0`` by projected Gauss-Seidel sweeps."""
    p = np.zeros_like(excess)
    for _ in range(MAX_SWEEPS):
        change = 0.0
        for j in range(p.size):
            p_new = max(0.0, p[j] + (excess[j] - np.sum(retreat[j] * p)) / retreat[j, j])
            change = max(change, abs(p_new - p[j]))
            p[j] = p_new
        if change <= TOLERANCE * p.max():
            break
    return p
