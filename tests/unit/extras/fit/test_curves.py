import numpy as np
import pytest

from bladerub.extras.fit.curves import read
from bladerub.io.errors import BadInput

ROWS = ["0.01,5,1", "0.02,9,1", "0.03,10,1", "0.01,6,100", "0.02,11,100", "0.03,12,100"]


@pytest.fixture
def table(tmp_path):
    """Write a table and return its path."""

    def written(header, rows=ROWS):
        path = tmp_path / "curves.csv"
        path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
        return path

    return written


def test_a_curve_for_each_rate_in_si_by_the_units_of_the_header_or_those_given(table):
    slow, fast = read(table("Strain [%], stress (MPa), rate (1/s)"))
    assert (slow.rate, fast.rate) == (1, 100)
    np.testing.assert_allclose(slow.strain, [1e-4, 2e-4, 3e-4])
    np.testing.assert_allclose(fast.stress, [6e6, 11e6, 12e6])
    path = table("strain,stress (MPa),rate")
    assert read(path, {"stress": "Pa"})[0].stress[0] == 5e6
    assert read(table("strain,stress,rate"), {"stress": "kPa"})[0].stress[0] == 5e3


def test_a_spreadsheet_with_decimal_commas_gives_the_same_curves(table):
    path = table("strain,stress (Pa),rate")
    plain, text = read(path), path.read_text().replace(",", ";").replace(".", ",").replace("\n", "\r\n")
    path.write_bytes(b"\xef\xbb\xbf" + text.encode())
    for ours, theirs in zip(read(path), plain, strict=True):
        np.testing.assert_array_equal(ours.strain, theirs.strain)


@pytest.mark.parametrize(
    ("header", "rows", "words"),
    [
        ("strain,force,rate", ROWS, "no column stress"),
        ("strain,stress,rate", ROWS, "column stress: has no unit"),
        ("strain,stress (Pa),rate", ["0.01,x,1", *ROWS], "line 2: stress = x, must be a finite number"),
        ("strain,stress (Pa),rate", [*ROWS, "-0.04,1,1"], "line 8: strain = -0.04, must be from 0"),
        ("strain,stress (Pa),rate", [*ROWS, "1.5,12,1"], "line 8: strain = 1.5, must be from 0 to 1 1"),
        ("strain,stress (Pa),rate", ["0.01,-5,1"] * 5, "stress: is negative"),
        ("strain,stress (Pa)", [f"{0.5 - 0.1 * n},{5 - n}" for n in range(5)], "begins at its largest"),
        ("strain,stress (Pa),rate", [f"0.{n},{n},1.{n}" for n in range(1, 7)], "the rate 1.1 1/s has 1 rows"),
        ("test,stress (Pa),rate,strain", ["a,1,1,1"] * 4 + ["a,1,2,1"], "test a has 2 rates"),
    ],
)
def test_bad_tables_are_named(table, header, rows, words):
    with pytest.raises(BadInput) as refused:
        read(table(header, rows))
    assert words in str(refused.value)
