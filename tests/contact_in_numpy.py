"""The contact model with all its variants in plain NumPy, which the time loop is tested against.

Law of an element, profile of the tip and shape of the casing are those of the package; all else is here.
"""

import itertools
import math
from dataclasses import replace

import numpy as np
import scipy.linalg
import scipy.optimize

from bladerub.contact.casing import shape
from bladerub.contact.laws import module_of
from bladerub.contact.setup import time_step
from bladerub.contact.tip import coverage, edge, relief


def simulate(blade, spec, n_steps, n_modes=None):
    """Simulate from rest; return displacements of the nodes (n_steps, 2 j) and wear (j, N), m."""
    coating = _Coating(blade, spec)
    steps = _steps(blade, spec, n_modes, coating)
    history = np.array([next(steps) for _ in range(n_steps)])
    return history[:, : 2 * blade.n_interface], coating.wear


def element_means(displacement, n_elements):
    """Mean displacement in the passage of each element, from rest on."""
    ends = np.concatenate([[0.0], displacement])
    return (0.5 * (ends[1:] + ends[:-1])).reshape(n_elements, -1).mean(axis=1)


def simulate_row(blade, spec, row, n_steps, n_modes=None):
    """Simulate a row step by step; return displacements (n_blades, n_steps, 2 j) and wear (j, N), m."""
    coatings = [_Coating(blade, spec) for _ in row.blades]
    squares, modes = scipy.linalg.eigh(blade.stiffness(spec.f_omega), blade.mass)
    marches = []
    for coating, own in zip(coatings, row.blades, strict=True):
        coating.node_angle = coating.node_angle + own.angle
        coating.initial_gap = coating.initial_gap - own.length
        factors = own.frequency_factors(len(squares))
        more = blade.mass @ modes @ np.diag(squares * (factors**2 - 1)) @ modes.T @ blade.mass
        damped = replace(spec, damping_ratio=spec.damping_ratio * own.damping)
        marches.append(_steps(replace(blade, stiffness_0=blade.stiffness_0 + more), damped, n_modes, coating))
    wear, histories = coatings[0].wear, []
    for _ in range(n_steps):
        for mode, matrix in enumerate(row.disk.stiffness if row.disk else ()):
            pull = -squares[mode] * np.array(matrix) @ [coating.q[mode] for coating in coatings]
            for coating, own in zip(coatings, pull, strict=True):
                coating.pull[mode] = own
        histories.append([])
        for coating, march in zip(coatings, marches, strict=True):
            coating.wear = wear  # as the others have left it
            histories[-1].append(next(march))
            wear = coating.wear
    return np.array(histories).swapaxes(0, 1)[:, :, : 2 * blade.n_interface], wear


def _steps(blade, spec, n_modes, coating):
    """Integrate step by step; each gives the displacement of the tip."""
    if spec.scheme == "central_differences":
        return _central_differences(blade, spec, coating)
    return _exponential(blade, spec, n_modes or len(blade.mass), coating)


def _central_differences(blade, spec, coating):
    """Integrate eq. (1), M u'' + D u' + K u + F = 0, by the paper's scheme."""
    h = time_step(blade, spec)
    M, K = blade.mass, blade.stiffness(spec.f_omega)  # in the coordinates of eq. (6); K by eq. (2)
    squares, modes = scipy.linalg.eigh(K, M)
    D = M @ modes @ np.diag(2 * spec.damping_ratio * np.sqrt(squares)) @ modes.T @ M  # one ξ in all modes
    inverse = np.linalg.inv(M / h**2 + D / (2 * h))
    tip = tip_rows(blade, spec)
    u, u_before = np.zeros(len(M)), np.zeros(len(M))
    for step in itertools.count(1):
        # eq. (1) at the present step, without contact: prediction
        predicted = inverse @ ((2 * M / h**2 - K) @ u + (D / (2 * h) - M / h**2) @ u_before)
        force = coating.settle(step, h, tip @ predicted)
        u, u_before = predicted + inverse @ (tip.T @ force), u  # correction
        yield tip @ u


def _exponential(blade, spec, n_modes, coating):
    """Integrate eq. (1) mode by mode, exactly for a force held over two steps; condense the fast modes."""
    h = time_step(blade, spec)
    squares, modes = scipy.linalg.eigh(blade.stiffness(spec.f_omega), blade.mass)
    tip = tip_rows(blade, spec) @ modes
    compliance = (tip[:, n_modes:] / squares[n_modes:]) @ tip[:, n_modes:].T
    tip, squares = tip[:, :n_modes], squares[:n_modes]
    # free motion over ±h of z'' + 2 ξ ω z' + ω² z = 0, from the roots of its characteristic equation
    root = np.sqrt(squares) * h * (-spec.damping_ratio + 1j * np.sqrt(1 - spec.damping_ratio**2))
    now, before = 2 * np.exp(root).real, np.abs(np.exp(root)) ** 2
    q, q_before, force = np.zeros(n_modes), np.zeros(n_modes), np.zeros(len(tip))
    for step in itertools.count(1):
        pull = coating.pull[:n_modes]  # of the disk
        rest = (tip.T @ force + pull) / squares  # equilibrium under the forces; the motion about it is free
        q, q_before = rest + now * (q - rest) - before * (q_before - rest), q
        coating.q = q
        force = _implicit_forces(coating, step * h, tip @ q, compliance, force)
        u = tip @ q + compliance @ force
        coating.settle(step, h, u)
        yield u


def _implicit_forces(coating, time, u, compliance, guess):
    if not coating.contact(time, u).any():
        return np.zeros(len(u))

    def imbalance(force):
        return coating.contact(time, u + compliance @ force) - force

    # Broyden's method, and that of Powell where it does not converge
    force, inverse, remaining = guess, np.eye(len(u)), imbalance(guess)
    for _ in range(25):
        if np.abs(remaining).max() < 1e-8:
            return force + remaining
        step = inverse @ remaining
        force = force + step
        before, remaining = remaining, imbalance(force)
        change = inverse @ (before - remaining)
        inverse += np.outer(step - change, step @ inverse) / (step @ change)
    found = scipy.optimize.root(imbalance, guess, tol=1e-12)
    remaining = imbalance(found.x)
    if np.abs(remaining).max() > 1e-6:
        raise RuntimeError(f"contact forces at {time:g} s did not converge: {found.message}")
    return found.x + remaining


class _Coating:
    """The abradable elements around the casing, a ring for each interface node, and their wear so far."""

    def __init__(self, blade, spec):
        self.spec, self.law = spec, module_of(spec.coating.element_law)
        n = spec.coating.n_elements
        x, y, z = blade.node_position.T[:, :, None]  # a row for each interface node
        self.radius, self.node_angle = np.hypot(y, z), spec.casing.start_angle + np.arctan2(y, z)
        outward = np.sum(blade.radial_direction[:, 1:] * blade.node_position[:, 1:], axis=1)[:, None]
        self.curvature_radius = self.radius**2 / outward  # of the conical flow path (Meusnier)
        self.speed = 2 * np.pi * spec.f_omega * blade.f1_hz
        self.angle = (np.arange(n) + 0.5) * 2 * np.pi / n
        edges = np.concatenate([x[:1], (x[1:] + x[:-1]) / 2, x[-1:]])
        area = np.abs(np.diff(edges, axis=0)) * 2 * np.pi * self.radius / n  # share of the chord, times width
        self.element = self.law.element(spec.coating, area, time_step(blade, spec))
        leading, trailing = spec.clearance
        clearance = leading + (trailing - leading) * (x - x[0]) / (x[-1] - x[0])
        casing = spec.casing
        overlap = casing.interference - casing.amplitude + casing.amplitude * shape(casing, self.angle)
        self.initial_gap = clearance - overlap  # g₀ of eq. (8)
        self.wear = np.zeros((blade.n_interface, n))
        reach = math.ceil(edge(spec.tip)) + 1
        self.rows, self.around = np.arange(len(self.wear))[:, None], np.arange(-reach, reach + 1)
        self.strength = np.ones_like(self.wear)
        self.heat = _Heat(spec, self, area, time_step(blade, spec)) if hasattr(self.law, "strength") else None
        self.q, self.pull = np.zeros((2, len(blade.mass)))  # modal coordinates, and forces on them

    def contact(self, time, u):
        """Forces on the tip at the displacement `u`, both as `tip_rows`."""
        u_r, u_t, *tilt = u.reshape(-1, len(self.wear), 1)
        # eq. (7): the closest point of the casing turns with the blade and moves with its vibration
        position = self.node_angle + self.speed * time + u_t / self.radius
        # of the ring under each node, what the profile may carry
        near = np.floor(position / (2 * np.pi) * len(self.angle)).astype(int) + self.around
        near = self.rows, near % len(self.angle)
        offset = (self.angle[near[1]] - position + np.pi) % (2 * np.pi) - np.pi
        offset *= self.spec.coating.n_elements / (2 * np.pi)
        # eq. (8): g = g₀ + (u^m − u^s) · n, under the profile of Fig. 3; u^s is the wear
        R = self.curvature_radius
        approach = np.hypot(R + u_r, u_t) - R - relief(self.spec.tip, offset) + offset * sum(tilt)
        gap = self.initial_gap[near] - approach + self.wear[near]
        # Fig. 4, and eq. (9): no force where the gap is open, and never a pulling one
        share = coverage(self.spec.tip, offset)
        element_force, increment = self.law.return_mapping(self.element, -gap, self.wear[near])
        element_force = share * self.strength[near] * element_force
        self.position, self.near, self.near_force = position, near, element_force
        self.near_increment = increment * (share > 0)
        magnitude = np.sum(element_force, axis=1, keepdims=True)
        couple = np.sum(element_force * offset, axis=1, keepdims=True)
        # F_r = −cos θ |F| e_r and F_θ = −sin θ |F| e_θ, at the displaced node
        direction = np.arctan2(u_t, R + u_r) + self.spec.coating.theta
        force = [-magnitude * np.cos(direction), -magnitude * np.sin(direction)]
        force += [-couple * np.cos(self.spec.coating.theta) for _ in tilt]
        return np.ravel(force)

    def settle(self, step, h, u):
        """Leave the elements as they are at the end of a step; return the forces."""
        force = self.contact(step * h, u)
        if self.heat is not None:
            self.pressed, self.increment = np.zeros((2, *self.wear.shape))
            self.pressed[self.near], self.increment[self.near] = self.near_force, self.near_increment
            self.heat.enter(self)
            self.strength = self.heat.strength(step, self.strength)
        self.wear[self.near] += self.near_increment
        return force


class _Heat:
    """Temperature of the elements, in cells from the surface on, as in `bladerub.extras.laws.heating`."""

    def __init__(self, spec, coating, area, h):
        from bladerub.extras.laws.heating import HEATED, cell_heights

        self.heated = HEATED
        own, n = dict(spec.coating.element_law.parameters), spec.coating.n_elements
        self.law, self.coating, self.area, self.radius = coating.law, spec.coating, area, coating.radius
        self.resistance, self.share = np.sin(spec.coating.theta), own["friction_share"]
        self.height = cell_heights(spec.coating.thickness, own["heated_depth"])
        self.capacity = own["heat_capacity"] * self.height
        period = 2 * np.pi / coating.speed
        self.half = round(period / 2 / h)  # steps
        flow = np.zeros((len(self.height),) * 2)  # of heat into each cell per temperature of each, W/(m² K)
        for cell, height in enumerate(self.height):
            last = cell + 1 == len(self.height)
            through = own["conductivity"] / (0.5 * (height + (0 if last else self.height[cell + 1])))
            flow[cell, cell] -= through
            if not last:
                flow[cell, cell + 1] += through
                flow[cell + 1, cell] += through
                flow[cell + 1, cell + 1] -= through
        self.turn = scipy.linalg.expm(flow / self.capacity[:, None] * period)
        self.first = np.floor(coating.node_angle * n / (2 * np.pi)).astype(int)  # element under each node
        self.rise = np.zeros((*coating.wear.shape, len(self.height)))
        self.energy = np.zeros_like(coating.wear)
        self.before, self.pressed = coating.node_angle, np.zeros_like(coating.wear)

    def enter(self, coating):
        """Enter what flow and friction made in a step."""
        slid = self.radius * (coating.position - self.before)
        self.energy += self.share * self.resistance * slid * 0.5 * (coating.pressed + self.pressed)
        flow = self.law.dissipated_energy(coating.element, coating.wear, coating.increment, 0.0, 0.0)
        self.energy += coating.strength * flow
        self.before, self.pressed = coating.position, coating.pressed

    def strength(self, step, before):
        """Strength after a step; twice a turn that of the half of the casing on the other side changes."""
        if step % self.half:
            return before
        n = before.shape[1]
        passed = step // self.half * (n // 2)
        ring = (np.arange(n) - self.first - passed + n // 2 + n // 4) % n  # (j, N)
        other = ring < n // 2
        area = np.broadcast_to(self.area, before.shape)[other]
        heated = self.energy[other] / area / self.capacity[: self.heated].sum()
        self.rise[other, : self.heated] += heated[:, None]
        self.rise[other] = self.rise[other] @ self.turn.T
        self.energy[other] = 0.0
        parts = self.height / self.law.strength(self.coating, self.rise)
        return np.where(other, self.coating.thickness / np.sum(parts, axis=-1), before)


def tip_rows(blade, spec):
    """Rows (2 j, n), or (3 j, n) with the tilt, from the reduced coordinates to the motion of the tip, m."""
    n = blade.n_interface
    rows = np.zeros((2 * n, len(blade.mass)))
    for j in range(n):
        rows[j, 3 * j : 3 * j + 3] = blade.radial_direction[j]
        rows[n + j, 3 * j : 3 * j + 3] = blade.tangential_direction[j]
    if not spec.tip.turns:
        return rows
    _, y, z = blade.node_position.T
    width = np.hypot(y, z) * 2 * np.pi / spec.coating.n_elements
    curvature = np.sum(blade.radial_direction[:, 1:] * blade.node_position[:, 1:], axis=1) / (y**2 + z**2)
    tilt = blade.tip_slope + curvature[:, None] * rows[n:]
    return np.vstack([rows, width[:, None] * tilt])
