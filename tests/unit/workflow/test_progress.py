import io

from bladerub.study.job import RunDone
from bladerub.workflow.progress import JobProgress


class Terminal(io.StringIO):
    def isatty(self):
        return True


def done(number, total, file="0.1000.h5"):
    return RunDone(number, total, file, "completed", 0.1, 0.2)


def test_each_run_is_a_line_of_the_log_with_the_time_left(tmp_path):
    log = io.StringIO()
    progress = JobProgress("2nd_E2_K0.5_theta0", log, io.StringIO(), tmp_path / "turn")
    progress(done(1, 2))
    progress(done(2, 2))
    assert log.getvalue().splitlines() == [str(done(1, 2)), str(done(2, 2))]
    assert "s left" in log.getvalue()


def test_the_bar_is_on_a_terminal_only(tmp_path):
    terminal, file = Terminal(), io.StringIO()
    for stream in (terminal, file):
        progress = JobProgress("2nd_E2_K0.5_theta0", io.StringIO(), stream, tmp_path / "turn")
        progress(done(1, 1))
        progress.summary([])
    assert "2nd_E2_K0.5_theta0" in terminal.getvalue()
    assert "/1 |" in terminal.getvalue()
    assert file.getvalue() == ""
