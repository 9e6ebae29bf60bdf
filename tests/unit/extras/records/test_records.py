import re
from pathlib import Path
from types import SimpleNamespace

import pytest

from bladerub.config.read import LaidOver
from bladerub.extras.records import record
from bladerub.io.errors import BadInput
from bladerub.workflow import invocation


def test_what_was_laid_over_the_config_comes_back(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    files = [Path("config/config.yaml"), tmp_path / "config" / "quick.yaml", Path("/elsewhere/own.yaml")]
    record.write("results", LaidOver(files, {"results": "results"}))
    found = record.read(tmp_path / "results")
    assert found == LaidOver(["config/quick.yaml", "/elsewhere/own.yaml"], {"results": "results"})
    assert record.in_words(found) == "--config config/quick.yaml /elsewhere/own.yaml results=results"


@pytest.mark.parametrize("text", [None, "", "[1]", '{"files": 1}', '{"files": [], "command_line": [1]}'])
def test_nothing_was_laid_over_or_the_record_is_damaged(tmp_path, monkeypatch, text):
    monkeypatch.chdir(tmp_path)
    record.write("results", LaidOver(["config/config.yaml"]))
    if text is not None:
        (tmp_path / "results" / record.FILE).write_text(text)
    assert record.read(tmp_path / "results") is None


@pytest.fixture
def workflow_with(tmp_path, monkeypatch):
    persistence = SimpleNamespace(path=tmp_path, all_outputfiles=list, all_inputfiles=list)
    monkeypatch.setattr(invocation, "_planned", [])
    monkeypatch.setenv("PYTHONPATH", "")

    def workflow(targets=()):
        return SimpleNamespace(
            scheduler=SimpleNamespace(job_rate_limiter=None),
            local_exec=True,
            persistence=persistence,
            dag_settings=SimpleNamespace(targets=list(targets)),
        )

    return workflow


def test_targets_of_results_of_another_config_are_refused(workflow_with, tmp_path):
    record.write(tmp_path, LaidOver(["config/quick.yaml"], {"solver": {"revolutions": 3}}))
    invocation.plan(str(tmp_path), LaidOver(()))
    made_with = """--configfile config/quick.yaml --config 'solver={"revolutions": 3}'"""
    with pytest.raises(BadInput, match=re.escape(made_with)):
        invocation.start(workflow_with(targets={"stress"}))


@pytest.mark.parametrize(("output", "files"), [("docs/config.md", 1), ("{}/figures/fig01.png", 0)])
def test_the_config_is_recorded_with_new_results_alone(workflow_with, monkeypatch, tmp_path, output, files):
    monkeypatch.setattr(invocation.plugins, "loaded", lambda kind: {"": record} if kind == "RECORDS" else {})
    record.write(tmp_path, LaidOver(["config/quick.yaml"]))
    invocation.plan(str(tmp_path), LaidOver(("config/config.yaml",)))
    workflow = workflow_with()
    workflow.dag = SimpleNamespace(needrun_jobs=lambda: [SimpleNamespace(output=[output.format(tmp_path)])])
    invocation.start(workflow)
    made_with = record.read(tmp_path)
    assert len(made_with.files if made_with else ()) == files
