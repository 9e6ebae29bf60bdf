import numpy as np
import pytest

from bladerub.extras import cells

ANGLE = np.array([0.0, 0.5, 10.0, 20.5])
GAP = np.array([12.0, -13.73, 0.0042, 1500.0])


@pytest.mark.parametrize("first", ["", "# cold; 3,5 mm\n\n"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
@pytest.mark.parametrize(
    ("separator", "decimal"),
    [(",", "."), (";", "."), (";", ","), ("\t", ","), (" ", ","), ("  ", "."), (", ", ".")],
)
def test_the_numbers_are_those_of_the_file(tmp_path, separator, decimal, mark, end, first):
    rows = [[f"{value:.4f}".replace(".", decimal) for value in row] for row in zip(ANGLE, GAP, strict=True)]
    lines = [separator.join(row) for row in [["Angle", "gap"], *rows]]
    path = tmp_path / "table.csv"
    path.write_bytes((mark + (first + "\n".join(lines)).replace("\n", end)).encode())
    table = cells.read(path)
    np.testing.assert_array_equal(table.numbers("angle"), ANGLE)
    np.testing.assert_array_equal(table.numbers("gap"), np.round(GAP, 4))
    assert next(iter(table.rows)) == table.header + 1 == first.count("\n") + 2


@pytest.mark.parametrize(
    "text",
    [
        'angle,gap\n"0","12.5"\n',
        "angle;gap;;\n0;12,5;;\n;;;\n",
        "sep=;\nangle;gap\n0;12,5\n",
        "angle\tgap\n0\t1.25D+01\n",
        'angle\tgap\n0\t"12,5"\n',
        ",angle,gap\n0,0,12.5\n",
        "angle,gap # mm\n0,12.5 # by hand\n",
    ],
)
def test_what_spreadsheets_add_is_taken(tmp_path, text):
    path = tmp_path / "table.csv"
    path.write_text(text)
    assert cells.read(path).numbers("gap").tolist() == [12.5]


def test_what_cannot_be_meant_is_refused_with_its_line(tmp_path):
    for text, said in (
        ("angle,gap\n0,5,12,00\n", "line 2: has 4 cells.*semicolons"),
        ("angle gap\n0 1\n1 12 # two\n2\n", "line 4: has 1 cells"),
        ('angle,gap\n0,"1,234.5"\n', "line 2: gap = 1,234.5"),
        ("angle;gap\n0;999,5\n1;1.000\n", "line 3 has 1.000 and line 2 999,5"),
        ("angle;gap\n0;1,800\n10;12,600\n", "line 2 has 1,800: .* Write 1.800 or 1800"),
        ("gap;angle\n0;1\n#DIV/0!;1\n", "line 3: gap = #DIV/0!"),
        ("angle;gap\n0;nan\n", "line 2: gap = nan"),
        ("angle;gap\n0;\u0663\n", "line 2: gap"),
        ("gap;Gap\n0;1\n", "line 1: has the column gap twice"),
        ("angle;gap\n", "no rows"),
        ("", "is empty"),
    ):
        path = tmp_path / "table.csv"
        path.write_text(text, encoding="utf-8")
        with pytest.raises(ValueError, match=said):
            cells.read(path).numbers("gap")
    path.write_bytes("# gemessen für Öl\nangle;gap\n0;1\n".encode("latin-1"))
    with pytest.raises(ValueError, match="UTF-8"):
        cells.read(path)
