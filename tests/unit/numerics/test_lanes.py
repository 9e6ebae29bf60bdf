import pytest

from bladerub.numerics import lanes


@pytest.mark.parametrize(("n_nodes", "wanted"), [(4, 8), (8, 8), (9, 16), (16, 16), (17, 32), (32, 32)])
def test_lanes_are_the_next_power_of_two_from_eight_on(n_nodes, wanted):
    assert lanes.lanes_for(n_nodes) == wanted
