from dataclasses import replace

import numpy as np
import pytest

from bladerub.extras.blades.similarity import tip_stiffness, track_area


def test_stiffness_of_a_tip_on_equal_springs(blade):
    # a force F over 8 nodes moves each by F / (8 k): the softest of the three directions counts
    springs = np.concatenate([np.tile([3e6, 2e6, 5e6], 8), np.full(len(blade.mass) - 24, 1e9)])
    on_springs = replace(blade, stiffness_0=np.diag(springs))
    assert tip_stiffness(on_springs) == pytest.approx(8 * 2e6)


def test_track_area_of_even_nodes(blade):
    x = np.linspace(0, 0.07, 8)
    on_a_circle = replace(blade, node_position=np.column_stack([x, np.zeros(8), np.full(8, 0.5)]))
    # strips of a seventh of the chord, half of one at the edges
    assert track_area(on_a_circle) == pytest.approx(2 * np.pi * 0.5 * 0.07 / 8)
