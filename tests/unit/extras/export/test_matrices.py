import dataclasses

import numpy as np
import pytest
from scipy.io import loadmat

from bladerub.extras.export.matrices import write_matrices


@pytest.mark.parametrize("name", ["blade.npz", "blade.mat"])
def test_matrices_come_back_under_their_names(blade, name, tmp_path):
    blade = dataclasses.replace(blade, stiffness_higher=(2 * blade.mass,))
    write_matrices(tmp_path / "new" / name, blade)
    read = np.load if name.endswith("npz") else loadmat
    data = read(tmp_path / "new" / name)
    for matrix_name, matrix in blade.arrays.items():
        np.testing.assert_array_equal(data[matrix_name], matrix)
    for attribute in ("f1_hz", "f_omega_max", "eta", "rank_tolerance", "length"):
        assert np.squeeze(data[attribute]) == getattr(blade, attribute)
