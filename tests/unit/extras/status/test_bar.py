import io
import sys

from bladerub.study.job import RunDone
from bladerub.workflow.job import JobProgress


class Terminal(io.StringIO):
    def isatty(self):
        return True


def done(number, total):
    return RunDone(number, total, "0.1000.h5", "completed", 0.1, 0.2)


def test_each_run_is_a_line_of_the_log_and_the_bar_is_on_a_terminal_only(tmp_path, monkeypatch, capsys):
    terminal, file = Terminal(), io.StringIO()
    for stream in (terminal, file):
        monkeypatch.setattr(sys, "__stderr__", stream)
        progress = JobProgress("2nd_E2_K0.5_theta0", tmp_path / "runs")
        progress(done(1, 2))
        progress(done(2, 2))
        progress.finish([])
        assert capsys.readouterr().err.splitlines()[:2] == [str(done(1, 2)), str(done(2, 2))]
    assert "2nd_E2_K0.5_theta0" in terminal.getvalue()
    assert "/2 |" in terminal.getvalue()
    assert file.getvalue() == ""
