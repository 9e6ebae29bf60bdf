import ast
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = """
import sys
from bladerub.workflow import job
from bladerub.io.errors import DamagedFile
job.log_to(sys.argv[1])
print("at work", file=sys.stderr)
{}
"""


@pytest.fixture
def fail(tmp_path):
    def run(statement, log=tmp_path / "job.log"):
        arguments = [sys.executable, "-c", SCRIPT.format(statement), str(log)]
        done = subprocess.run(arguments, capture_output=True, text=True)
        assert done.returncode == 1
        return done.stderr, log.read_text() if log.is_file() else ""

    return run


def test_an_error_of_a_file_is_one_line_in_the_log_and_for_the_caller(fail):
    output, log = fail('raise DamagedFile("a.h5: not a map")')
    assert output.startswith("a.h5: not a map; delete it and run the same command again")
    assert output.count("\n") == 1
    assert log == "at work\n" + output


def test_any_other_error_leaves_its_traceback_in_the_log(fail):
    output, log = fail("1 / 0")
    assert output.startswith("bladerub: division by zero")  # a reason on the screen, whatever it is
    assert output.count("\n") == 1
    assert log.startswith("at work\nTraceback")
    assert log.endswith("ZeroDivisionError: division by zero\n")


SCRIPTS = sorted([*Path("src/scripts").glob("*.py"), *Path("studies").glob("*/scripts/*.py")])


def test_the_log_of_a_job_is_open_before_its_imports():
    """So that it has their errors, and the traceback of an interrupt, which takes them where it can."""
    logged = ["from bladerub.workflow import job", "job.log_to(snakemake.log[0])"]
    for script in SCRIPTS:
        _, *first = ast.parse(script.read_text(encoding="utf-8")).body[:3]
        assert [ast.unparse(statement) for statement in first] == logged, script
