import pytest

from bladerub.extras.blades.deck_material import read

STEEL = {"young_modulus": 2.1e11, "poisson_ratio": 0.3, "density": 7850.0}
DECK = "*HEADING\nblade\n*MATERIAL, NAME={}\n*ELASTIC\n{}\n*DENSITY\n{}\n"


@pytest.mark.parametrize(
    ("unit", "elastic", "density"),
    [
        ("mm", "210000, 0.3", "7.85e-9"),
        ("m", "2.1e11, .3,", "7850."),
        ("ft", "4.385941188e9, 0.3", "15.23120"),
    ],
)
def test_units_go_with_that_of_length(unit, elastic, density, tmp_path):
    (tmp_path / "m.inp").write_text(DECK.format("Steel", elastic, density))
    assert read(tmp_path / "m.inp", unit) == pytest.approx(STEEL, rel=1e-4)


def test_the_section_tells_which_material_is_the_blades_and_a_deck_may_have_none(tmp_path):
    other = DECK.format("Nickel", "205000, 0.31", "8.2e-9")
    section = '*Solid Section, elset=E, material="steel"\n'
    (tmp_path / "m.inp").write_text(other + DECK.format("Steel", "** MPa\n210000, 0.3", "7.85e-9") + section)
    assert read(tmp_path / "m.inp", "mm") == pytest.approx(STEEL)
    (tmp_path / "m.inp").write_text("*NODE\n1, 0, 0, 0\n")
    assert read(tmp_path / "m.inp", "mm") is None


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (DECK.format("A", "210000, 0.3", "7.85e-9") + DECK.format("B", "1e5, 0.3", "5e-9"), "materials A, B"),
        ("*MATERIAL, NAME=A\n*ELASTIC\n210000, 0.3\n", "A has no .DENSITY"),
        (DECK.format("A", "210000,0, 0,3", "7.85e-9"), "ELASTIC of A is 210000,0, 0,3, must be 2 numbers"),
        (DECK.format("A", "210, 0.3", "7.85e-6"), "Young modulus of 210 is 2.1e.08 Pa with the unit mm"),
        (DECK.format("A", "1, 2", "3").replace("IC", "IC, TYPE=ENGINEERING CONSTANTS"), "not isotr"),
    ],
)
def test_what_is_not_one_isotropic_material_is_told(text, said, tmp_path):
    (tmp_path / "m.inp").write_text(text)
    with pytest.raises(ValueError, match=said):
        read(tmp_path / "m.inp", "mm")
