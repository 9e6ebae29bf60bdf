"""The imbalance of the energy ledger is the error of the time step, and shrinks with it.

Source: the ledger's quadratures are of second order in the step, and the blade's own balance holds to
rounding (`bladerub.contact.schemes`, contract 5); what is left over is the coating's. Expected: order 2.
"""

import numpy as np
import pytest


@pytest.mark.parametrize(
    ("E", "K", "theta", "f_omega", "turns"),
    [
        (1.1, 0.5, 0.0, 0.12, False),
        (20.0, 10.0, 0.0, 0.31, False),
        (1.1, 0.5, 0.15, 0.31, False),
        (1.1, 0.5, 0.15, 0.31, True),
    ],
)
def test_residual_is_of_second_order(run, E, K, theta, f_omega, turns):
    steps = np.array([20, 40, 80, 160])
    residual = [
        abs(run(E, K, f_omega, theta, turns=turns, revolutions=4, steps_per_element=n).energy.residual)
        for n in steps
    ]
    order = -np.polyfit(np.log(steps), np.log(residual), 1)[0]
    print(f"E = {E}, K = {K}, theta = {theta}, f_omega = {f_omega}: order {order:.2f}, residual {residual}")
    assert order > 1.7
    assert residual[0] < 1e-3
