import subprocess
import sys

import pytest
from stand_in import blade, change, spec  # noqa: F401 (fixtures)


@pytest.fixture(autouse=True, scope="session")
def own_cache(tmp_path_factory):
    """Keep blades that tests import out of the cache of this user."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("BLADERUB_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture
def python_at_work():
    """Start a Python program in a process of its own, wait for its first line, kill it after the test."""
    processes = []

    def start(program, *arguments):
        command = [sys.executable, "-c", program, *map(str, arguments)]
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        processes.append(process)
        assert process.stdout.readline()
        return process

    yield start
    for process in processes:
        with process:
            process.kill()
