"""Direct contact against NLstep (Monjaraz-Tec, Gross and Krack, Comput. Struct. 260 (2022) 106698).

The tests need GNU Octave, and the folder of NLstep's function in the environment variable BLADERUB_NLSTEP.
"""

from dataclasses import replace

import numpy as np
import pytest

from bladerub.blade.build import build
from bladerub.contact.run import simulate
from bladerub.extras.rotor37 import direct, nlstep, reference
from bladerub.extras.rotor37.numbers import of_displacement
from bladerub.io.errors import BadInput

REVOLUTIONS, MODES, STEPS = 10, 20, 1500


@pytest.fixture(scope="module")
def function():
    try:
        return nlstep.program()
    except BadInput as error:
        pytest.skip(str(error))


@pytest.fixture(scope="module")
def coarse():
    config = reference.plan()["mesh"]
    return config, direct.unstiffened(build(config).reduced)


@pytest.mark.parametrize("friction", direct.FRICTION)
def test_amplitude_and_orders_agree(function, coarse, friction):
    config, blade = coarse
    spec = replace(direct.spec_of(config, blade, friction), revolutions=REVOLUTIONS)
    displacement, in_contact = nlstep.integrate(function, nlstep.case(blade, spec, MODES, STEPS))
    theirs = of_displacement("", displacement, REVOLUTIONS).set_index("number").value
    result = simulate(blade, spec)
    ours = of_displacement("", result.radial_displacement, REVOLUTIONS).set_index("number").value
    # not to the last digit: NLstep's gap depends on the time, ours on where the node is as well
    assert theirs[".amplitude"] == pytest.approx(ours[".amplitude"], rel=0.03)
    orders = [name for name in ours.index if ".order_" in name]
    np.testing.assert_allclose(theirs[orders], ours[orders], atol=0.01 * ours[".amplitude"])
    assert in_contact.mean() == pytest.approx(result.n_contact_steps / result.n_steps, abs=0.03)
