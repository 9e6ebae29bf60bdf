"""``bladerub check-law`` as it is called, with laws from files."""

from pathlib import Path

import pytest

from bladerub.cli import main
from bladerub.contact import law
from bladerub.extras.verification import element_law

PAPER = Path(law.__file__).read_text(encoding="utf-8")
FORCE = "return maximum(trial - element.elastic * increment, 0.0), increment"


@pytest.fixture
def written(tmp_path, monkeypatch):
    """Write a law to a file: that of the paper, with something else in the place of its force."""
    monkeypatch.setattr(element_law, "TIME_STEPS", (1e-6,))

    def write(force=FORCE):
        path = tmp_path / "mine.py"
        path.write_text(PAPER.replace(FORCE, force), encoding="utf-8")
        return str(path)

    return write


def test_a_right_law_is_said_to_be_right(written, monkeypatch, capsys):
    monkeypatch.setattr(element_law, "compile_kernel", lambda law: None)
    assert main(["check-law", written()]) == 0
    assert capsys.readouterr().out == "mine: 120 histories, no problem; it compiles with the time loop\n"


def test_a_wrong_law_is_told_what_is_wrong(written, capsys):
    path = written(FORCE.replace(", increment", ", -increment"))
    assert main(["check-law", path]) == 1
    assert "- wear is negative (depth " in capsys.readouterr().out


def test_bad_input_is_answered_in_one_line(capsys):
    assert main(["check-law", "none.py"]) == 2
    line = capsys.readouterr().err
    assert "file = none.py: there is no such file" in line
    assert line.count("\n") == 1
