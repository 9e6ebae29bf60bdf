"""What the paper's statements speak of, and how close to them this model, of another blade, has to come."""

from bladerub.study.grid import CoatingCase

CASING, THETA = "2nd", 0.0  # section "Mechanical properties of the abradable coating"
SOFTEST, STIFFEST = 0.11, 20.0  # E_min and E_max of that section; below E_min nothing dangerous happens
CRITICAL_E, CRITICAL_K = 1.1, 0.5  # of the greatest Y4 and Y6
STIFFENING_FROM = 0.5  # f4 increases with K for E above this
SOFT_HARDENING = 0.1  # up to this K the Young modulus hardly matters
TILTED_SPEED, STRAIGHT_SPEED = 0.190, 0.197  # divergence with θ = 0.15 and with θ = 0 (Figs. 17 and 18)

WORN = CoatingCase("2nd5nd", 11.0, 0.5, 0.0)  # Figs. 6 and 7
SOFT = CoatingCase(CASING, SOFTEST, 0.5, THETA)  # Figs. 8 and 10
CRITICAL = CoatingCase(CASING, CRITICAL_E, CRITICAL_K, THETA)  # Fig. 9
STRAIGHT = CoatingCase(CASING, 2.0, 0.5, THETA)  # Fig. 15
TILTED = CoatingCase(CASING, 2.0, 0.5, 0.15)  # Fig. 16
RIGID = CoatingCase.rigid(CASING, friction=0.0)  # direct contact with the casing

ORDERS = (4, 6)  # engine orders of the paper's peaks: Y4, f4, Y6 and f6

HISTORIES = {
    (case, f_omega) for case in (STRAIGHT, TILTED) for f_omega in (TILTED_SPEED, STRAIGHT_SPEED, 0.206)
}
"""Coatings and speeds whose histories the paper shows (Figs. 17 and 18), and the f6 of this blade."""

NEAR = 0.025
"""How far a speed may lie from the paper's, normalised: a line's width in its maps and another C1."""

FIVE_LOBES = ((0.0, 0.08), (0.24, 0.34))  # speeds between which five lobes are worn (Fig. 6)
TEN_LOBES, FOUR_LOBES = 0.1, 0.38  # speeds of ten and of four worn lobes (Figs. 6 and 7)
SIGNIFICANT = 0.1  # share of the greatest value from which on a value still shows in a plot
HARDLY = {"amplitude": 0.2, "f_peak": 0.01}  # differences that are hardly any: of Y relative, of f normalised
