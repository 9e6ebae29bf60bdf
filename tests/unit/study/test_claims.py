import pytest

from bladerub.study.findings import claim as register
from bladerub.study.findings.claim import above, below, claim, in_order


@pytest.fixture
def registered(monkeypatch):
    monkeypatch.setattr(register, "REGISTERED", {})
    return register.REGISTERED


def test_claims_come_by_number_and_part_whatever_the_order_of_their_registration(registered):
    for id_ in ("C10b", "C2", "C9e", "C10a", "B3a"):
        claim(id_, "statement")(lambda evidence: None)
    assert [each.id for each in in_order()] == ["B3a", "C2", "C9e", "C10a", "C10b"]


@pytest.mark.parametrize("id_", ["C1a", "", "C4ab", "c4a"])
def test_an_id_is_taken_once_and_of_one_form(registered, id_):
    claim("C1a", "statement")(lambda evidence: None)
    with pytest.raises(ValueError, match="C1a" if id_ == "C1a" else "id"):
        claim(id_, "another")


@pytest.mark.parametrize(("judge", "sign"), [(below, 1), (above, -1)])
def test_verdicts_at_their_borders(judge, sign):
    for value, expected in ((1.0, "yes"), (1.5, "partly"), (2.0, "partly"), (2.25, "no")):
        assert judge(sign * value, sign * 1.0, sign * 2.0) == (expected, 1.0 - value)
    assert judge(float("nan"), 1.0, 2.0)[0] == "no"


@pytest.mark.parametrize(("one", "other"), [(0.31, 0.3), (0.316, 0.306), (0.335, 0.325), (0.19, 0.18)])
def test_speeds_of_the_grid_that_lie_as_far_apart_as_a_border_are_within_it(one, other):
    assert below(one - other, 0.01, 0.02)[0] == "yes"
    assert above(other - one, -0.01, -0.02)[0] == "yes"
