import dataclasses

import numpy as np
import pytest
from scipy.io import loadmat

from bladerub.export.matrices import write_matrices


@pytest.mark.parametrize("name", ["blade.npz", "blade.mat"])
def test_matrices_come_back_under_their_names(blade, name, tmp_path):
    write_matrices(tmp_path / "new" / name, blade)
    read = np.load if name.endswith("npz") else loadmat
    data = read(tmp_path / "new" / name)
    for field in dataclasses.fields(blade):
        np.testing.assert_array_equal(np.squeeze(data[field.name]), getattr(blade, field.name))


def test_another_suffix_is_refused(blade, tmp_path):
    with pytest.raises(ValueError, match=r"must end in \.npz or \.mat"):
        write_matrices(tmp_path / "blade.csv", blade)
    assert not list(tmp_path.iterdir())
