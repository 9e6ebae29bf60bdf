"""A blade written as finite element matrices and read again is the same blade, and rubs the same."""

import numpy as np
import pytest

from bladerub.blade.build import discretise, meshed_blade, reduce_given
from bladerub.contact.run import simulate
from bladerub.extras.blades.matrices import import_matrices
from bladerub.extras.blades.origin import MatrixSource
from bladerub.extras.export.matrices import write_fe_matrices

SPEEDS = (0.12, 0.18, 0.295)  # the second and third in the resonances with engine orders 6 and 4


@pytest.fixture(scope="module")
def config(coarse_config):
    return coarse_config | {"reduction": coarse_config["reduction"] | {"accuracy_modes": 8}}


@pytest.fixture(scope="module")
def blades(config, tmp_path_factory):
    """The coarse blade as it is, and read from its matrices."""
    folder, reduction = tmp_path_factory.mktemp("matrices"), config["reduction"]
    ours = discretise(meshed_blade(config["blade"]), config)
    write_fe_matrices(folder, ours, reduction["f_omega_max"], ".mtx")
    source = MatrixSource(folder)
    return ours, import_matrices(source, reduction["f_omega_max"], 8, reduction["modes_per_speed"]).blade


def test_frequencies_and_wear_are_the_same(blades, config, spec_of):
    np.testing.assert_allclose(blades[1].frequency, blades[0].frequency, rtol=1e-9)
    reduced = [reduce_given(blade, config).reduced for blade in blades]
    for f_omega in SPEEDS:
        ours, theirs = (simulate(blade, spec_of(2.0, 0.5, f_omega)).wear for blade in reduced)
        difference = np.abs(theirs - ours).max() / ours.max()
        print(f"f_omega = {f_omega}: deepest wear {1e6 * ours.max():.3g} µm, difference {difference:.1e}")
        assert ours.max() > 1e-6
        assert difference < 1e-4
