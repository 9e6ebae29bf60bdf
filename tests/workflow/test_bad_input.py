"""Bad configs, files and command lines: one line each that names the culprit, exit code 2, nothing written.

All of them go through the functions behind the commands; a sample goes through the commands themselves, and
``python tests/workflow/all_bad_inputs.py`` puts all of them through those.
"""

from pathlib import Path

import pytest
import yaml
from bad_inputs import COMMANDS, CONFIGS, UNREADABLE, make_files
from broken_blades import IMPORTS, make_blades

from bladerub.cli import inputs, main

ALL_CONFIGS = CONFIGS | UNREADABLE


def write_overlay(folder: Path, content: dict | str | bytes) -> None:
    if isinstance(content, dict):
        content = yaml.safe_dump(content)
    (folder / "overlay.yaml").write_bytes(content.encode() if isinstance(content, str) else content)


@pytest.fixture
def command(tmp_path, monkeypatch, capsys):
    """Run a command line in an empty folder that stands for the repository: exit code and standard error."""
    monkeypatch.setattr(inputs, "study_folder", lambda: tmp_path)
    monkeypatch.chdir(tmp_path)

    def run(arguments):
        before = sorted(tmp_path.rglob("*"))
        try:
            code = main(arguments)
        except SystemExit as end:  # argparse ends the program itself
            code = end.code
        assert sorted(tmp_path.rglob("*")) == before
        output = capsys.readouterr()
        assert output.out == ""
        return code, output.err

    return run


@pytest.mark.parametrize("case", ALL_CONFIGS)
def test_bad_config(command, tmp_path, case):
    content, words = ALL_CONFIGS[case]
    write_overlay(tmp_path, content)
    code, line = command(["status", "--config", "overlay.yaml"])
    assert code == 2
    assert line.startswith(words)
    assert line.count("\n") == 1


@pytest.mark.parametrize("line", COMMANDS)
def test_bad_command_line(command, tmp_path, line):
    make_files(tmp_path)
    code, output = command(line.split())
    assert code == 2
    assert COMMANDS[line] in output
    assert output.count("\n") == 1


@pytest.fixture(scope="module")
def blades(tmp_path_factory):
    """Here are the blades that cannot be one."""
    folder = tmp_path_factory.mktemp("broken")
    make_blades(folder)
    return folder


@pytest.mark.parametrize("line", IMPORTS)
def test_broken_blade(blades, monkeypatch, capsys, line):
    monkeypatch.chdir(blades)
    before = sorted(blades.rglob("*"))
    assert main(line.split()) == 2
    assert sorted(blades.rglob("*")) == before
    output = capsys.readouterr()
    assert output.out == ""
    assert IMPORTS[line] in output.err
    assert output.err.count("\n") == 1


def lines_of_ours(stderr: str) -> list[str]:
    """Snakemake says that it uses a profile and lays one config over the other; all else must be ours."""
    its_own = ("Config file config/config.yaml is extended", "Using workflow specific profile")
    return [line for line in stderr.splitlines() if not line.startswith(its_own)]


SAMPLE = [
    "unknown key",
    "number with its unit",
    "not a number",
    "sections out of order",
    "mesh beyond all memory",
    "speed above the reduced model's",
    "E of nothing",
    "a million coatings",
    "casing named like a path",
    "results outside the repository",
    "results among the sources",
    "extends itself",
    "aliases without end",
]


@pytest.mark.parametrize("case", SAMPLE)
def test_snakemake_with_a_bad_config(workspace, case):
    config, words = CONFIGS[case]
    done = workspace.snakemake("--cores", "1", config=config)
    (line,) = lines_of_ours(done.stderr)
    assert line.startswith(words)
    assert done.stdout == ""
    assert done.returncode == 2
    assert not (workspace.folder / "results").exists()


@pytest.mark.parametrize("case", ["call of a function", "groups without end", "other encoding"])
def test_snakemake_with_a_config_that_it_does_not_read_itself(workspace, case):
    content, words = UNREADABLE[case]
    write_overlay(workspace.folder, content)
    done = workspace.snakemake("--cores", "1", "--config", "extend=overlay.yaml")
    (line,) = lines_of_ours(done.stderr)
    # a file that cannot be opened has no line: the key that asked for it is named
    where = words.replace("overlay.yaml: ", '--config: extend = "overlay.yaml": ')
    assert line.startswith(where)
    assert done.returncode == 2
    assert not (workspace.folder / "results").exists()


def test_all_problems_are_reported_at_once_with_their_locations(workspace):
    (workspace.folder / "mine.yaml").write_text("extend: config/quick.yaml\nblade:\n  length: 200\n")
    done = workspace.snakemake(
        "--cores", "1", "--configfile", "mine.yaml", "--config", "coating=[]", "figures={dpi: 2}"
    )
    assert [line.split("=")[0] for line in lines_of_ours(done.stderr)] == [
        "--config: coating ",
        "mine.yaml:3: blade.length ",
        "--config: figures.dpi ",
    ]
    assert done.returncode == 2


def test_a_malformed_study_is_answered_with_file_and_line(workspace):
    path = workspace.folder / "config" / "config.yaml"
    path.write_text("results: results\nblade: [1\ncontact: 2\n")
    done = workspace.snakemake("--cores", "1")
    (line,) = lines_of_ours(done.stderr)
    assert line.startswith("config/config.yaml:3: not valid YAML")
    assert done.returncode == 2
    assert not (workspace.folder / "results").exists()


def test_what_a_config_extends_lies_under_it_and_the_command_line_over_all(workspace, tiny):
    folder = workspace.folder
    (folder / "deeper").mkdir()
    (folder / "deeper" / "base.yaml").write_text(
        yaml.safe_dump(tiny | {"results": "extended", "figures": {"dpi": 31, "max_frequency": 2}})
    )
    (folder / "mine.yaml").write_text(
        "extend: deeper/base.yaml\nresults: own\nfigures: {dpi: 32}\n"
        "coatings: [{casing: 2nd, E: [2], K: [0.5], theta: [0.0, 0.15]}]\nsolver: {max_time_step: 25e-8}\n"
    )
    done = workspace.snakemake(
        "--dry-run", "--configfile", "mine.yaml", "--config", "figures={max_frequency: 1e0}", "results=said"
    )
    assert done.returncode == 0, done.stderr
    assert "said/maps/2nd_E2_K0.5_theta0.15.h5" in done.stdout
    assert "2nd5nd" not in done.stdout
    assert "own/" not in done.stdout
    assert "extended/" not in done.stdout
