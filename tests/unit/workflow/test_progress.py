import io

from bladerub.study.job import RunDone
from bladerub.study.manifest import ManifestRow
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


def test_the_last_line_counts_what_was_computed_and_what_is_there(tmp_path):
    progress = JobProgress("2nd_E2_K0.5_theta0", io.StringIO(), io.StringIO(), tmp_path / "turn")
    progress(done(1, 1))
    rows = [
        ManifestRow("0.1000.h5", 0.1, "a", "completed", 9),
        ManifestRow("0.2000.h5", 0.2, "b", "completed", 9, "c", 9),
        ManifestRow("0.3000.h5", 0.3, "d", "unbounded", 9),
    ]
    line = progress.summary(rows)
    counts, cost = line.split("; ")
    assert counts == "2nd_E2_K0.5_theta0: 3 runs, 1 of them longer as well, 1 unbounded"
    assert cost.startswith("1 computed in ")
