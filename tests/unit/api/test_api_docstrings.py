import doctest
import re
from pathlib import Path

import pytest

import bladerub as br

NAMES = [name for name in dir(br) if name != "__version__"]


@pytest.mark.extras
def test_every_public_name_is_on_the_page_of_the_interface():
    page = (Path(__file__).parents[3] / "docs" / "reference" / "api.md").read_text(encoding="utf-8")
    documented = re.findall(r"^\.\. auto(?:function|class|exception):: (\w+)$", page, re.M)
    assert sorted(documented) == sorted(NAMES)


@pytest.mark.extras
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
