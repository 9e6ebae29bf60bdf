import json

import pytest
from stand_in import COARSE

from bladerub import plugins
from bladerub.cli import inputs, main
from bladerub.io.folders import ROOT

SHORT = """contact: {elements: 200}
coatings: [{casing: 2nd, E: [2, 20], K: [0.5], theta: [0.15]}]
speeds: {start: 0.2, stop: 0.4, step: 0.1, extra: []}
solver: {revolutions: 3}
analysis: {spectrum_revolutions: 2, divergence: {revolutions: 3}, histories: []}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("repository")
    (folder / "small.yaml").write_text(COARSE)
    return folder


@pytest.fixture
def command(capsys):
    """Give a command: exit code, what it printed and its errors."""

    def give(*words):
        capsys.readouterr()
        try:
            code = main([str(word) for word in words])
        except SystemExit as end:  # argparse ends the program itself
            code = end.code
        return code, *capsys.readouterr()

    return give


@pytest.fixture
def figures(command):
    """Give a command, which must succeed: what it prints as JSON."""

    def give(*words):
        code, out, err = command(*words, "--json")
        assert code == 0, err
        assert all(line.startswith(f"bladerub {words[0]}: ") for line in err.splitlines())
        return json.loads(out)

    return give


@pytest.fixture
def refusal(command):
    """Give a command, which must be refused by one line: that line."""

    def give(*words):
        code, out, err = command(*words)
        assert (code, out, err.count("\n")) == (2, "", 1)
        return err

    return give


@pytest.fixture
def at_home(folder, monkeypatch):
    monkeypatch.setattr(inputs, "study_folder", lambda: folder)


@pytest.fixture
def six_runs(folder, at_home):
    (folder / "six.yaml").write_text(COARSE + SHORT)
    return ["--config", folder / "six.yaml"]


@pytest.fixture(autouse=True)
def without_a_study(monkeypatch):
    """Leave out what made the results that this clone may hold: commands would read their config."""
    for record in plugins.loaded("RECORDS").values():
        read = record.read
        monkeypatch.setattr(
            record,
            "read",
            lambda results, read=read: None if results.is_relative_to(ROOT) else read(results),
        )
