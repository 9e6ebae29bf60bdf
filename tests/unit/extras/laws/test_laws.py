import dataclasses
from pathlib import Path

import contact_in_numpy
import numpy as np
import pytest

from bladerub.contact import law
from bladerub.contact.laws import element_parameters, law_digest, module_for, module_of, source_of
from bladerub.contact.run import simulate
from bladerub.contact.spec import PLASTIC, Coating, ElementLaw
from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law, parameters_of
from bladerub.extras.laws import plugin
from bladerub.extras.laws.heating import HEATED, Layer

AREA, STEP, WORN = 1e-6, 1e-6, 1e-5
THERMAL = described_law("thermal", LAYER | {"heated_depth": 5e-4, "softening_rise": 20.0})
LAWS = [
    PLASTIC,
    described_law("perfectly_plastic", {"yield_stress": 2e6}),
    described_law("viscoplastic", {"viscosity": 1e4}),
    described_law("brittle", {"break_strain": 2e-3}),
    THERMAL,
]
OWN = ElementLaw("own", (), Path(law.__file__).read_text(encoding="utf-8"))


def coating(law):
    return Coating(1.1, 0.5, 0.0, 1e-3, 600e6, 6e-3, 2000, element_law=law)


def pressed(law, depth):
    module = module_of(law)
    element = module.element(coating(law), AREA, STEP)
    return module, element, *module.return_mapping(element, depth, WORN)


def test_the_module_of_a_law_that_plugs_in_counts_for_the_key():
    assert sorted(law.name for law in LAWS[1:]) == sorted(plugin.LAWS)
    assert law_digest(PLASTIC) == law_digest(OWN) == {}
    assert len({law_digest(law)["law"] for law in LAWS[1:]}) == len(LAWS) - 1
    with pytest.raises(ValueError, match="viscosity: missing"):
        described_law("viscoplastic", {})
    with pytest.raises(ValueError, match="elastic: must be one of"):
        described_law("elastic", {})
    for source, message in (
        ("def", "is no Python"),
        ("x = 1\nPARAMETERS = {'a': ('Pa', low(), 1.0, 'it')}", "PARAMETERS on line 2: must be a dictionary"),
        ("(" * 100_000, r"Python|a law must have"),
    ):
        with pytest.raises(ValueError, match=message):
            parameters_of(source)


@pytest.mark.parametrize(
    ("name", "key", "value"), [("viscoplastic", "viscosity", 0), ("brittle", "break_strain", 1e9)]
)
def test_without_viscosity_or_breaking_a_law_is_plastic(name, key, value):
    depth = np.linspace(-1e-5, 1e-4, 101)
    module, element, *found = pressed(described_law(name, {key: value}), depth)
    plastic, plastic_element, force, increment = pressed(PLASTIC, depth)
    found.append(module.dissipated_energy(element, WORN, increment, 0.0, force))
    dissipated = plastic.dissipated_energy(plastic_element, WORN, increment, 0.0, force)
    np.testing.assert_allclose(found, [force, increment, dissipated], rtol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(
    "law",
    [pytest.param(law, marks=[] if law.name == "viscoplastic" else pytest.mark.nightly) for law in LAWS[1:]],
    ids=[law.name for law in LAWS[1:]],
)
def test_the_loop_agrees_with_the_reference(blade, spec, change, law):
    own = dataclasses.replace(law, name="own", source=source_of(law))
    spec = change(spec, revolutions=1, element_law=own, steps_per_element=4)
    result = simulate(blade, spec)
    history, wear = contact_in_numpy.simulate(blade, spec, result.n_steps, result.n_modes)
    means = contact_in_numpy.element_means(history[:, 0], result.radial_displacement.size)
    scale = np.abs(history).max()
    np.testing.assert_allclose(result.radial_displacement.ravel(), means, atol=1e-6 * scale)
    np.testing.assert_allclose(result.wear, wear, atol=1e-6 * wear.max())
    assert result.n_contact_steps > 10


@pytest.mark.slow
def test_a_law_that_gives_what_is_no_number_is_named(blade, spec, change):
    limit = "element.yield_force + element.hardening * wear"
    assert limit in OWN.source
    source = OWN.source.replace(limit, f"{limit} + (wear - wear) / (wear - wear)")
    own = ElementLaw("own", (), source)
    with pytest.raises(ValueError, match=r"^law own: gives what is no number, in 1\.00 revolutions at E = "):
        simulate(blade, change(spec, revolutions=1, element_law=own))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scheme", "step", "within"),
    # the loop takes the force at the start of a step from the corrected displacement, the reference as it was
    [("exponential", 1e-5, 1e-6), pytest.param("central_differences", 2e-6, 3e-4, marks=pytest.mark.nightly)],
)
def test_the_loop_heats_the_layer_as_the_reference_does(blade, spec, change, scheme, step, within):
    spec = change(spec, scheme=scheme, max_time_step=step, revolutions=3, element_law=THERMAL)
    result, cold = simulate(blade, spec), simulate(blade, change(spec, element_law=PLASTIC))
    _, wear = contact_in_numpy.simulate(blade, spec, result.n_steps, result.n_modes)
    np.testing.assert_allclose(result.wear, wear, atol=within * wear.max())
    assert np.abs(result.wear - cold.wear).max() > 1e-3 * wear.max()
    assert not cold.layer
    assert result.layer["temperature_rise"].max() > 1


def user_law(element):
    text = OWN.source.replace("def element(", "def of_paper(")
    text += "import math, sys\nimport numpy as np\nPARAMETERS = {}\n"
    text += "def element(coating, area, time_step=math.inf):\n    own = of_paper(coating, area)\n"
    return ElementLaw("own", (), f"{text}    {element}\n")


AREAS = np.linspace(1e-6, 2e-6, 8)


@pytest.mark.parametrize("one", ["float(np.mean(x))", "np.mean(x) * np.ones((1, 1))"])
def test_one_number_for_all_elements_is_repeated(one):
    own = coating(user_law(f"return Element(*({one} for x in own))"))
    expected = element_parameters(coating(PLASTIC), np.full(8, AREAS.mean()))
    rows = element_parameters(own, AREAS)
    assert rows.shape == expected.shape
    np.testing.assert_allclose(rows[:3], expected[:3], rtol=1e-12)


@pytest.mark.parametrize(
    "element", ["return Element(*(np.ones(3) for x in own))", "sys.exit(0)", "while True: pass"]
)
def test_what_is_no_parameters_is_refused(element, monkeypatch):
    monkeypatch.setattr("bladerub.extras.user_code.LONGEST_CALL", 0.5)
    with pytest.raises(ValueError, match=r"^law own: "):
        element_parameters(coating(user_law(element)), AREAS)
    with pytest.raises(ValueError, match="its module"):
        module_of(ElementLaw("own", (), "import sys; sys.exit(0)"))


THICKNESS, PERIOD, N = 5e-3, 0.02, 12
VALUES = LAYER | {"softening_exponent": 2.0}


def layer(**values):
    law = described_law("thermal", VALUES | values)
    coating = Coating(1.1, 0.5, 0.1, 1e-6, 600e6, THICKNESS, N, element_law=law)
    return Layer(module_of(law), coating, AREAS, PERIOD)


def heated(flow=0.0, friction=0.0):
    """State after a passage that made so much heat in rows 3 to 5, J."""
    law = described_law("thermal", VALUES)
    state = module_for(8, "contact.kernel.records", law).at_rest(1, N)
    state.taken[3:6] = np.repeat([flow, friction], 8)
    return state


def test_without_conduction_all_heat_stays_in_the_heated_depth_and_cells_are_in_series():
    own, state = layer(conductivity=0.0), heated(flow=0.01, friction=0.03)
    own.rest(state, 0, N)
    rise = own.temperature(state)
    wanted = (0.01 + 0.5 * 0.03) / AREAS / (2e6 * 1e-4)
    np.testing.assert_allclose(own.rise(state)[3:6], np.broadcast_to(wanted, (3, 8)), rtol=1e-10)
    np.testing.assert_allclose(np.ptp(rise[..., :HEATED], axis=-1), 0, atol=1e-9)
    np.testing.assert_allclose(rise[..., HEATED:], 0, atol=1e-9)
    assert not rise[:3].any()
    assert not state.taken.any()
    left = np.maximum(1 - (wanted / 500) ** 2, 0.01)
    strength = 1 / ((1 - 1e-4 / THICKNESS) + 1e-4 / THICKNESS / left)
    np.testing.assert_allclose(state.strength[4], strength, rtol=1e-9)
    np.testing.assert_array_equal(state.strength[8], 1.0)


def test_rows_wrap_around_and_others_wait_and_two_shorter_rests_are_one():
    own, state = layer(), heated(flow=0.01)
    own.rest(state, -8, -7)  # row 4
    assert not state.taken[4].any()
    assert state.taken[[3, 5], :8].all()
    assert (state.strength[4] < 1).all()
    assert (state.strength[[3, 5]] == 1).all()
    once, twice = heated(flow=0.01), heated(flow=0.01)
    own = layer()
    own.rest(once, 0, N, 0.7)
    own.rest(twice, 0, N, 0.3)
    own.rest(twice, 0, N, 0.4)
    np.testing.assert_allclose(own.temperature(twice), own.temperature(once), atol=1e-9)
    strength = own.law.strength(own.coating, np.array([[0.0], [250.0], [1e4]]))
    np.testing.assert_allclose(strength.ravel(), [1.0, 0.75, 0.01])
