import numpy as np
import pytest
from section_parts import cylindrical, twisted_plate

from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.section_table import read

COMMAS = """# a plate
Section, Z, r, Theta1, THETA2, remark
hub end, 0, 40, 0.0, 0.0, nose
hub end, 1, 40, -0.01, 0.01,
hub end, 2, 40.5, -0.02, 0.01,   # the thickest

hub end, 3, 41, -0.01, 0.01,
hub end, 4, 41, 0, 0,
tip, 0, 60, 0, 0, nose
tip, 1, 60, -0.01, 0.01,
tip, 2, 60, -0.02, 0.01,
tip, 3, 60, -0.01, 0.01,
tip, 4, 60, 0, 0,
"""
SPACES = COMMAS.replace("hub end", "1").replace("tip", "2").replace(" nose", "").replace(", remark", "")
SPACES = SPACES.replace(",   # the", ",  # the").replace(",\n", "\n").replace(", ", "   ").replace(",", "")


@pytest.fixture
def table(tmp_path):
    """Read a text as a table of sections in cm."""

    def sections(text, angle_unit="rad", name="blade.csv"):
        (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        return read(tmp_path / name, Frame("cm"), angle_unit)

    return sections


def test_stations_are_read_with_their_lines(table):
    hub, tip = table(COMMAS)
    assert (hub.name, tip.name) == ("hub end", "tip")
    assert hub.lines.tolist() == [3, 4, 5, 7, 8]
    assert hub.points.shape == (2, 5, 3)
    x, y, z = hub.points[0, 2]
    assert x == pytest.approx(0.02)
    assert np.hypot(y, z) == pytest.approx(0.405)
    assert np.arctan2(y, z) == pytest.approx(0.02)  # the blade turns about -x, angles about x


@pytest.mark.parametrize("name", ["blade.txt", "BLADE.DAT"])
def test_white_space_and_byte_order_marks_do(table, name):
    for ours, theirs in zip(table(COMMAS), table(b"\xef\xbb\xbf" + SPACES.encode(), name=name), strict=True):
        np.testing.assert_array_equal(ours.points, theirs.points)


def test_degrees_are_radians_by_another_name(table):
    in_degrees = cylindrical(twisted_plate)
    in_degrees[["theta1", "theta2"]] = np.rad2deg(in_degrees[["theta1", "theta2"]])
    for ours, theirs in zip(
        table(in_degrees.to_csv(index=False), angle_unit="deg"),
        table(cylindrical(twisted_plate).to_csv(index=False)),
        strict=True,
    ):
        np.testing.assert_allclose(ours.points, theirs.points, atol=1e-14)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (COMMAS.replace("2, 40.5,", "2, ,"), "line 5: r = nothing, must be a finite number"),
        (COMMAS + COMMAS[COMMAS.index("hub") : COMMAS.index("tip")], "line 14: section hub end comes back"),
        (COMMAS.replace("0.01", "10"), "section hub end .* over 20 rad, .* are they in rad"),
    ],
)
def test_what_is_no_table_is_refused_with_line_or_section(table, text, said):
    with pytest.raises(ValueError, match=said):
        table(text)
