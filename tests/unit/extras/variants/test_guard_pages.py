"""No access outside of the arrays that the loop reads and writes by address."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = Path(__file__).with_name("guard_pages.py")
ALL = ["plastic", "plastic", "viscoplastic", "brittle", "thermal"]


def guarded_runs(*arguments):
    return subprocess.run([sys.executable, PROGRAM, *map(str, arguments)], capture_output=True, text=True)


@pytest.mark.parametrize(
    "arguments",
    [
        pytest.param((12, 1, 8, "plastic"), marks=pytest.mark.slow),
        pytest.param((500, 7, 32, *ALL), marks=[pytest.mark.slow, pytest.mark.nightly], id="nightly"),
    ],
)
def test_no_access_outside_of_an_array(arguments):
    done = guarded_runs(*arguments)
    assert done.returncode == 0, done.stderr
    assert "completed" in done.stdout
    assert "unbounded" in done.stdout


@pytest.mark.slow
def test_an_access_outside_ends_by_a_signal():
    assert guarded_runs("provoke").returncode == -signal.SIGSEGV
