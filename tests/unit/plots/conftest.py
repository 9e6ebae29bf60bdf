import numpy as np
import pytest
from plot_fixtures import coating_map, draws  # noqa: F401 (fixtures)
from study_fixtures import *  # noqa: F403 (fixtures)


@pytest.fixture
def angle():
    return (np.arange(40) + 0.5) * 2 * np.pi / 40
