import dataclasses
from pathlib import Path

import contact_in_numpy
import numpy as np
import pytest

from bladerub.contact import law
from bladerub.contact.laws import (
    NAMES,
    described_law,
    element_parameters,
    law_digest,
    module_of,
    parameters_of,
    source_of,
)
from bladerub.contact.run import simulate
from bladerub.contact.setup import compile_kernel
from bladerub.contact.spec import PLASTIC, Coating, ElementLaw
from bladerub.extras.heat import LAYER

AREA, STEP, WORN = 1e-6, 1e-6, 1e-5
THERMAL = described_law("thermal", LAYER | {"heated_depth": 5e-4, "softening_rise": 20.0})
LAWS = [
    PLASTIC,
    described_law("perfectly_plastic", {"yield_stress": 2e6}),
    described_law("viscoplastic", {"viscosity": 1e4}),
    described_law("brittle", {"break_strain": 2e-3}),
    THERMAL,
]
PLASTIC_LIMITS = [
    described_law("viscoplastic", {"viscosity": 0.0}),
    described_law("brittle", {"break_strain": 1e9}),
]
OWN = ElementLaw("own", (), Path(law.__file__).read_text(encoding="utf-8"))
"""The law of the paper as if it were a user's."""


def named(law):
    return law.name


def coating(law):
    return Coating(1.1, 0.5, 0.0, 1e-3, 600e6, 6e-3, 2000, element_law=law)


def pressed(law, depth, time_step=STEP):
    """Module, parameters, force and increment of worn elements at a depth."""
    module = module_of(law)
    element = module.element(coating(law), AREA, time_step)
    return module, element, *module.return_mapping(element, depth, WORN)


def test_every_law_of_the_package_is_tested():
    assert sorted(law.name for law in LAWS) == sorted(NAMES)


def test_the_module_of_a_law_that_plugs_in_counts_for_the_key():
    assert law_digest(PLASTIC) == law_digest(OWN) == {}
    assert len({law_digest(law)["law"] for law in LAWS[1:]}) == len(LAWS) - 1


@pytest.mark.parametrize("law", LAWS, ids=named)
def test_stiffness_is_the_derivative_of_force_and_constant_as_far_as_it_says(law):
    depth = np.linspace(-1e-5, 5e-5, 300)
    module, element, *_ = pressed(law, depth)
    slope, linear = module.tangent(element, depth, WORN)
    for by in (1e-4 * linear, 0.999 * linear):
        more, less = (pressed(law, depth + sign * by)[2] for sign in (1, -1))
        np.testing.assert_allclose((more - less) / (2 * by), slope, rtol=1e-6, atol=1e-6 * element.elastic)


@pytest.mark.parametrize("law", LAWS, ids=named)
def test_wear_and_force_are_of_one_deformation(law):
    """What an element is shortened by is elastic or worn off, and it only pushes."""
    depth = np.linspace(-1e-5, 5e-5, 300)
    module, element, force, increment = pressed(law, depth)
    np.testing.assert_allclose(force, module.elastic_force(element, depth - increment), rtol=1e-12)
    assert force.min() == 0
    assert increment.min() == 0 < increment.max()


@pytest.mark.parametrize("law", LAWS, ids=named)
def test_no_wear_below_the_elastic_limit(law):
    module, element, *_ = pressed(law, 0.0)
    limit = module.elastic_limit(element, WORN)
    below, above = (pressed(law, part * limit / element.elastic)[3] for part in (0.999, 1.001))
    assert below == 0 < above


@pytest.mark.parametrize("law", PLASTIC_LIMITS, ids=named)
def test_without_viscosity_or_breaking_a_law_is_plastic(law):
    depth = np.linspace(-1e-5, 1e-4, 101)
    module, element, *found = pressed(law, depth)
    plastic, plastic_element, *wanted = pressed(PLASTIC, depth)
    np.testing.assert_allclose(found, wanted, rtol=1e-12)
    force, increment = wanted
    np.testing.assert_allclose(
        module.dissipated_energy(element, WORN, increment, 0.0, force),
        plastic.dissipated_energy(plastic_element, WORN, increment, 0.0, force),
        rtol=1e-12,
    )


@pytest.mark.parametrize(
    ("name", "values", "message"),
    [
        ("viscoplastic", {}, "viscosity: missing, .* must be a number from 0"),
        ("elastic", {}, "name = elastic: must be one of plastic, brittle, perfectly_plastic, thermal, visco"),
    ],
)
def test_a_wrong_parameter_is_named(name, values, message):
    with pytest.raises(ValueError, match=message):
        described_law(name, values)


@pytest.mark.parametrize(
    ("source", "message"),
    [
        ("def", "is no Python"),
        ("x = 1\nPARAMETERS = {'a': ('Pa', low(), 1.0, 'it')}", "PARAMETERS on line 2: must be a dictionary"),
    ],
)
def test_parameters_are_read_without_running_the_law(source, message):
    with pytest.raises(ValueError, match=message):
        parameters_of(source)


@pytest.mark.slow
@pytest.mark.nightly
@pytest.mark.parametrize("law", PLASTIC_LIMITS, ids=named)
def test_the_loop_with_a_law_in_its_plastic_limit_is_that_of_the_paper(blade, spec, change, law):
    wanted, found = simulate(blade, spec), simulate(blade, change(spec, element_law=law))
    np.testing.assert_allclose(found.wear, wanted.wear, atol=1e-9)
    assert wanted.wear.max() > 1e-6


@pytest.mark.slow
@pytest.mark.nightly
def test_the_law_of_the_paper_from_a_file_gives_the_same_bits(blade, spec, change):
    compile_kernel(law=OWN)
    wanted, found = simulate(blade, spec), simulate(blade, change(spec, element_law=OWN))
    np.testing.assert_array_equal(found.wear, wanted.wear)
    np.testing.assert_array_equal(found.radial_displacement, wanted.radial_displacement)
    assert found.energy == wanted.energy


@pytest.mark.slow
@pytest.mark.parametrize(
    "law",
    [pytest.param(law, marks=[] if law.name == "viscoplastic" else pytest.mark.nightly) for law in LAWS[1:]],
    ids=named,
)
def test_the_loop_agrees_with_the_reference(blade, spec, change, law):
    """Each law as from a file that a config names."""
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
    """A law of a file that is that of the paper with another `element`, in Python."""
    text = (
        "import sys, math\nimport numpy as np\nfrom bladerub.contact import law as paper\n"
        "from bladerub.contact.law import *\n"
        "from bladerub.contact.law import Element, return_mapping, tangent, elastic_force\n"
        "from bladerub.contact.law import stored_energy, dissipated_energy\nPARAMETERS = {}\n"
        "def element(coating, area, time_step=math.inf):\n    own = paper.element(coating, area)\n"
    )
    return ElementLaw("own", (), f"{text}    {element}\n")


AREAS = np.linspace(1e-6, 2e-6, 8)


@pytest.mark.parametrize("one", ["float(np.mean(x))", "np.mean(x) * np.ones((1, 1))"])
def test_one_number_for_all_elements_is_repeated(one):
    own = dataclasses.replace(
        coating(PLASTIC), element_law=user_law(f"return Element(*({one} for x in own))")
    )
    expected = element_parameters(coating(PLASTIC), np.full(8, AREAS.mean()))
    rows = element_parameters(own, AREAS)
    assert rows.shape == expected.shape
    np.testing.assert_allclose(rows[:3], expected[:3], rtol=1e-12)


@pytest.mark.parametrize(
    "element", ["return Element(*(np.ones(3) for x in own))", "sys.exit(0)", "while True: pass"]
)
def test_what_is_no_parameters_is_refused(element, monkeypatch):
    monkeypatch.setattr("bladerub.numerics.user_code.LONGEST_CALL", 0.5)
    with pytest.raises(ValueError, match=r"^law own: "):
        element_parameters(dataclasses.replace(coating(PLASTIC), element_law=user_law(element)), AREAS)


def test_a_module_that_does_not_end_well_is_refused():
    with pytest.raises(ValueError, match="its module"):
        module_of(ElementLaw("own", (), "import sys; sys.exit(0)"))


def test_a_nested_text_is_refused():
    with pytest.raises(ValueError, match=r"Python|a law must have"):
        parameters_of("(" * 100_000)
