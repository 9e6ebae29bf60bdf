import os

import pytest
import yaml

from bladerub.config import files
from bladerub.config.errors import ConfigError, key_path
from bladerub.config.files import LARGEST_FILE, LONGEST_VALUE, MOST_VALUES, compose
from bladerub.config.read import read
from bladerub.io.errors import format_value
from bladerub.io.folders import ROOT

STUDY = ROOT / "config" / "config.yaml"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def write(**files):
        for name, content in files.items():
            content = content.encode() if isinstance(content, str) else content
            (tmp_path / f"{name}.yaml").write_bytes(content)

    return write


def error_of(path):
    with pytest.raises(ConfigError) as error:
        compose(path)
    return str(error.value)


def test_every_value_has_the_location_that_it_comes_from(folder):
    folder(alias="a: &a [1, 2]\nb: *a\n")
    assert compose("alias.yaml").plain() == {"a": [1, 2], "b": [1, 2]}
    folder(base="a:\n  b: 1\n  c: 2\nlist:\n  - x: 1\n    y: 2\n  - {x: 3}\n", over="a: {c: 3,\n    d: 4}\n")
    composed = compose("base.yaml", "over.yaml", command_line={"a": {"d": "5", "e": "6"}})
    assert composed.plain() == {"a": {"b": 1, "c": 3, "d": 5, "e": 6}, "list": [{"x": 1, "y": 2}, {"x": 3}]}
    reported_at = {"--config": "a a.d a.e", "base.yaml:2": "a.b", "over.yaml:1": "a.c", "base.yaml:4": "list"}
    reported_at |= {"base.yaml:5": "list[0] list[0].x", "base.yaml:6": "list[0].y"}
    reported_at |= {"base.yaml:7": "list[1] list[1].x"}
    expected = {key: location for location, keys in reported_at.items() for key in keys.split()}
    assert {key: str(location) for key, location in composed.locations().items()} == expected


def test_the_command_line_reads_values_as_a_file_does():
    texts = ["1", "0.5", "1e-3", "true", "2nd", "", ".nan"]
    *values, last = compose(command_line={"a": texts}).plain()["a"]
    assert values == [1, 0.5, 1e-3, True, "2nd", None]
    assert str(last) == "nan"


def test_as_many_levels_and_characters_are_read_as_the_limits_say(folder):
    lists = files.DEEPEST - 1  # in the mapping at the top
    for inside, outside, answer in (
        (f"a: {'[' * lists}{']' * lists}", f"a: [{'[' * lists}{']' * lists}]", "32 levels"),
        (f"a: {'x' * LONGEST_VALUE}", f"a: {'x' * (LONGEST_VALUE + 1)}", f"more than {LONGEST_VALUE} char"),
        (f"{'x' * LONGEST_VALUE}: a", f"{'x' * (LONGEST_VALUE + 1)}: a", f"more than {LONGEST_VALUE} char"),
    ):
        folder(a=inside, b=outside)
        compose("a.yaml")
        assert answer in error_of("b.yaml")


def laughs():
    lines = ["x0: &x0 [z, z]"]
    lines += [f"x{i + 1}: &x{i + 1} [{', '.join([f'*x{i}'] * 10)}]" for i in range(12)]
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("content", "answer"),
    [
        (laughs(), f"more than {MOST_VALUES} values"),
        ("a: " + "[" * 5000 + "]" * 5000, "a.yaml:1: not valid YAML (more than 32 levels in one another)"),
        ("b: 1\na: &a [*a]", "a.yaml:2: not valid YAML"),
        ("#" * (LARGEST_FILE + 1), "a.yaml: is larger than 1 MB"),
        ("a: 1\nb: !!python/object/apply:os.system [exit]", "a.yaml:2: not valid YAML (the tag"),
        ("a: 2001-99-99", "a.yaml:1: not valid YAML"),
        ("a: 1\n1: 2", 'a.yaml:2: not valid YAML (a key must be text, write "1")'),
        ("a: 1\n---\nb: 2", "a.yaml:2: not valid YAML"),
        (b"a: 1\nb: x\0y", "a.yaml:2: not valid YAML (special characters are not allowed), column 5"),
        (b"a: \xe9", "a.yaml: is not text in UTF-8"),
        ("a: 1\n\nb: 2\nb: 3\n", "a.yaml:4: not valid YAML (b is given twice)"),
        ("", "must hold keys at its top level"),
    ],
)
def test_hostile_files_are_answered_in_one_line(folder, content, answer):
    folder(a=content)
    line = error_of("a.yaml")
    assert answer in line
    assert "\n" not in line
    assert len(line) < 250


def test_only_regular_files_are_opened(folder, tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")
    assert error_of("pipe.yaml") == "pipe.yaml: is not a regular file, must be a YAML file"
    assert error_of(tmp_path).endswith("is a folder, must be a YAML file")
    (tmp_path / "loop.yaml").symlink_to("loop.yaml")
    assert error_of("loop.yaml") == "loop.yaml: cannot be read (Too many levels of symbolic links)"


def test_keys_and_values_are_written_on_one_short_line():
    assert key_path(("casings", "../2nd", 0, "E")) == 'casings["../2nd"][0].E'
    assert format_value(list(range(100))).endswith("15, 16...")
    assert format_value("a\nb\x1b[31m") == '"a b [31m"'


@pytest.mark.extras(cases=r"law")
@pytest.mark.parametrize(
    ("text", "reading", "key"),
    [
        ("solver: {revolutions: 020}", "16", "solver.revolutions"),
        ("casings: {2nd: {start_angle: -010}}", "-8", "casings.2nd.start_angle"),
        ("coatings: [{casing: 2nd, E: [0x14], K: [1], theta: [0]}]", "20", "coatings[0].E[0]"),
        ("contact: {law: {name: viscoplastic, viscosity: 1:30.5}}", "90.5", "contact.law.viscosity"),
    ],
)
def test_a_number_that_yaml_reads_otherwise_is_refused(tmp_path, problems, text, reading, key):
    """As in files, so after ``--config``, where Snakemake leaves numbers as text."""
    over = tmp_path / "over.yaml"
    over.write_text(text)
    given = yaml.load(text, Loader=yaml.BaseLoader)
    for paths, command_line, where in (((STUDY, over), None, f"{over}:1"), ((STUDY,), given, "--config")):
        (problem,) = problems(*paths, by=read, command_line=command_line)
        assert str(problem).startswith(f"{where}: {key} = ")
        assert reading in problem.text


def test_a_number_that_can_mean_but_one_is_read(folder):
    folder(over="a: [2_0, 020.0, 2e1]\n")
    assert files.read("over.yaml").plain() == {"a": [20, 20, 20]}
