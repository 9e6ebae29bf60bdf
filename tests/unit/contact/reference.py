"""The paper's scheme as slow, obviously right NumPy: physical coordinates, no shortcut, no compiled code.

It shares with the package only the description of the run; matrices are full and inverted as written.
"""

from __future__ import annotations

import numpy as np
import scipy.linalg


def simulate(blade, spec, n_steps):
    """March `n_steps`; return tip displacements (n_steps, 16; radial, tangential) and wear (8, N)."""
    n, n_el = blade.mass.shape[0], spec.coating.n_elements
    passage = 1.0 / (spec.f_omega * blade.f1_hz * n_el)
    h = passage / np.ceil(passage / spec.max_time_step)
    M, K = blade.mass, blade.stiffness(spec.f_omega)
    squares, modes = scipy.linalg.eigh(K, M)
    D = M @ modes @ np.diag(2 * spec.damping_ratio * np.sqrt(squares)) @ modes.T @ M
    effective = np.linalg.inv(M / h**2 + D / (2 * h))

    radial = np.zeros((8, n))
    tangential = np.zeros((8, n))
    for j in range(8):
        radial[j, 3 * j : 3 * j + 3] = blade.radial_direction[j]
        tangential[j, 3 * j : 3 * j + 3] = blade.tangential_direction[j]

    angle = (np.arange(n_el) + 0.5) * 2 * np.pi / n_el
    shape = casing_shape(spec.casing, angle)
    u, u_before = np.zeros(n), np.zeros(n)
    wear = np.zeros((8, n_el))
    history = []
    for step in range(1, n_steps + 1):
        predicted = effective @ ((2 * M / h**2 - K) @ u + (D / (2 * h) - M / h**2) @ u_before)
        push = contact(blade, spec, step * h, radial @ predicted, tangential @ predicted, angle, shape, wear)
        force = -push @ (np.cos(spec.coating.theta) * radial + np.sin(spec.coating.theta) * tangential)
        u, u_before = predicted + effective @ force, u
        history.append(np.concatenate([radial @ u, tangential @ u]))
    return np.array(history), wear


def casing_shape(casing, angle):
    diameters, weights = np.array(casing.nodal_diameters), np.array(casing.weights)
    fine = np.linspace(0, 2 * np.pi, 72_001)
    return np.cos(np.outer(angle, diameters)) @ weights / np.max(np.cos(np.outer(fine, diameters)) @ weights)


def contact(blade, spec, time, u_radial, u_tangential, angle, shape, wear):
    """Push of the bars on each node (8,), N; `wear` is changed in place."""
    casing, coating, tip = spec.casing, spec.coating, spec.tip
    n_el = coating.n_elements
    x = blade.node_position[:, 0]
    y, z = blade.node_position[:, 1], blade.node_position[:, 2]
    push = np.zeros(8)
    for j in range(8):
        R = np.hypot(y[j], z[j])
        left = x[j] if j == 0 else (x[j - 1] + x[j]) / 2
        right = x[j] if j == 7 else (x[j] + x[j + 1]) / 2
        bar_area = abs(right - left) * 2 * np.pi * R / n_el
        stiffness = coating.modulus_unit * bar_area / coating.thickness
        clearance = spec.clearance[0] + (spec.clearance[1] - spec.clearance[0]) * (x[j] - x[0]) / (
            x[-1] - x[0]
        )
        gap = clearance + casing.amplitude - casing.interference - casing.amplitude * shape

        speed = 2 * np.pi * spec.f_omega * blade.f1_hz
        node_angle = casing.start_angle + np.arctan2(y[j], z[j]) + speed * time + u_tangential[j] / R
        offset = (angle - node_angle + np.pi) % (2 * np.pi) - np.pi
        offset *= n_el / (2 * np.pi)
        share = np.clip(tip.half_width + 0.5 - np.abs(offset), 0, 1)
        height = (
            np.hypot(R + u_radial[j], u_tangential[j]) - R - tip.edge_drop * (offset / tip.half_width) ** 2
        )
        for i in np.flatnonzero(share > 0):
            trial = coating.E * stiffness * (height[i] - gap[i] - wear[j, i])
            if trial <= 0:
                continue
            limit = (
                coating.yield_stress * coating.modulus_unit * bar_area + coating.K * stiffness * wear[j, i]
            )
            if trial > limit:
                shortening = (trial - limit) / ((coating.E + coating.K) * stiffness)
                wear[j, i] += shortening
                trial -= coating.E * stiffness * shortening
            push[j] += share[i] * trial
    return push
