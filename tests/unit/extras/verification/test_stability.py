from unittest.mock import Mock

import numpy as np
import pytest
from study_fixtures import CONFIG

from bladerub.config.errors import ConfigError
from bladerub.config.read import validate


def test_central_differences_are_checked_by_the_blade_that_is_built(monkeypatch):
    """Its highest mode in coordinates of 1 kg has 1e6 rad/s."""
    config = CONFIG.plain()
    n, f1 = 30, 2 * np.pi * 480.0
    stiffness = np.diag(np.linspace(f1, 1e6, n) ** 2)
    blade = Mock(f1_hz=480.0, mass=np.eye(n), stiffness=lambda f_omega: stiffness)
    monkeypatch.setattr("bladerub.blade.files.is_built", lambda *_: True)
    monkeypatch.setattr("bladerub.blade.validation.read_reduced_blade", lambda _: blade)
    config["solver"]["max_time_step"] = 3e-6
    validate(config)
    config["solver"]["scheme"] = "central_differences"
    with pytest.raises(ConfigError, match=r"solver.max_time_step = 3e-06: .* below 2e-06"):
        validate(config)
    config["solver"]["max_time_step"] = 1.9e-6
    validate(config)
