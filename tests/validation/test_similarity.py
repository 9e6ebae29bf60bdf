"""A blade similar to the stand-in, of another size and material: what it does in contact must be similar."""

import copy

import numpy as np
import pytest

from bladerub.blade.build import build
from bladerub.contact.run import simulate
from bladerub.extras.blades import similarity
from bladerub.extras.blades.similarity import contact_scale, tip_stiffness, track_area
from bladerub.study.grid import CoatingCase, run_spec


def similar(config):
    """The blade at 0.37 of its size, of steel instead of titanium."""
    config = copy.deepcopy(config)
    blade = config["blade"]
    blade["hub_radius"] *= 0.37
    blade["length"] *= 0.37
    for section in blade["sections"]:
        for name in ("chord", "sweep", "lean"):
            section[name] *= 0.37
    blade["material"] = {"young_modulus": 2.1e11, "poisson_ratio": 0.32, "density": 7850.0}
    return config


def test_a_similar_blade_rubs_alike_in_its_own_units(coarse_config, coarse_blade, monkeypatch):
    similar_config = similar(coarse_config)
    for name, value in (
        ("F1_HZ", coarse_blade.f1_hz),
        ("TIP_STIFFNESS", tip_stiffness(coarse_blade)),
        ("TRACK_AREA", track_area(coarse_blade)),
    ):
        monkeypatch.setattr(similarity, name, value)
    blade = build(similar_config).reduced
    scale = contact_scale(blade)
    assert scale["length"] == pytest.approx(0.37)
    assert scale["modulus"] == pytest.approx(2.1 / 1.1, rel=1e-7)
    assert scale["time"] == pytest.approx(0.37 * np.sqrt(7850 / 4430 * 1.1 / 2.1), rel=1e-7)
    similar_config["contact"]["scale"] = scale
    case = CoatingCase("2nd", 2.0, 0.5, 0.15)
    first, second = (
        simulate(model, run_spec(config, case, 0.2))
        for model, config in ((coarse_blade, coarse_config), (blade, similar_config))
    )
    assert first.wear.max() > 1e-4
    np.testing.assert_allclose(second.wear, 0.37 * first.wear, atol=0.01 * 0.37 * first.wear.max())
    np.testing.assert_allclose(second.revolution_peak, 0.37 * first.revolution_peak, rtol=0.01)
