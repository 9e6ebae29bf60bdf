import pytest

from bladerub.config.errors import UNKNOWN
from bladerub.config.files import Located
from bladerub.extras.variations.factors import Factor, lay_over

UNIT = Factor("unit", "Pa", {"contact.modulus_unit": (1e8, 1e10)}, logarithmic=True)
DEPTH = Factor("depth", "m", {"casings.2nd.interference": (0.2, 0.6), "casings.5nd.interference": (0.3, 0.7)})
TURNS = Factor("turns", "1", {"contact.tip_turns": (0.0, 1.0)}, multiple_of=1.0)
STUDY = {
    "contact": {"modulus_unit": 1e9, "tip_turns": False},
    "casings": {"2nd": {"interference": 0.5}, "5nd": {"interference": 0.4}},
}


@pytest.mark.parametrize(("factor", "fraction"), [(UNIT, 0.5), (DEPTH, 0.75), (TURNS, 0.0)])
def test_own_value_lies_at_its_fraction_of_the_range(factor, fraction):
    assert factor.position(factor.own(STUDY)) == pytest.approx(fraction)
    assert factor.first_value(fraction) == pytest.approx(factor.own(STUDY))


@pytest.mark.parametrize(("position", "turns"), [(0.0, False), (0.49, False), (0.51, True), (1.0, True)])
def test_factors_set_numbers_and_switches(position, turns):
    varied = lay_over(Located.of(STUDY, UNKNOWN), (UNIT, DEPTH, TURNS), (1.0, 0.25, position)).plain()
    assert varied["contact"] == {"modulus_unit": pytest.approx(1e10), "tip_turns": turns}
    assert varied["casings"]["2nd"]["interference"] == pytest.approx(0.3)
    assert varied["casings"]["5nd"]["interference"] == pytest.approx(0.4)
    assert STUDY["contact"]["modulus_unit"] == 1e9
