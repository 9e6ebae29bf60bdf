import io

import pytest

from bladerub.config import read as configuration
from bladerub.study.job import RunDone
from bladerub.workflow.cores import costs_of, priority_of, threads_for
from bladerub.workflow.progress import JobProgress


@pytest.mark.parametrize(
    ("cost", "cores", "threads"), [(1, 16, 1), (1, 64, 5), (10, 4, 3), (100, 4, 4), (10, None, 1)]
)
def test_a_job_larger_than_the_share_of_a_core_has_more_threads(cost, cores, threads):
    assert threads_for(cost, 100, cores) == threads


def test_the_study_begins_with_the_coating_of_fig_6_and_the_stiffest():
    """The largest ensembles and the slowest runs: either would otherwise end long after all else."""
    costs = costs_of(configuration.read("config/config.yaml", command_line={}))
    first, second, *_ = sorted(costs.runs, key=lambda coating: -priority_of(coating, costs))
    assert (first, second.partition("_K")[0]) == ("2nd5nd_E11_K0.5_theta0", "2nd_E20")


class Terminal(io.StringIO):
    def isatty(self):
        return True


def done(number, total):
    return RunDone(number, total, "0.1000.h5", "completed", 0.1, 0.2)


def test_each_run_is_a_line_of_the_log_and_the_bar_is_on_a_terminal_only(tmp_path):
    terminal, file = Terminal(), io.StringIO()
    for stream in (terminal, file):
        log = io.StringIO()
        progress = JobProgress("2nd_E2_K0.5_theta0", log, stream, tmp_path / "turn")
        progress(done(1, 2))
        progress(done(2, 2))
        progress.summary([])
        assert log.getvalue().splitlines()[:2] == [str(done(1, 2)), str(done(2, 2))]
    assert "2nd_E2_K0.5_theta0" in terminal.getvalue()
    assert "/2 |" in terminal.getvalue()
    assert file.getvalue() == ""
