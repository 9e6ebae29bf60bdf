"""Heat in the coating against closed forms, and what runs make of it against their ledger.

Source: Carslaw and Jaeger, Conduction of Heat in Solids (1959), section 2.4: a slab of depth d at the surface
of a half-space that is warmer by T₀ at the start keeps of it the mean
``erf(x) − (1 − exp(−x²)) / (x √π)`` with ``x = d / √(α t)``; section 3.3 for a layer of finite depth, whose
slowest mode decays at the rate ``α π² / (4 H²)``.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import erf

from bladerub.contact.laws import module_for, module_of
from bladerub.contact.run import simulate, simulate_longer
from bladerub.contact.spec import Coating
from bladerub.contact.strips import element_area
from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law
from bladerub.extras.laws import heating
from bladerub.extras.passages.speed_sweep import simulate_sweep
from bladerub.extras.passages.sweep_grid import SweepSpec
from bladerub.extras.rows.row import simulate_row
from bladerub.extras.rows.spec import Row

DEPTH, THICKNESS, CAPACITY, CONDUCTIVITY = 1e-4, 5e-3, 2e6, 5.0
DIFFUSIVITY = CONDUCTIVITY / CAPACITY
VALUES = LAYER | {"heat_capacity": CAPACITY, "conductivity": CONDUCTIVITY, "heated_depth": DEPTH}


def thermal(**values):
    return described_law("thermal", VALUES | values)


@pytest.mark.parametrize("periods", [0.5, 2.0, 8.0, 30.0])
def test_a_heated_slab_cools_as_on_a_half_space(periods):
    """In units of d²/α, 4 ms; a revolution of the study takes 13 to 50 ms. The rise is 1 K at the start."""
    law = thermal()
    coating = Coating(1.1, 0.5, 0.1, 1e-6, 600e6, THICKNESS, 4, element_law=law)
    layer = heating.Layer(module_of(law), coating, np.ones(8), periods * DEPTH**2 / DIFFUSIVITY)
    state = module_for(8, "contact.kernel.records", law).at_rest(1, 4)
    state.taken[:, :8] = CAPACITY * DEPTH
    layer.rest(state, 0, 4)
    found = layer.rise(state)[0, 0]
    x = 1 / np.sqrt(periods)
    wanted = erf(x) - (1 - np.exp(-(x**2))) / (x * np.sqrt(np.pi))
    print(f"{periods:g} d²/α: {found:.4f} for {wanted:.4f}")
    assert found == pytest.approx(wanted, rel=0.03)


def test_the_slowest_mode_is_that_of_the_layer():
    rate, _ = heating.decay(heating.cell_heights(THICKNESS, DEPTH), CAPACITY, CONDUCTIVITY)
    assert rate.min() == pytest.approx(DIFFUSIVITY * np.pi**2 / (4 * THICKNESS**2), rel=0.02)


@pytest.fixture
def spec(spec_of):
    return spec_of(1.1, 0.5, 0.19, 0.15, element_law=thermal(conductivity=0.0), revolutions=4)


def kept_share(result, ledgers, blade, spec):
    """Heat in the layer, over what the ledgers have as made: by flow, and half of that by friction."""
    rise = result.layer["temperature_rise"] * element_area(blade, spec)[:, None]
    made = sum(each.energy.wear + 0.5 * each.energy.sliding for each in ledgers)
    share = np.sum(rise) * CAPACITY * DEPTH / made  # all of it is in the heated depth
    print(f"{share:.6f} of the heat")
    return share


def test_what_the_ledger_has_as_heat_is_in_the_layer(spec, coarse_blade):
    result = simulate(coarse_blade, spec)
    assert result.layer["temperature_rise"].max() > 10
    assert kept_share(result, [result], coarse_blade, spec) == pytest.approx(1, rel=1e-3)
    _, longer = simulate_longer(coarse_blade, replace(spec, revolutions=2), lambda _: spec.revolutions)
    for name, rows in longer.layer.items():
        np.testing.assert_array_equal(rows, result.layer[name])


def test_blades_of_a_row_heat_one_layer(spec, coarse_blade):
    blades = simulate_row(coarse_blade, spec, Row.even(3, length=[0.0, 2e-5, 0.0])).blades
    rise, *others = (each.layer["temperature_rise"] for each in blades)
    for other in others:
        np.testing.assert_array_equal(other, rise)
    assert kept_share(blades[0], blades, coarse_blade, spec) == pytest.approx(1, rel=1e-3)


def test_heat_stays_in_the_layer_as_the_speed_changes(spec, coarse_blade):
    result = simulate_sweep(coarse_blade, SweepSpec(spec, 0.2, 0.2, 0.002))
    assert kept_share(result, [result], coarse_blade, spec) == pytest.approx(1, rel=1e-3)


@pytest.mark.parametrize(
    "values", [{"conductivity": 1e9}, {"softening_rise": 1e12}], ids=["isothermal", "never soft"]
)
def test_a_layer_that_stays_cold_or_strong_is_plastic(run, values):
    found = run(1.1, 0.5, 0.19, 0.15, revolutions=4, element_law=thermal(**values))
    plastic = run(1.1, 0.5, 0.19, 0.15, revolutions=4)
    soft = run(1.1, 0.5, 0.19, 0.15, revolutions=4, element_law=thermal(softening_rise=100.0))
    np.testing.assert_allclose(found.wear, plastic.wear, atol=1e-9 * plastic.wear.max())
    assert np.abs(soft.wear - plastic.wear).max() > 1e-3 * plastic.wear.max()
