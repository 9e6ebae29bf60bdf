import subprocess
import sys

import pytest
from stand_in import blade, change, spec  # noqa: F401 (fixtures)


@pytest.fixture
def python_at_work():
    """Start a Python program in a process of its own, and go on when it has said its first line."""
    processes = []

    def start(program, *arguments):
        command = [sys.executable, "-c", program, *map(str, arguments)]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        processes.append(process)
        assert process.stdout.readline()
        return process

    yield start
    for process in processes:
        process.kill()
        process.wait()
        process.stdout.close()
