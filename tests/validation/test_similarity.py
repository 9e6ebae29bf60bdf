"""A blade similar to the stand-in, of another size and material: what it does in contact must be similar."""

from dataclasses import replace

import numpy as np
import pytest

from bladerub.blade.build import build
from bladerub.contact.run import simulate
from bladerub.extras.blades import similarity
from bladerub.extras.blades.settings import Scale
from bladerub.settings.study import typed
from bladerub.study.grid import CoatingCase, run_spec


def similar(config):
    """The blade at 0.37 of its size, of steel instead of titanium."""
    values = config.plain()
    blade = values["blade"]
    blade["hub_radius"] *= 0.37
    blade["length"] *= 0.37
    for section in blade["sections"]:
        for name in ("chord", "sweep", "lean"):
            section[name] *= 0.37
    blade["material"] = {"young_modulus": 2.1e11, "poisson_ratio": 0.32, "density": 7850.0}
    return typed(values)


def test_a_similar_blade_rubs_alike_in_its_own_units(coarse_config, coarse_blade, monkeypatch):
    similar_config = similar(coarse_config)
    monkeypatch.setattr(similarity, "F1_HZ", coarse_blade.f1_hz)
    monkeypatch.setattr(similarity, "TIP_STIFFNESS", similarity.tip_stiffness(coarse_blade))
    monkeypatch.setattr(similarity, "TRACK_AREA", similarity.track_area(coarse_blade))
    blade = build(similar_config).reduced
    scale = similarity.contact_scale(blade)
    assert scale["length"] == pytest.approx(0.37)
    assert scale["modulus"] == pytest.approx(2.1 / 1.1, rel=1e-7)
    assert scale["time"] == pytest.approx(0.37 * np.sqrt(7850 / 4430 * 1.1 / 2.1), rel=1e-7)
    similar_config = similar_config.replaced("contact.scale", Scale(**scale))
    case = CoatingCase("2nd", 2.0, 0.5, 0.15)
    first, second = (
        simulate(model, run_spec(config, case, 0.2))
        for model, config in ((coarse_blade, coarse_config), (blade, similar_config))
    )
    assert first.wear.max() > 1e-4
    np.testing.assert_allclose(second.wear, 0.37 * first.wear, atol=0.01 * 0.37 * first.wear.max())
    np.testing.assert_allclose(second.revolution_peak, 0.37 * first.revolution_peak, rtol=0.01)


def test_stiffness_of_a_tip_on_equal_springs_and_track_area_of_even_nodes(coarse_blade):
    # a force F over 8 nodes moves each by F / (8 k): the softest of the three directions counts
    springs = np.concatenate([np.tile([3e6, 2e6, 5e6], 8), np.full(len(coarse_blade.mass) - 24, 1e9)])
    on_springs = replace(coarse_blade, stiffness_0=np.diag(springs))
    assert similarity.tip_stiffness(on_springs) == pytest.approx(8 * 2e6)
    x = np.linspace(0, 0.07, 8)
    on_a_circle = replace(coarse_blade, node_position=np.column_stack([x, np.zeros(8), np.full(8, 0.5)]))
    # strips of a seventh of the chord, half of one at the edges
    assert similarity.track_area(on_a_circle) == pytest.approx(2 * np.pi * 0.5 * 0.07 / 8)
