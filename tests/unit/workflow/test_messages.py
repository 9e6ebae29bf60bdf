import logging
from types import SimpleNamespace

import pytest
from snakemake.logging import DefaultFormatter
from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_bladerub import LONGEST, LogHandler

JOB = {"event": LogEvent.JOB_ERROR, "rule_name": "coating", "output": ["a.tsv"], "log": ["logs/a.log"]}
PLAN = logging.INFO, "table", {"event": LogEvent.RUN_INFO, "stats": {"coating": 2, "fig11_Y4": 1, "total": 3}}


@pytest.fixture
def lines(capsys):
    def printed(*records, verbose=False, dryrun=False):
        handler = LogHandler(SimpleNamespace(verbose=verbose, dryrun=dryrun, stdout=False), None)
        handler.setFormatter(DefaultFormatter())
        for level, message, values in records:
            handler.emit(logging.makeLogRecord({"levelno": level, "msg": message, **values}))
        return capsys.readouterr().err.splitlines()

    return printed


def job(number, rule=None):
    begun = {"event": LogEvent.JOB_INFO, "jobid": number, "rule_name": rule}
    return logging.INFO, "", begun if rule else {"event": LogEvent.JOB_FINISHED, "job_id": number}


def test_a_line_for_the_plan_and_for_each_stage_that_is_done(lines):
    jobs = [job(1, "coating"), job(2, "coating"), job(2), (logging.INFO, "Select jobs to execute...", {})]
    jobs += [job(3, "fig11_Y4"), job(3), job(1)]
    plan, *stages = lines(PLAN, *jobs)
    assert plan == "3 jobs: coating 2, figures"
    assert ["2 of 3" in stages[0], "3 of 3" in stages[1]] == [True, True]


def test_errors_and_warnings_are_shown_and_no_line_is_long(lines):
    inputs = "Error in rule coating:\n    input: " + ", ".join(["results/blade.h5"] * 100)
    shell = logging.INFO, "shell: bash", {}
    shown = lines((logging.ERROR, inputs, {}), (logging.WARNING, "old", {}), shell)
    assert [len(line) for line in shown] == [22, LONGEST, 3]
    assert lines(shell, verbose=True) == ["shell: bash"]


def test_a_failed_job_is_named_with_its_log_and_said_once(lines):
    shown = lines(
        PLAN,
        (logging.ERROR, "Error in rule coating", JOB),
        (logging.ERROR, "Command 'python a.py' returned non-zero exit status 1.", {"event": LogEvent.ERROR}),
        (logging.ERROR, "Exiting because a job execution failed. Look above", {}),
    )
    assert len(shown) == 2
    assert "a.tsv" in shown[1]
    assert "logs/a.log" in shown[1]


def test_jobs_that_ctrl_c_ends_have_not_failed(lines):
    ended = "Command 'python a.py' died with <Signals.{}>."
    by_user = logging.ERROR, ended.format("SIGINT: 2"), {"event": LogEvent.ERROR}
    by_system = logging.ERROR, ended.format("SIGKILL: 9"), {"event": LogEvent.ERROR}
    assert lines(by_user, (logging.ERROR, "Error in rule coating", JOB)) == []
    assert len(lines(by_system, (logging.ERROR, "Error in rule coating", JOB))) == 2


@pytest.mark.parametrize(
    ("content", "location", "dryrun", "value"),
    [
        (b"a: 1\n\tb: 2\n", "mine.yaml:2: ", True, "coatings=[]"),
        (None, "mine.yaml: ", False, "coatings=[]"),
        (b"a: 1\n", "WorkflowError", False, "coatings=[]"),  # an error that is not of the config
        (b"a: 1\n", "--config figures.dpi=2: ", True, "figures.dpi=2"),
    ],
)
def test_what_is_no_config_is_named_where_snakemake_names_no_file(
    lines, tmp_path, monkeypatch, content, location, dryrun, value
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.argv", ["snakemake", "--configfile", "mine.yaml", "-n", "--config", value])
    if content is not None:
        (tmp_path / "mine.yaml").write_bytes(content)
    refused = logging.ERROR, "WorkflowError:\nConfig file is not valid", {"event": LogEvent.ERROR}
    assert lines(refused, dryrun=dryrun)[0].startswith(location)
