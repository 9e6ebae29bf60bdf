"""What the ensembles will cost."""

import numpy as np

from bladerub.study.ensemble import expected_cost, named
from bladerub.study.grid import CoatingCase, speeds
from bladerub.study.paper import WORN

CASE = CoatingCase("2nd", 1.1, 0.5, 0.0)


def test_each_peak_has_three_speeds_and_each_history_its_own(config):
    config["ensemble"]["members"] = 2
    config["analysis"]["histories"] = []
    assert expected_cost(config, CASE) == (2 + 2) * 3 * 2
    config["analysis"]["histories"] = [
        {"casing": "2nd", "E": 1.1, "K": 0.5, "theta": 0.0, "f_omega": f} for f in (0.1, 0.2)
    ]
    assert expected_cost(config, CASE) == (2 + 2) * (2 + 3 * 2)
    config["ensemble"]["members"] = 0
    assert expected_cost(config, CASE) == 0


def test_the_claims_on_lobes_name_the_speeds_of_one_coating(config):
    listed = np.array(speeds(config))
    at_lobes = named(config, WORN, listed)
    assert at_lobes.sum() > 100
    assert at_lobes[0]
    assert not at_lobes[(listed > 0.15) & (listed < 0.2)].any()
