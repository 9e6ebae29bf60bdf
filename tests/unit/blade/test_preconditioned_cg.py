import numpy as np
import pytest
from scipy import sparse
from scipy.linalg import eigh

from bladerub.blade import linear
from bladerub.blade.linear import factorise
from bladerub.blade.preconditioned_cg import PreconditionedCG


@pytest.fixture
def near(make_block):
    """Stiffness and mass of a bar, factors of it, and a stiffness that is near."""
    bar = make_block(size=(0.02, 0.01, 0.3), counts=(1, 1, 6), origin=(0.01, 0.0, 0.3), clamp_bottom=True)
    u = np.random.default_rng(2).standard_normal(bar.free.size)
    rest, strained = bar.tangent(np.zeros_like(u)), bar.tangent(2e-6 * u)
    return rest, bar.mass, factorise(rest), strained


@pytest.fixture
def factored(monkeypatch):
    """Count the matrices that get factors of their own."""
    made = []

    def counted(matrix):
        made.append(matrix.shape)
        return factorise(matrix)

    monkeypatch.setattr(linear, "factorise", counted)
    return made


def test_near_factors_solve_for_one_and_for_many(near, factored):
    *_, factors, strained = near
    rhs = np.random.default_rng(0).standard_normal((strained.shape[0], 3))
    exact = factorise(strained)(rhs)
    assert np.linalg.norm(factors(rhs) - exact) > 1e-3 * np.linalg.norm(exact)
    for columns in (slice(None), 0):
        error = PreconditionedCG(strained, factors)(rhs[:, columns]) - exact[:, columns]
        assert np.linalg.norm(error) < 1e-7 * np.linalg.norm(exact)
    assert not factored


def test_modes_come_from_those_of_a_near_matrix(near, factored):
    rest, mass, factors, strained = near
    _, start = linear.lowest_modes(rest, mass, 5, factors)
    frequencies, modes = PreconditionedCG(strained, factors).lowest_modes(mass, start)
    squares, before_squares = (
        eigh(matrix.toarray(), mass.toarray(), eigvals_only=True) for matrix in (strained, rest)
    )
    rounding = np.finfo(float).eps * squares[-1] / squares[0]  # of the dense solver, in the lowest square
    exact, before = (np.sqrt(of[:5]) / (2 * np.pi) for of in (squares, before_squares))
    assert np.abs(before / exact - 1).max() > 1e-5
    np.testing.assert_allclose(frequencies, exact, rtol=max(1e-9, rounding))
    np.testing.assert_allclose(modes.T @ (mass @ modes), np.eye(5), atol=1e-10)
    assert not factored


def test_a_matrix_that_is_not_near_gets_its_own_factors(near, factored):
    rest, mass, factors, _ = near
    frequencies, start = linear.lowest_modes(rest, mass, 3, factors)
    unstable = sparse.csc_array(rest - (2 * np.pi * 1.1 * frequencies[0]) ** 2 * mass)
    rhs = np.ones(rest.shape[0])
    solve = PreconditionedCG(unstable, factors)
    for _ in range(2):
        np.testing.assert_allclose(solve(rhs), factorise(unstable)(rhs), rtol=1e-8)
    assert len(factored) == 1
    strange = np.random.default_rng(1).standard_normal(start.shape)
    far = sparse.csc_array(sparse.diags_array(np.geomspace(1, 1e9, rest.shape[0])) @ rest)
    far = sparse.csc_array(far + far.T)
    found, _ = PreconditionedCG(far, factors).lowest_modes(mass, strange)
    np.testing.assert_allclose(found, linear.lowest_modes(far, mass, 3)[0], rtol=1e-7)
