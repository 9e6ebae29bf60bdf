from bladerub.extras.friction.coatings import compared
from bladerub.study import grid


def test_compared_coatings_are_found_by_name_and_are_no_part_of_the_study(config):
    config["friction"] = [{"casing": "2nd", "E": [3], "K": [0.5], "theta": [0.15, 0.3]}]
    cases = compared(config)
    assert [case.name for case in cases[:2]] == ["2nd_E3_K0.5_theta0.15", "2nd_E3_K0.5_mu0.151135"]
    assert [grid.case_from_name(config, case.name) for case in cases] == cases
    assert not set(cases) & set(grid.coating_cases(config))
