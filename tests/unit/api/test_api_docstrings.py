"""Every public name is documented, and its examples do what they say."""

import doctest
import inspect
import re
from pathlib import Path

import pytest

import bladerub as br

NAMES = [name for name in dir(br) if name != "__version__"]


def members(cls):
    public = ((name, value) for name, value in vars(cls).items() if not name.startswith("_"))
    return [
        each for each in public if inspect.isfunction(each[1]) or isinstance(each[1], (property, classmethod))
    ]


@pytest.mark.parametrize("name", NAMES)
def test_public_name_has_a_docstring_an_example_and_documented_members(name):
    public = getattr(br, name)
    text = inspect.getdoc(public)
    assert "Examples\n--------\n" in text
    if inspect.isclass(public):
        assert [member for member, value in members(public) if not inspect.getdoc(value)] == []
        examples = text.partition("Examples\n--------\n")[2] + "".join(
            inspect.getdoc(value).partition("Examples\n--------\n")[2] for _, value in members(public)
        )
        assert [member for member, _ in members(public) if f".{member}" not in examples] == []
    elif inspect.signature(public).parameters:
        assert "Raises\n------\n" in text


def test_every_public_name_is_on_the_page_of_the_interface():
    page = (Path(__file__).parents[3] / "docs" / "reference" / "api.md").read_text(encoding="utf-8")
    documented = re.findall(r"^\.\. auto(?:function|class|exception):: (\w+)$", page, re.M)
    assert sorted(documented) == sorted(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_examples_of_a_public_name_run(name, study, blade, run, sweep, small, tmp_path, monkeypatch):
    monkeypatch.setenv("BLADERUB_CACHE", str(small / "cache"))
    monkeypatch.chdir(tmp_path)
    names = {"br": br, "study": study, "blade": blade, "run": run, "sweep": sweep}
    examples = doctest.DocTestFinder().find(getattr(br, name), name, globs=names)
    runner = doctest.DocTestRunner()
    for example in examples:
        runner.run(example)
    tried, failed = runner.summarize(verbose=False).attempted, runner.failures
    assert tried > 0
    assert failed == 0
