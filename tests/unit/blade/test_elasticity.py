import itertools

import numpy as np
import pytest
from scipy import sparse
from skfem import Basis, BilinearForm, ElementVector, LinearForm
from skfem.helpers import ddot, eye, grad, identity, trace, transpose
from tetrahedra import tetrahedral_mesh

from bladerub.blade import elasticity, rotation
from bladerub.blade.linear import factorise
from bladerub.blade.mesh import hexahedral_mesh
from bladerub.blade.rotation import EquilibriumError, equilibrium, residual, rotating_stiffness

SIZE = (0.3, 0.2, 0.5)


def sym(a):
    return 0.5 * (a + transpose(a))


def matmul(a, b):
    return np.einsum("ij...,jk...->ik...", a, b)


TETRAHEDRA = pytest.param(tetrahedral_mesh, id="tetrahedra", marks=pytest.mark.extras)


@pytest.fixture(params=[pytest.param(hexahedral_mesh, id="hexahedra"), TETRAHEDRA])
def make_mesh(request):
    return request.param


@pytest.fixture
def block(make_block, make_mesh):
    return make_block(SIZE, (2, 2, 2), distortion=2.0, make_mesh=make_mesh)


def test_tangent_and_force_are_the_weak_forms_pair_by_pair(block, monkeypatch):
    lam, mu = elasticity.lame(block.material)

    def C(E):
        return lam * eye(trace(E), 3) + 2 * mu * E

    def kinematics(w):
        F = identity(grad(w["u"])) + grad(w["u"])
        return F, C(0.5 * (matmul(transpose(F), F) - identity(F)))

    @BilinearForm
    def tangent(du, v, w):
        F, S = kinematics(w)
        dE_u, dE_v = sym(matmul(transpose(F), grad(du))), sym(matmul(transpose(F), grad(v)))
        return ddot(C(dE_u), dE_v) + ddot(S, matmul(transpose(grad(v)), grad(du)))

    @LinearForm
    def force(v, w):
        F, S = kinematics(w)
        return ddot(S, sym(matmul(transpose(F), grad(v))))

    x, y, z = block.mesh.doflocs
    u = 0.02 * np.stack([np.sin(3 * y) + z**2, x * z - 0.3 * y, np.cos(4 * x) + y * z], axis=1).ravel()
    basis = Basis(block.mesh, ElementVector(block.mesh.elem()), quadrature=block.mesh.quadrature())
    field = basis.interpolate(u)
    expected = tangent.assemble(basis, u=field).toarray()
    for chunk in (elasticity._CHUNK, 3):  # elements in pieces
        monkeypatch.setattr(elasticity, "_CHUNK", chunk)
        np.testing.assert_allclose(block.tangent(u).toarray(), expected, atol=1e-12 * np.abs(expected).max())
    expected = force.assemble(basis, u=field)
    np.testing.assert_allclose(block.internal_force(u), expected, atol=1e-12 * np.abs(expected).max())


def test_spinning_mass_has_the_places_of_the_tangent(make_block):
    block = make_block(SIZE, (2, 1, 2), clamp_bottom=True)
    tangent = block.tangent(np.zeros(block.free.size))
    placed = sparse.csc_array((block.spinning_mass, tangent.indices, tangent.indptr), shape=tangent.shape)
    np.testing.assert_array_equal(placed.toarray(), block.mass.toarray() * (block.axis != 0))
    assert placed.nnz == tangent.nnz


def test_patch_of_distorted_elements_holds_a_uniform_strain(make_block, make_mesh):
    """A linear field of the outer nodes leaves no force on the inner ones."""
    block = make_block(SIZE, (2, 2, 2), make_mesh=make_mesh)
    rng = np.random.default_rng(1)
    points = block.mesh.doflocs.copy()
    inside = np.flatnonzero(np.all((points > 1e-9) & (points < np.array(SIZE)[:, None] - 1e-9), axis=0))
    vertex = inside[inside < block.mesh.nvertices]
    points[:, vertex] += 0.02 * rng.standard_normal((3, vertex.size))
    points[:, block.mesh.nvertices :] = points[:, block.mesh.edges].mean(axis=1)  # straight edges
    solid = elasticity.Solid(type(block.mesh)(points, block.mesh.t), block.material)
    gradient = 1e-3 * rng.standard_normal((3, 3))
    exact = (gradient @ points).T.ravel()
    force = (solid.tangent(np.zeros(exact.size)) @ exact).reshape(-1, 3)
    assert np.abs(force[inside]).max() < 1e-12 * np.abs(force).max()
    found = solid.deformation_gradient(exact)
    np.testing.assert_allclose(found, np.broadcast_to(np.eye(3) + gradient, found.shape), atol=1e-14)


def test_nothing_but_six_rigid_motions_costs_nothing(block):
    K = block.tangent(np.zeros(block.free.size)).toarray()
    assert np.linalg.matrix_rank(K / np.abs(K).max(), tol=1e-11) == block.free.size - 6


def test_mass_and_first_moment_are_those_of_the_body(make_block, make_mesh):
    block = make_block(SIZE, (2, 2, 2), origin=(0.1, -0.2, 0.45), distortion=2.0, make_mesh=make_mesh)
    mass = 7800.0 * np.prod(SIZE)
    centre = np.array([0.1, -0.2, 0.45]) + np.array(SIZE) / 2
    # The distortion moves matter about, not the outer surface.
    uniform = make_block(SIZE, (1, 1, 1), origin=(0.1, -0.2, 0.45))
    for solid, axis in itertools.product((uniform, block), range(3)):
        along = (solid.axis == axis).astype(float)
        assert along @ solid.mass @ along == pytest.approx(mass, rel=1e-12)
        assert along @ solid.first_moment == pytest.approx(mass * centre[axis], rel=1e-6)


@pytest.mark.parametrize("powers", [(2, 0, 0), (0, 2, 0), (0, 0, 2), (1, 1, 0), (0, 1, 1)])
def test_kinetic_energy_of_quadratic_velocities_is_exact(make_block, make_mesh, powers):
    """Both elements hold quadratic fields, so ∫ ρ v² over a box is a product of powers of its sides."""
    block = make_block(SIZE, (1, 2, 1), make_mesh=make_mesh)
    field = np.prod(block.mesh.points ** np.array(powers), axis=1)
    velocity = np.kron(field, [1.0, 0.0, 0.0])
    orders = 2 * np.array(powers) + 1
    exact = 7800.0 * np.prod(np.array(SIZE) ** orders / orders)
    assert velocity @ block.mass @ velocity == pytest.approx(exact, rel=1e-12)


def test_strain_energy_of_a_field_of_the_element_is_exact(make_block):
    """One hexahedron holds u_x = x² y, whose energy density goes up to x⁴: too much for two points a side."""
    block = make_block(SIZE, (1, 1, 1))
    x, y, _ = block.mesh.doflocs
    u = np.kron(x**2 * y, [1.0, 0.0, 0.0])
    a, b, c = SIZE
    lam, mu = elasticity.lame(block.material)
    exact = (lam + 2 * mu) * 4 * a**3 / 3 * b**3 / 3 * c + mu * a**5 / 5 * b * c
    assert u @ block.tangent(np.zeros(u.size)) @ u == pytest.approx(exact, rel=1e-12)


BAR = {"size": (0.01, 0.01, 0.4), "counts": (1, 1, 6), "origin": (-0.005, -0.005, 0.3), "clamp_bottom": True}


@pytest.fixture
def leaning_bar(make_block):
    """A bar off the radial line, so that rotation bends it."""
    return make_block(**{**BAR, "origin": (0.01, 0.004, 0.3)})


def test_stiffness_is_the_derivative_of_the_residual(leaning_bar):
    rng = np.random.default_rng(5)
    u = 1e-3 * rng.standard_normal(leaning_bar.free.size)
    step = 1e-7 * rng.standard_normal(u.size)
    ahead, behind = (residual(leaning_bar, u + sign * step, 1e7) for sign in (1, -1))
    exact = rotating_stiffness(leaning_bar, u, 1e7) @ step
    np.testing.assert_allclose((ahead - behind) / 2, exact, atol=1e-7 * np.abs(exact).max())


def test_bar_stretches_as_the_closed_form(make_block):
    # EA u'' + ρ A Ω² (z + u) = 0 with k² = ρ Ω² / E: z + u = z0 cos kx + B sin kx, x = z − z0, and at the
    # free end d(z + u)/dx = 1.
    bar = make_block(**BAR, poisson=0.0)
    omega, z0, length = 30.0, 0.3, 0.4
    k = omega * np.sqrt(7800.0 / 2e11)
    b = (1 / k + z0 * np.sin(k * length)) / np.cos(k * length)
    exact = z0 * np.cos(k * length) + b * np.sin(k * length)
    state = equilibrium(bar, omega)
    u = bar.full(state.displacement)
    tip = np.isclose(bar.mesh.points[:, 2], z0 + length)
    assert u[tip, 2].mean() == pytest.approx(exact - z0 - length, rel=1e-4)
    assert np.abs(u[tip, :2]).max() < 1e-3 * u[tip, 2].mean()


def test_equilibrium_is_one_and_the_same_from_any_start(leaning_bar):
    at_once = equilibrium(leaning_bar, 900.0)
    onwards = equilibrium(leaning_bar, 900.0, equilibrium(leaning_bar, 600.0))
    size = np.abs(at_once.displacement).max()
    np.testing.assert_allclose(onwards.displacement, at_once.displacement, atol=1e-9 * size)
    for omega in (20.0, 100.0, 400.0, 900.0):
        u = equilibrium(leaning_bar, omega).displacement
        load = np.linalg.norm(rotation.centrifugal_load(leaning_bar, u, omega**2))
        assert np.linalg.norm(residual(leaning_bar, u, omega**2)) <= rotation.TOLERANCE * load


def test_matter_turned_inside_out_is_no_equilibrium(leaning_bar):
    """Mirrored at its clamped end the bar is as free of strain as before, and Newton's method would stay."""
    mirrored = leaning_bar.full(np.zeros(leaning_bar.free.size))
    mirrored[:, 2] = -2 * (leaning_bar.mesh.points[:, 2] - 0.3)
    u = mirrored.ravel()[leaning_bar.free]
    start = rotation.Equilibrium(1.0, u, rotating_stiffness(leaning_bar, u, 1.0), 0, 0)
    with pytest.raises(EquilibriumError):
        equilibrium(leaning_bar, 30.0, start)


def test_a_large_model_has_the_same_equilibrium_by_its_factors_at_rest(leaning_bar, monkeypatch):
    small = equilibrium(leaning_bar, 300.0)
    at_rest = factorise(leaning_bar.tangent(np.zeros(leaning_bar.free.size)))
    made = []
    monkeypatch.setattr(rotation, "factorise", made.append)
    halfway = equilibrium(leaning_bar, 200.0, at_rest=at_rest)
    size = np.abs(small.displacement).max()
    for start in (None, halfway):
        large = equilibrium(leaning_bar, 300.0, start, at_rest)
        np.testing.assert_allclose(large.displacement, small.displacement, atol=1e-8 * size)
    assert halfway.n_iterations < 20
    assert equilibrium(leaning_bar, 600.0, halfway, at_rest).n_iterations < 24
    assert not made


def test_a_load_near_the_rounding_of_the_forces_is_carried(leaning_bar):
    creeping, slow = (equilibrium(leaning_bar, omega) for omega in (0.5, 5.0))
    force = residual(leaning_bar, creeping.displacement, 0.5**2)
    load = rotation.centrifugal_load(leaning_bar, creeping.displacement, 0.5**2)
    assert np.linalg.norm(force) > rotation.TOLERANCE * np.linalg.norm(load)
    size = np.abs(slow.displacement).max()
    np.testing.assert_allclose(100 * creeping.displacement, slow.displacement, atol=1e-3 * size)
