import numpy as np
import pytest
from contact_in_numpy import element_means

from bladerub.contact.run import simulate
from bladerub.contact.setup import set_up
from bladerub.contact.spec import PLASTIC
from bladerub.extras.benchmark import plain
from bladerub.extras.law_reading import described_law

pytestmark = pytest.mark.slow


VISCOPLASTIC = described_law("viscoplastic", {"viscosity": 1e4})


@pytest.mark.parametrize(
    "loop",
    [plain.integrator, pytest.param(plain.compiled, marks=pytest.mark.nightly)],
    ids=["numpy", "numba"],
)
@pytest.mark.parametrize(
    ("E", "K", "theta", "law"),
    [
        (2.0, 0.1, 0.15, PLASTIC),
        pytest.param(1.1, 0.5, 0.0, PLASTIC, marks=pytest.mark.nightly),
        pytest.param(1.1, 0.5, 0.0, VISCOPLASTIC, marks=pytest.mark.nightly),
    ],
)
def test_the_same_run(blade, spec, change, loop, E, K, theta, law):
    spec = change(spec, E=E, K=K, theta=theta, revolutions=2, element_law=law)
    integrate = loop(law)
    result, (rule, simulation) = simulate(blade, spec), set_up(blade, spec)
    arguments = plain.arguments(law, rule, simulation)
    displacement = np.zeros(result.n_steps)
    integrate(*arguments, displacement)
    per_element = element_means(displacement, result.radial_displacement.size)
    scale = np.abs(per_element).max()
    np.testing.assert_allclose(result.radial_displacement, per_element, rtol=0, atol=1e-7 * scale)
    wear = arguments[4]
    np.testing.assert_allclose(np.sort(result.wear), np.sort(wear.T), rtol=0, atol=1e-6 * wear.max())
