from dataclasses import replace

import numpy as np
import pytest

from bladerub.blade.tip import tip_radius


def test_the_radius_of_the_tip_is_the_distance_from_the_axis(blade):
    assert tip_radius(blade) == pytest.approx(0.65)
    moved = replace(blade, node_position=blade.node_position + np.array([1.0, 0.0, 0.0]))
    assert tip_radius(moved) == pytest.approx(0.65)
