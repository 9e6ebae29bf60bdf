import numpy as np
import pytest
from blade_parts import REDUCTION, TWISTED, blade_config, twisted_config  # noqa: F401 (fixtures)

from bladerub.blade.build import meshed_blade
from bladerub.blade.discrete import by_finite_elements
from bladerub.extras.export.blade_files import write_fe_matrices


@pytest.fixture(scope="session")
def discrete():
    """The twisted blade, a little conical, as matrices at five speeds."""
    mesh, speeds = meshed_blade(TWISTED.replaced("tip_cone", 9.0)), np.linspace(0, 0.4, 5).tolist()
    return by_finite_elements(mesh, TWISTED.material, speeds, [], REDUCTION.accuracy_modes)


@pytest.fixture(scope="session")
def written(discrete, tmp_path_factory):
    folder = tmp_path_factory.mktemp("written")
    write_fe_matrices(folder, discrete, 0.4, ".npz")
    return folder
