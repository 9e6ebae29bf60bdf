"""Both schemes as slow, obviously right NumPy: no shortcut, no compiled code.

They share with the package only the description of the run. The paper's scheme marches in physical
coordinates, with full matrices inverted as written; the exponential one in modal coordinates, with forces
found by a general root finder.
"""

from __future__ import annotations

import numpy as np
import scipy.linalg
import scipy.optimize


def simulate(blade, spec, n_steps, n_modes):
    """March `n_steps`; return tip displacements (n_steps, 16; radial, tangential) and wear (8, N).

    The exponential scheme resolves the lowest `n_modes` modes.
    """
    if spec.scheme == "central_differences":
        return _central_differences(blade, spec, n_steps)
    return _exponential(blade, spec, n_steps, n_modes)


def time_step(blade, spec):
    passage = 1.0 / (spec.f_omega * blade.f1_hz * spec.coating.n_elements)
    return passage / max(spec.steps_per_element, np.ceil(passage / spec.max_time_step))


def tip_rows(blade):
    """Rows (16, n) that take the radial and tangential displacements of the tip from the coordinates."""
    rows = np.zeros((16, blade.mass.shape[0]))
    for j in range(8):
        rows[j, 3 * j : 3 * j + 3] = blade.radial_direction[j]
        rows[8 + j, 3 * j : 3 * j + 3] = blade.tangential_direction[j]
    return rows


def _central_differences(blade, spec, n_steps):
    h = time_step(blade, spec)
    M, K = blade.mass, blade.stiffness(spec.f_omega)
    squares, modes = scipy.linalg.eigh(K, M)
    D = M @ modes @ np.diag(2 * spec.damping_ratio * np.sqrt(squares)) @ modes.T @ M
    effective = np.linalg.inv(M / h**2 + D / (2 * h))
    tip, ring = tip_rows(blade), Ring(blade, spec)
    u, u_before = np.zeros(len(M)), np.zeros(len(M))
    history = []
    for step in range(1, n_steps + 1):
        predicted = effective @ ((2 * M / h**2 - K) @ u + (D / (2 * h) - M / h**2) @ u_before)
        force = ring.forces(step * h, tip @ predicted)
        ring.keep()
        u, u_before = predicted + effective @ (tip.T @ force), u
        history.append(tip @ u)
    return np.array(history), ring.wear


def _exponential(blade, spec, n_steps, n_modes):
    h, ring = time_step(blade, spec), Ring(blade, spec)
    squares, modes = scipy.linalg.eigh(blade.stiffness(spec.f_omega), blade.mass)
    omega, tip = np.sqrt(squares), tip_rows(blade) @ modes
    fast = np.arange(omega.size) >= n_modes
    yields = tip[:, fast] @ np.diag(1 / squares[fast]) @ tip[:, fast].T
    omega, tip, squares = omega[~fast], tip[:, ~fast], squares[~fast]
    # free motion over ±h of z'' + 2 ξ ω z' + ω² z = 0, from the roots of its characteristic equation
    root = omega * (-spec.damping_ratio + 1j * np.sqrt(1 - spec.damping_ratio**2))
    now, before = 2 * np.exp(root * h).real, np.abs(np.exp(root * h)) ** 2
    q, q_before, force = np.zeros(omega.size), np.zeros(omega.size), np.zeros(16)
    history = []
    for step in range(1, n_steps + 1):
        # the equilibrium under the force is force / ω², and the motion about it is free
        rest = tip.T @ force / squares
        q, q_before = rest + now * (q - rest) - before * (q_before - rest), q
        force = _settled_forces(ring, step * h, tip @ q, yields, force)
        ring.keep()
        history.append(tip @ q + yields @ force)
    return np.array(history), ring.wear


def _settled_forces(ring, time, u, yields, guess):
    """Forces that the coating answers to the displacement they cause."""
    if not ring.forces(time, u).any():
        return np.zeros(16)

    def imbalance(force):
        return ring.forces(time, u + yields @ force) - force

    force = scipy.optimize.root(imbalance, guess, tol=1e-12).x
    remaining = imbalance(force)
    assert np.abs(remaining).max() < 1e-6
    return force + remaining


class Ring:
    """Casing and coating around the tip, with the wear so far."""

    def __init__(self, blade, spec):
        self.blade, self.spec = blade, spec
        self.angle = (np.arange(spec.coating.n_elements) + 0.5) * 2 * np.pi / spec.coating.n_elements
        self.shape = casing_shape(spec.casing, self.angle)
        self.wear = np.zeros((8, spec.coating.n_elements))

    def keep(self):
        """Make the wear of the last forces permanent."""
        self.wear = self._wear

    def forces(self, time, u):
        """Contact forces (16,) on the tip at displacement `u` (16,), from the wear that was kept."""
        blade, spec, wear = self.blade, self.spec, self.wear.copy()
        casing, coating, tip = spec.casing, spec.coating, spec.tip
        n_el = coating.n_elements
        x = blade.node_position[:, 0]
        y, z = blade.node_position[:, 1], blade.node_position[:, 2]
        force = np.zeros(16)
        for j in range(8):
            R = np.hypot(y[j], z[j])
            left = x[j] if j == 0 else (x[j - 1] + x[j]) / 2
            right = x[j] if j == 7 else (x[j] + x[j + 1]) / 2
            bar_area = abs(right - left) * 2 * np.pi * R / n_el
            stiffness = coating.modulus_unit * bar_area / coating.thickness
            clearance = spec.clearance[0] + (spec.clearance[1] - spec.clearance[0]) * (x[j] - x[0]) / (
                x[-1] - x[0]
            )
            gap = clearance + casing.amplitude - casing.interference - casing.amplitude * self.shape

            u_r, u_t = u[j], u[8 + j]
            speed = 2 * np.pi * spec.f_omega * blade.f1_hz
            node_angle = casing.start_angle + np.arctan2(y[j], z[j]) + speed * time + u_t / R
            offset = (self.angle - node_angle + np.pi) % (2 * np.pi) - np.pi
            offset *= n_el / (2 * np.pi)
            share = np.clip(tip.half_width + 0.5 - np.abs(offset), 0, 1)
            height = np.hypot(R + u_r, u_t) - R - tip.edge_drop * (offset / tip.half_width) ** 2
            push = 0.0
            for i in np.flatnonzero(share > 0):
                trial = coating.E * stiffness * (height[i] - gap[i] - wear[j, i])
                if trial <= 0:
                    continue
                limit = (
                    coating.yield_stress * coating.modulus_unit * bar_area
                    + coating.K * stiffness * wear[j, i]
                )
                if trial > limit:
                    shortening = (trial - limit) / ((coating.E + coating.K) * stiffness)
                    wear[j, i] += shortening
                    trial -= coating.E * stiffness * shortening
                push += share[i] * trial
            # along the normal to the casing where the node is, turned by θ against the rotation
            direction = np.arctan2(u_t, R + u_r) + coating.theta
            force[j], force[8 + j] = -push * np.cos(direction), -push * np.sin(direction)
        self._wear = wear
        return force


def casing_shape(casing, angle):
    diameters, weights = np.array(casing.nodal_diameters), np.array(casing.weights)
    fine = np.linspace(0, 2 * np.pi, 72_001)
    return np.cos(np.outer(angle, diameters)) @ weights / np.max(np.cos(np.outer(fine, diameters)) @ weights)
