"""The paper's contact model on a page of NumPy: eqs. (1), (7), (8) and (9), Figs. 3 and 4, and θ.

Slow and direct, in the paper's symbols, without tables, shortcuts or compiled code. The time loop is tested
against it. To see the model at work:

    history, wear = simulate(blade, spec, n_steps=20_000)
"""

from dataclasses import replace

import numpy as np
import scipy.linalg

from bladerub.blade.model import ReducedBlade
from bladerub.contact import casing, law
from bladerub.contact.modes import at_tip, tip_radii
from bladerub.contact.setup import time_step
from bladerub.contact.spec import RunSpec
from bladerub.contact.strips import element_angle, element_area, running_clearance
from bladerub.contact.tip import coverage, relief


def simulate(blade: ReducedBlade, spec: RunSpec, n_steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Simulate a blade on an abradable coating by central differences with prediction and correction.

    Parameters
    ----------
    blade : ReducedBlade
        The blade, with j interface nodes.
    spec : RunSpec
        The run, from rest, here by the paper's scheme and a step that suits it. Coulomb friction, the rigid
        casing, other laws of the coating and a tip that turns are left to the time loop.
    n_steps : int
        Time steps.

    Returns
    -------
    history : (n_steps, 2 j) ndarray
        Radial, then tangential displacement of the interface nodes after each step, m.
    wear : (j, N) ndarray
        Permanent shortening of the elements, m.
    """
    h = time_step(blade, replace(spec, scheme="central_differences"))
    N, θ, ξ = spec.coating.n_elements, spec.coating.theta, spec.damping_ratio
    Ω = 2 * np.pi * spec.f_omega * blade.f1_hz
    e_r, e_θ = np.split(at_tip(blade, np.eye(len(blade.mass))), 2)  # rows over the coordinates of eq. (6)
    r, R = (radius[:, None] for radius in tip_radii(blade))  # of the nodes, and of curvature of their paths
    φ = spec.casing.start_angle + np.arctan2(*blade.node_position.T[1:])[:, None]
    β = element_angle(N)
    g_0 = casing.gap(spec.casing, running_clearance(blade, spec)[:, None], β)
    element = law.element(spec.coating, element_area(blade, spec)[:, None])

    # eq. (1), M u'' + D u' + K u = F in the coordinates of eq. (6), F on the blade (the paper has it on the
    # left, but gives the components of that on the blade); K by eq. (2), ξ alike in all modes
    M, K = blade.mass, blade.stiffness(spec.f_omega)
    squares, Φ = scipy.linalg.eigh(K, M)
    D = M @ Φ @ np.diag(2 * ξ * np.sqrt(squares)) @ Φ.T @ M
    inverse = np.linalg.inv(M / h**2 + D / (2 * h))
    u, u_before, history = np.zeros(len(M)), np.zeros(len(M)), np.empty((n_steps, 2 * len(r)))
    u_s = np.zeros((len(r), N))  # displacement of the surface of the coating: its wear

    for step in range(n_steps):
        # prediction: eq. (1) at the present time, without contact
        predicted = inverse @ ((2 * M / h**2 - K) @ u + (D / (2 * h) - M / h**2) @ u_before)
        u_r, u_θ = (e_r @ predicted)[:, None], (e_θ @ predicted)[:, None]
        # eq. (7): the closest point of the casing turns with the blade and moves with its vibration
        y = φ + Ω * (step + 1) * h + u_θ / r
        x = ((β - y + np.pi) % (2 * np.pi) - np.pi) * N / (2 * np.pi)  # of each element, in their widths
        # eq. (8): g = g₀ + (u^m − u^s) · n, n out of the coating, under the profile of Fig. 3
        g = g_0 - (np.hypot(R + u_r, u_θ) - R - relief(spec.tip, x)) + u_s
        # eq. (9): t_N ≥ 0, g ≥ 0, t_N g = 0, where the coating answers to the penetration by Fig. 4
        t_N, increment = law.return_mapping(element, -g, u_s)
        pressed = coverage(spec.tip, x)
        u_s = u_s + increment * (pressed > 0)
        F = np.sum(pressed * t_N, axis=1, keepdims=True)
        # F_r = −cos θ |F| e_r and F_θ = −sin θ |F| e_θ, at the displaced node
        direction = np.arctan2(u_θ, R + u_r) + θ
        force = -(e_r.T @ (F * np.cos(direction)) + e_θ.T @ (F * np.sin(direction)))[:, 0]
        # correction
        u, u_before = predicted + inverse @ force, u
        history[step] = np.concatenate([e_r @ u, e_θ @ u])
    return history, u_s
