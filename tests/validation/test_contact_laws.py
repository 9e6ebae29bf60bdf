"""Laws of the elements against closed forms, their limits and their energy.

Sources: Simo and Hughes, Computational Inelasticity (1998), section 1.2 (Box 1.4 and eq. 1.2.45), for 1D
plasticity with linear hardening: the elastoplastic modulus is E K / (E + K) and a strain increment beyond
yield gives Δγ = f / (E + K). Section 1.7, for linear viscoplasticity: the overstress x of
``σ = σ_Y + K ε_p + x`` decays as ``exp(−(E + K) t / η)`` at a constant strain, and goes to
``η r E / (E + K)`` at a constant rate r. A law that breaks or is perfectly plastic holds its stress.
Expected: both to rounding, and order 2 of the energy that the ledger misses.
"""

import itertools
import math

import numpy as np
import pytest

from bladerub.contact.law import load
from bladerub.contact.laws import module_of
from bladerub.contact.spec import PLASTIC, Coating
from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law

E, K, UNIT, THICKNESS, AREA, VISCOSITY = 1.1, 0.5, 600e6, 6e-3, 1e-6, 1e4
YIELD = 1e-3  # normalised
TIME = VISCOSITY / ((E + K) * UNIT)  # in which the overstress falls to 1/e
VISCOPLASTIC = described_law("viscoplastic", {"viscosity": VISCOSITY})
BRITTLE = described_law("brittle", {"break_strain": 2e-3})
PERFECT = described_law("perfectly_plastic", {"yield_stress": 2e6})
THERMAL = described_law("thermal", LAYER | {"softening_rise": 50.0})


@pytest.mark.parametrize(("E", "K"), [(0.11, 10.0), (1.1, 0.5), (20.0, 0.05), (20.0, 10.0)])
@pytest.mark.parametrize("yield_stress", [0.0, 0.01])
def test_plasticity_follows_the_closed_form_whatever_the_path(E, K, yield_stress):
    coating = Coating(E, K, 0.0, yield_stress, 1.0, 5e-3, 2000)
    rng = np.random.default_rng(3)
    strain = np.concatenate([np.linspace(0, 0.1, 50), rng.uniform(0, 0.2, 400)])
    wear, highest = 0.0, 0.0
    for epsilon in strain:
        stress, wear = load(coating, epsilon * coating.thickness, wear)
        highest = max(highest, epsilon)
        # plastic strain and stress depend on the largest strain alone
        plastic = max(0.0, (E * highest - yield_stress) / (E + K))
        assert wear / coating.thickness == pytest.approx(plastic, rel=1e-12, abs=1e-15)
        assert stress == pytest.approx(max(0.0, E * (epsilon - plastic)), rel=1e-9, abs=1e-12)


def press(law, strain, time_step=math.inf):
    """Compress an element along a path of strains.

    Returns stress (Pa), plastic strain, and the energies stored and dissipated, J, after each step. Columns
    of `strain` are paths of their own.
    """
    coating = Coating(E, K, 0.0, YIELD, UNIT, THICKNESS, 2000, element_law=law)
    module = module_of(law)
    element = module.element(coating, AREA, time_step)
    wear = force = loss = np.zeros(np.shape(strain)[1:])
    rows = []
    for depth in np.asarray(strain) * THICKNESS:
        before = force
        force, increment = module.return_mapping(element, depth - wear, wear)
        loss = loss + module.dissipated_energy(element, wear, increment, before, force)
        wear = wear + increment
        rows.append((force / AREA, wear / THICKNESS, module.stored_energy(element, force), loss))
    return np.moveaxis(np.array(rows), 1, 0)


def order(steps, errors):
    return -np.polyfit(np.log(steps), np.log(np.abs(errors)), 1)[0]


@pytest.mark.parametrize("n", [1, 4, 50])
def test_overstress_builds_up_at_a_constant_rate_and_relaxes_whatever_the_step(n):
    top = 300.0 * TIME
    strain = YIELD / E + top * np.linspace(0, 2, 2 * n + 1).clip(max=1)
    stress, *_ = press(VISCOPLASTIC, strain, TIME / n)
    at_rest = UNIT * (YIELD + top * E * K / (E + K))
    highest = UNIT * top * E**2 / (E + K) * (1 - math.exp(-1))
    np.testing.assert_allclose(stress[[n, -1]] - at_rest, highest * np.exp([0, -1]), rtol=1e-9)


def cycle(top, n):
    """Loaded to a strain, half unloaded, loaded further, unloaded."""
    corners = np.array([0, 1, 0.5, 1.5, 0]) * top
    return np.concatenate([np.linspace(a, b, n + 1)[1:] for a, b in itertools.pairwise(corners)])


@pytest.mark.parametrize(("rate", "limit"), [(1e-4, "plastic"), (1e8, "elastic")])
def test_viscoplasticity_is_plastic_at_low_rates_and_elastic_at_high_ones(rate, limit):
    strain = cycle(0.02, 200)
    step = strain[0] / rate
    stress, *_ = press(VISCOPLASTIC, strain, step)
    wanted = press(PLASTIC, strain)[0] if limit == "plastic" else E * UNIT * strain
    np.testing.assert_allclose(stress, wanted, atol=1e-3 * wanted.max())


def test_breaking_holds_the_elastic_strain_and_takes_the_depth_removed():
    """σ = E ε_b from there on, and the energy is that of flow up to there and ``E ε_b`` times the rest."""
    strain = np.linspace(0, 0.02, 2001)
    stress, plastic, _, loss = press(BRITTLE, strain)
    assert stress.max() == pytest.approx(E * UNIT * 2e-3)
    assert plastic[-1] == pytest.approx(0.02 - 2e-3)
    hardened = (2e-3 * E - YIELD) / K  # plastic strain at which hardening reaches that stress
    energy = UNIT * ((YIELD + 0.5 * K * hardened) * hardened + E * 2e-3 * (plastic[-1] - hardened))
    assert loss[-1] == pytest.approx(energy * AREA * THICKNESS)


def test_perfect_plasticity_holds_its_stress():
    stress, plastic, *_ = press(PERFECT, np.linspace(0, 0.02, 101))
    assert stress[-1] == pytest.approx(2e6)
    assert plastic[-1] == pytest.approx(0.02 - 2e6 / (E * UNIT))


@pytest.mark.parametrize("law", [PLASTIC, PERFECT, VISCOPLASTIC, BRITTLE], ids=lambda law: law.name)
def test_work_is_stored_or_dissipated(law):
    """The mean over paths to many depths: where flow begins within a step is chance, and decides in one."""
    steps, missing = np.array([100, 200, 400, 800]), []
    for n in steps:
        strain = np.outer(cycle(1.0, n), np.linspace(0.015, 0.025, 41))
        stress, _, stored, loss = press(law, strain, 2 * TIME / n)
        mean = 0.5 * (stress + np.concatenate([0 * stress[:1], stress[:-1]]))
        work = np.sum(mean * np.diff(strain, axis=0, prepend=0.0), axis=0) * AREA * THICKNESS
        missing.append(np.mean(np.abs((stored[-1] + loss[-1]) / work - 1)))
    print(f"{law.name}: order {order(steps, missing):.2f}, missing {missing}")
    assert order(steps, missing) > 1.8
    assert missing[-1] < 1e-5


def drawn(name, rng):
    """Draw a law whose parameter is spread over the range in which it matters."""
    low, high, parameter = {
        "perfectly_plastic": (1e5, 3e6, "yield_stress"),
        "viscoplastic": (1e2, 1e5, "viscosity"),
        "brittle": (1e-3, 1e-1, "break_strain"),
        "thermal": (20.0, 2000.0, "softening_rise"),
    }[name]
    value = float(np.exp(rng.uniform(np.log(low), np.log(high))))
    return described_law(name, (LAYER if name == "thermal" else {}) | {parameter: value})


LONG = [pytest.param(name, 100, marks=pytest.mark.nightly) for name in ("perfectly_plastic", "brittle")]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "runs"), [("viscoplastic", 25), ("thermal", 25), *LONG])
def test_the_ledger_of_random_runs_closes(run, name, runs):
    rng, residuals, worn = np.random.default_rng(8), [], 0
    for _ in range(runs):
        young, plastic = np.exp(rng.uniform(np.log([0.1, 0.05]), np.log([10, 5])))
        theta, speed = rng.choice([0.0, 0.15]), rng.uniform(0.1, 0.4)
        result = run(young, plastic, speed, theta, revolutions=2, element_law=drawn(name, rng))
        residuals.append(abs(result.energy.residual))
        worn += result.wear.max() > 1e-5
    print(f"{name}: largest residual {max(residuals):.2g}, median {np.median(residuals):.2g}, {worn} worn")
    assert max(residuals) <= 1e-3
    assert worn > 0.9 * runs


CONVERGING = [(VISCOPLASTIC, 0.0, 0.8), (THERMAL, 0.15, 1.7)]  # viscous flow begins within a step
CONVERGING += [pytest.param(law, 0.0, 1.7, marks=pytest.mark.nightly) for law in (PERFECT, BRITTLE)]


@pytest.mark.slow
@pytest.mark.parametrize(("law", "theta", "least"), CONVERGING, ids=lambda law: getattr(law, "name", ""))
def test_wear_converges_with_the_step(run, law, theta, least):
    steps = np.array([20, 40, 80, 160])
    values = {"revolutions": 2, "element_law": law}
    *worn, exact = (run(E, K, 0.12, theta, steps_per_element=n, **values).wear for n in (*steps, 640))
    errors = [np.linalg.norm(wear - exact) / np.linalg.norm(exact) for wear in worn]
    print(f"{law.name}: order {order(steps, errors):.2f}, errors {errors}")
    assert order(steps, errors) > least
    assert errors[0] < 0.001
