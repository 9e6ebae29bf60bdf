import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = Path(__file__).with_name("guard_pages.py")
ALL = ["plastic", "plastic", "viscoplastic", "brittle", "thermal"]


def guarded_runs(*arguments):
    return subprocess.run([sys.executable, PROGRAM, *map(str, arguments)], capture_output=True, text=True)


@pytest.mark.slow
@pytest.mark.parametrize(
    "arguments", [(12, 1, 8, "plastic"), pytest.param((500, 7, 32, *ALL), marks=pytest.mark.nightly)]
)
def test_no_access_outside_of_an_array(arguments):
    done = guarded_runs(*arguments)
    assert done.returncode == 0, done.stderr
    assert "completed" in done.stdout
    assert "unbounded" in done.stdout


@pytest.mark.slow
def test_an_access_outside_ends_by_a_signal():
    assert guarded_runs("provoke").returncode == -signal.SIGSEGV


ONE = """
import sys
from bladerub.contact.laws import module_for
from bladerub.contact.setup import compile_kernel
from bladerub.extras.law_reading import law_of
from bladerub.numerics.lanes import lanes_for
values = {"viscosity": 1e4} if sys.argv[2] == "viscoplastic" else {}
n_nodes, law = int(sys.argv[1]), law_of({"name": sys.argv[2], **values})
compile_kernel(n_nodes=n_nodes, law=law)
loop = module_for(lanes_for(n_nodes), "contact.kernel.loop", law)
print(sum(loop.integrate.stats.cache_misses.values()))
"""


def misses(program, *arguments, **environment):
    command = [sys.executable, "-c", program, *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | environment, check=True)
    return int(done.stdout)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("n_nodes", "law"), [pytest.param(12, "plastic", marks=pytest.mark.nightly), (8, "viscoplastic")]
)
def test_machine_code_of_another_process_is_used(n_nodes, law):
    misses(ONE, n_nodes, law)
    assert misses(ONE, n_nodes, law) == 0


ROWS = """
import dataclasses, sys
sys.path.insert(0, "tests/unit")
import stand_in
from bladerub.extras.rows import kernel
from bladerub.extras.law_reading import described_law
from bladerub.extras.rows.row import simulate_row
from bladerub.extras.rows.spec import Row
from bladerub.contact.spec import PLASTIC
blade, spec = (getattr(stand_in, name).__wrapped__() for name in ("blade", "spec"))
laws = [described_law("viscoplastic", {"viscosity": 1e4}), PLASTIC]
for law in laws[int(sys.argv[1]):]:
    coating = dataclasses.replace(spec.coating, element_law=law)
    simulate_row(blade, dataclasses.replace(spec, coating=coating, revolutions=1), Row.even(2))
print(sum(kernel._integrate_row.stats.cache_misses.values()))
"""


@pytest.mark.slow
@pytest.mark.nightly
def test_rows_by_two_laws_leave_machine_code_that_later_processes_use(tmp_path):
    folder = {"NUMBA_CACHE_DIR": str(tmp_path)}
    misses(ROWS, 0, **folder)
    assert misses(ROWS, 1, **folder) == 0
    for index in tmp_path.rglob("kernel._integrate_row*.nbi"):
        index.write_bytes(index.read_bytes()[:-100])
    assert misses(ROWS, 1, **folder) == 1
    assert misses(ROWS, 1, **folder) == 0
