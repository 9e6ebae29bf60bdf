import numpy as np
import pytest
from scipy import sparse
from scipy.linalg import eigh

from bladerub.blade.linear import factorise, lowest_modes
from bladerub.blade.reduction import Partition, internal_solve, mass_orthonormal, project, transformation
from bladerub.blade.rotation import equilibrium

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
