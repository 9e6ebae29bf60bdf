import multiprocessing

import numpy as np
import pytest
from scipy import sparse
from scipy.linalg import eigh

from bladerub.blade import linear
from bladerub.blade.linear import factorise, lowest_modes


@pytest.fixture
def pair():
    """A symmetric positive stiffness and mass of a chain with random springs."""
    rng = np.random.default_rng(3)
    n = 60
    springs = rng.uniform(1, 5, n + 1)
    stiffness = sparse.diags_array(
        [springs[:-1] + springs[1:], -springs[1:-1], -springs[1:-1]], offsets=[0, 1, -1]
    )
    return stiffness.tocsc(), sparse.diags_array(rng.uniform(0.5, 2, n)).tocsc()


def test_solves_for_one_and_for_many(pair):
    stiffness, _ = pair
    solve = factorise(stiffness)
    rhs = np.random.default_rng(0).standard_normal((60, 3))
    np.testing.assert_allclose(stiffness @ solve(rhs), rhs, atol=1e-12)
    np.testing.assert_allclose(stiffness @ solve(rhs[:, 0]), rhs[:, 0], atol=1e-12)


def test_threads_leave_large_matrices_their_bits(pair, monkeypatch):
    grid = sparse.csc_array(sparse.kronsum(sparse.kronsum(pair[0][:20, :20], pair[0][:20, :20]), pair[0]))
    rhs = np.random.default_rng(0).standard_normal((grid.shape[0], 4))
    both = factorise(grid)(rhs)
    monkeypatch.setattr(linear, "THREADS", 1)
    np.testing.assert_array_equal(factorise(grid)(rhs), both)


def test_a_fork_solves_as_well(pair):
    """The threads of the solver are not in it: a job of a pool of processes once waited for ever."""

    def solve_in_fork():
        rhs = np.ones(60)
        np.testing.assert_allclose(pair[0] @ factorise(pair[0])(rhs), rhs, atol=1e-12)

    factorise(pair[0])
    process = multiprocessing.get_context("fork").Process(target=solve_in_fork)
    process.start()
    process.join(30)
    process.kill()
    assert process.exitcode == 0


def test_lowest_modes_agree_with_a_dense_solver(pair):
    stiffness, mass = pair
    frequencies, modes = lowest_modes(stiffness, mass, 5)
    squares = eigh(stiffness.toarray(), mass.toarray(), eigvals_only=True)[:5]
    np.testing.assert_allclose((2 * np.pi * frequencies) ** 2, squares, rtol=1e-10)
    np.testing.assert_allclose(modes.T @ (mass @ modes), np.eye(5), atol=1e-12)
    again = lowest_modes(stiffness, mass, 5, factorise(stiffness))[1]
    np.testing.assert_array_equal(modes, again)


def test_unstable_mode_has_a_negative_frequency(pair):
    stiffness, mass = pair
    lowest = lowest_modes(stiffness, mass, 1)[0][0]
    shifted = sparse.csc_array(stiffness - 2 * (2 * np.pi * lowest) ** 2 * mass)
    assert lowest_modes(shifted, mass, 2)[0][0] == pytest.approx(-lowest, rel=1e-9)
