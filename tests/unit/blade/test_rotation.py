import numpy as np
import pytest

from bladerub.blade import rotation
from bladerub.blade.linear import factorise
from bladerub.blade.rotation import EquilibriumError, equilibrium, residual, rotating_stiffness

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
