import multiprocessing

import numpy as np
import pytest
from scipy import sparse
from scipy.linalg import eigh

from bladerub.blade import linear
from bladerub.blade.linear import PreconditionedCG, factorise, lowest_modes
from bladerub.blade.reduction import Partition, internal_solve, mass_orthonormal, project, transformation
from bladerub.blade.rotation import equilibrium


@pytest.fixture
def pair():
    rng = np.random.default_rng(3)
    n = 60
    springs = rng.uniform(1, 5, n + 1)
    stiffness = sparse.diags_array(
        [springs[:-1] + springs[1:], -springs[1:-1], -springs[1:-1]], offsets=[0, 1, -1]
    )
    return stiffness.tocsc(), sparse.diags_array(rng.uniform(0.5, 2, n)).tocsc()


def test_a_large_matrix_is_solved_to_the_same_bits_by_any_threads(pair, monkeypatch):
    grid = sparse.csc_array(sparse.kronsum(sparse.kronsum(pair[0][:20, :20], pair[0][:20, :20]), pair[0]))
    rhs = np.random.default_rng(0).standard_normal((grid.shape[0], 4))
    both = factorise(grid)(rhs)
    np.testing.assert_allclose(grid @ both, rhs, atol=1e-12)
    np.testing.assert_allclose(factorise(grid)(rhs[:, 0]), both[:, 0], atol=1e-12)
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
    lowest = 2 * np.pi * frequencies[0]
    unstable = sparse.csc_array(stiffness - 2 * lowest**2 * mass)  # has a negative frequency
    assert 2 * np.pi * lowest_modes(unstable, mass, 2)[0][0] == pytest.approx(-lowest, rel=1e-9)


@pytest.fixture
def near(make_block):
    bar = make_block(size=(0.02, 0.01, 0.3), counts=(1, 1, 6), origin=(0.01, 0.0, 0.3), clamp_bottom=True)
    u = np.random.default_rng(2).standard_normal(bar.free.size)
    rest, strained = bar.tangent(np.zeros_like(u)), bar.tangent(2e-6 * u)
    return rest, bar.mass, factorise(rest), strained


@pytest.fixture
def factored(monkeypatch):
    made = []
    monkeypatch.setattr(linear, "factorise", lambda matrix: made.append(matrix) or factorise(matrix))
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


ETA = 4


@pytest.fixture(scope="module")
def blocks(make_block):
    """Stiffness at three speeds, mass, partition and Φ of a leaning bar with two interface nodes."""
    solid = make_block((0.04, 0.006, 0.2), (3, 1, 6), origin=(-0.02, 0.002, 0.4), clamp_bottom=True)
    fits = [equilibrium(solid, omega).stiffness for omega in (0.0, 250.0, 500.0)]
    x, y, z = solid.mesh.points.T
    tip = np.flatnonzero(np.isclose(z, 0.6) & np.isclose(y, 0.005))
    ends = tip[np.argsort(x[tip])][[0, -1]]
    partition = Partition(solid.coordinates(ends), solid.free.size)
    return fits, solid.mass, partition, transformation(fits, solid.mass, partition, ETA, 1e-8)


def test_coordinates_are_physical_at_the_interface_and_orthonormal_in_the_mass_inside(blocks):
    _, mass, partition, phi = blocks
    np.testing.assert_array_equal(phi[partition.interface], np.eye(6, phi.shape[1]))
    psi = phi[partition.internal, 6:]
    gram = psi.T @ (mass[partition.internal][:, partition.internal] @ psi)
    np.testing.assert_allclose(gram, np.eye(len(gram)), atol=1e-11)


@pytest.mark.parametrize("speed", [0, 1, 2])
def test_statics_and_fixed_interface_modes_are_exact_at_the_fit_speeds(blocks, speed):
    fits, mass, partition, phi = blocks
    load, internal = np.zeros((phi.shape[0], 6)), partition.internal
    load[partition.interface] = np.eye(6)
    exact = factorise(fits[speed])(load)
    reduced = phi @ np.linalg.solve(project(fits[speed], phi), phi.T @ load)
    np.testing.assert_allclose(reduced, exact, atol=1e-6 * np.abs(exact).max())
    exact = lowest_modes(fits[speed][internal][:, internal], mass[internal][:, internal], ETA)[0]
    held = project(fits[speed], phi)[6:, 6:], project(mass, phi)[6:, 6:]
    squares = eigh(*held, eigvals_only=True, subset_by_index=[0, ETA - 1])
    np.testing.assert_allclose(np.sqrt(squares) / (2 * np.pi), exact, rtol=1e-8)


def test_orthonormalisation_finds_the_rank_whatever_the_scale():
    rng = np.random.default_rng(7)
    mass = sparse.diags_array(rng.uniform(1, 3, 30)).tocsc()
    independent = rng.standard_normal((30, 4))
    mixed = np.hstack([independent, independent @ rng.standard_normal((4, 3))]) * np.logspace(-9, 3, 7)
    psi = mass_orthonormal(mixed, mass, 1e-5)
    assert psi.shape == (30, 4)
    np.testing.assert_allclose(psi.T @ (mass @ psi), np.eye(4), atol=1e-13)
    np.testing.assert_allclose(psi @ (psi.T @ (mass @ independent)), independent, atol=1e-10)


@pytest.mark.parametrize(("share", "rank"), [(0.9, 2), (1.1, 1)])
def test_columns_are_dropped_below_the_tolerance_of_their_singular_values(share, rank):
    """Two unit columns at an angle α have singular values whose ratio is tan(α / 2)."""
    mass, angle = np.array([2.0, 5.0, 1.0]), 0.02
    columns = np.array([[1.0, np.cos(angle)], [0.0, np.sin(angle)], [0.0, 0.0]]) * [3.0, 1e-4]
    columns /= np.sqrt(mass)[:, None]
    found = mass_orthonormal(columns, sparse.diags_array(mass).tocsc(), share * np.tan(angle / 2))
    assert found.shape == (3, rank)


def test_factors_of_the_whole_solve_for_the_internal_coordinates(blocks):
    fits, _, partition, _ = blocks
    internal = partition.internal
    rhs = np.random.default_rng(4).standard_normal((internal.size, 2))
    solve, exact = internal_solve(factorise(fits[1]), partition), factorise(fits[1][internal][:, internal])
    for columns in (slice(None), 0):
        wanted = exact(rhs[:, columns])
        np.testing.assert_allclose(solve(rhs[:, columns]), wanted, atol=1e-9 * np.abs(wanted).max())
