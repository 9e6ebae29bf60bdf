"""Tips with other than eight interface nodes: the time loop against the whole model in plain NumPy."""

import contact_in_numpy
import numpy as np
import pytest

from bladerub.blade.build import build
from bladerub.contact.run import simulate
from bladerub.contact.setup import set_up
from bladerub.settings.blade import Mesh

STEPS = 400


@pytest.fixture(scope="module", params=[5, 12, pytest.param(19, marks=pytest.mark.nightly)])
def wide(request, coarse_config):
    other = coarse_config.replaced("blade.mesh", Mesh(chordwise=20, thickness=2, spanwise=4))
    nodes = other.replaced("reduction.interface_nodes", request.param)
    return build(nodes.replaced("reduction.accuracy_modes", 4)).reduced


@pytest.mark.extras(cases=r"True")
@pytest.mark.parametrize("turns", [pytest.param(False, marks=pytest.mark.nightly), True])
def test_the_loop_agrees_with_the_reference_model(wide, spec_of, turns):
    coarse = {"n_elements": 200, "modulus_unit": 150e6, "steps_per_element": 12, "max_time_step": 1e-5}
    coarse |= {"start_angle": 0.0, "revolutions": 1, "turns": turns}
    spec = spec_of(1.1, 0.5, 0.3, 0.1, **coarse)
    rule, simulation = set_up(wide, spec)
    n_elements = STEPS // simulation.steps_per_element
    shown = np.empty(n_elements)
    made = simulation.advance(shown)
    assert made.n_contact_steps > 50
    n_steps = n_elements * simulation.steps_per_element
    history, wear = contact_in_numpy.simulate(wide, spec, n_steps, rule.omega.size)
    means = contact_in_numpy.element_means(history[:, 0], n_elements)
    np.testing.assert_allclose(shown, means, atol=1e-6 * np.abs(history).max())
    ours = simulate(wide, spec).wear
    assert ours.shape == (wide.n_interface, spec.coating.n_elements)
    worn = simulation.state.wear[:, : wide.n_interface]
    np.testing.assert_allclose(worn.max(axis=0), wear.max(axis=1), rtol=1e-4, atol=1e-12)


LONG = [pytest.param(*of, marks=pytest.mark.nightly) for of in ((12, np.inf), (19, np.inf), (19, 0.5))]


# without elements no profile is met, which is another loop to compile for each width
@pytest.mark.extras(cases=r"0.5")
@pytest.mark.parametrize(("wide", "modulus"), [(5, 0.5), (5, np.inf), (12, 0.5), *LONG], indirect=["wide"])
def test_energy_is_kept(wide, spec_of, modulus):
    result = simulate(wide, spec_of(modulus, modulus, 0.346, turns=True, revolutions=2))
    assert result.n_contact_steps > 1000
    assert result.n_unconverged_steps == 0
    assert result.energy.residual < 1e-3
