"""Exact motion of an elastic bar that falls on, or is thrown at, a rigid wall.

The impacting and the bouncing bar of Doyen, Ern and Piperno, Time-integration schemes for the finite element
dynamic Signorini problem, SIAM Journal on Scientific Computing 33 (2011) 223-249. All is per unit of
cross-section, heights count away from the wall, and time τ from the first touch, which finds the bar
undeformed and coming at `speed`.

In the frame that falls freely with the bar, d'Alembert's waves run over a free bar with a force F at its end.
The wave that F sends out returns from the free end after the crossing time T = 2L/c and doubles where it
arrives, so the end moves at

    w′(τ) = (F(τ) + 2 F(τ − T) + 2 F(τ − 2T) + ...) / (ρ c)                                    (1)

while the wall comes at v + gτ. Touching means that the two speeds are one, and gives the force:

    F(τ) = ρ c (v + gτ) − 2 F(τ − T) − 2 F(τ − 2T) − ...                                       (2)

First contact: F = ρc (v + gτ) for 0 < τ < T. Then (2) would be ρc (2gT − v − gτ), negative after T where
v > gT: the end leaves. The impulse ρc (vT + gT²/2) over ρL is 2v + gT, and the frame has come down to v + gT:
the centre of mass leaves upward at v again.
"""

import numpy as np

LENGTH, MODULUS, DENSITY = 10.0, 900.0, 1.0  # m, Pa, kg/m³
WAVE_SPEED = np.sqrt(MODULUS / DENSITY)
IMPEDANCE = DENSITY * WAVE_SPEED  # ρ c: stress per change of speed, Pa s/m
T = 2 * LENGTH / WAVE_SPEED
SPEED, GRAVITY = 10.0, 10.0
"""Thrown at 10 m/s without gravity (impacting) or dropped from 5 m with it (bouncing): 10 m/s at touch."""


def first_force(gravity, tau):
    """F(τ) of the first contact, Pa; 0 outside of it."""
    return np.where((tau >= 0) & (tau < T), IMPEDANCE * (SPEED + gravity * tau), 0.0)


def second_force(tau):
    """F(τ) of the second contact where it begins at 4T, that is for v = 3gT/2 as in the benchmark, Pa.

    By (2) F(4T + s) = ρc (v + 4gT + gs) − 2 F(s) = ρc (4gT − v − gs): the first contact run backwards. The
    waves cancel, w′ = 8gT is uniform from 5T on, and the bar leaves undeformed at v.
    """
    s = tau - 4 * T
    return np.where((s >= 0) & (s < T), IMPEDANCE * (4 * GRAVITY * T - SPEED - GRAVITY * s), 0.0)
