import dataclasses

import h5py
import numpy as np
import pytest

from bladerub.blade.model import write_reduced_blade
from bladerub.blade.validation import read_reduced_blade, read_valid_blade
from bladerub.io.errors import DamagedFile


@pytest.fixture
def told(blade, tmp_path):
    """Write the blade with some values changed: what is said of it."""

    def answer(**changes):
        path = tmp_path / "blade.h5"
        write_reduced_blade(path, dataclasses.replace(blade, **changes), {})
        with pytest.raises(ValueError, match="not a valid reduced blade") as error:
            read_valid_blade(path)
        return str(error.value).split("blade, ")[1]

    return answer


def test_a_valid_blade_is_read_as_it_is(blade, tmp_path):
    write_reduced_blade(tmp_path / "blade.h5", blade, {})
    read = read_valid_blade(tmp_path / "blade.h5")
    np.testing.assert_array_equal(read.mass, blade.mass)
    assert read.length == blade.length


def test_what_is_no_blade_is_named(told, blade):
    broken = blade.mass.copy()
    broken[3, 4] = np.nan
    assert told(mass=broken) == "mass: must be finite, has NaN or infinite entries"
    assert told(stiffness_2=np.triu(blade.stiffness_2)) == "stiffness_2: must be symmetric"
    assert told(mass=-blade.mass) == "mass: must be positive definite"
    assert told(length=-0.2) == "length = -0.2: must be a number above 0"


def test_an_edited_blade_can_be_tried_and_is_not_that_of_the_study(blade, tmp_path):
    path = tmp_path / "blade.h5"
    write_reduced_blade(path, blade, {})
    with h5py.File(path, "r+") as file:
        file["node_position"][3, 2] *= 1.001
    assert read_valid_blade(path).node_position[3, 2] == 1.001 * blade.node_position[3, 2]
    with pytest.raises(DamagedFile, match=r"blade\.h5: not as it was written"):
        read_reduced_blade(path)
