"""Kill the workflow at random moments, and see that a kill costs nothing but the work it interrupts."""

import filecmp
import os
import random
import re
import shutil
import signal
import subprocess
import time
from contextlib import suppress
from pathlib import Path

import pytest
import yaml
from test_variations import GROUP

pytestmark = pytest.mark.nightly

WAYS = ("kill all", "terminate", "kill one job", "Ctrl-C", "Ctrl-C twice")
UNEQUAL = re.compile(r"logs/|benchmarks/|.*\.lock")
"""Files that tell of the machine, not of the study."""
LAST = 600
"""Longest that a study may take, s."""
ROWS = {"f_omega": [0.19, 0.28], "blades": [4], "coupling": [0, 0.01], "draws": 30}
ROTOR = {"seed": 1, "groups": {"some": GROUP | ROWS}}


def jobs_of(process):
    """Number of each process that executes a script of a rule, not of a child about to be another program."""
    jobs, parents = set(), {}
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(FileNotFoundError, ProcessLookupError):
            if os.getpgid(int(folder.name)) == process.pid:
                command = (folder / "cmdline").read_text().split("\0")
                if re.search(r"\.snakemake/scripts/tmp\w+\.(\w+)\.py$", "".join(command[1:2])):
                    jobs.add(int(folder.name))
                parents[int(folder.name)] = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
    return {job for job in jobs if parents.get(job) not in jobs}


def kill(way, process, draw):
    if way == "terminate":
        process.send_signal(signal.SIGTERM)
    elif way == "kill all":
        os.killpg(process.pid, signal.SIGKILL)
    elif way == "kill one job":
        while process.poll() is None:
            if jobs := jobs_of(process):
                os.kill(draw.choice(sorted(jobs)), signal.SIGKILL)
                break
    else:
        os.killpg(process.pid, signal.SIGINT)
        if way == "Ctrl-C twice":
            time.sleep(0.3)
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGINT)


def unlike(here, there):
    paths = (path.relative_to(here.results).as_posix() for path in here.results.rglob("*") if path.is_file())
    names = [name for name in paths if not UNEQUAL.match(name)]
    _, unequal, missing = filecmp.cmpfiles(here.results, there.results, names, shallow=False)
    return sorted(unequal + missing)


def torment(workspace, target, ways, seconds, seed):
    """Kill a study, of so many `seconds`, in each of the `ways`, begun again if it ended; let it end."""
    draw, left, spent, known = random.Random(seed), list(ways), 0.0, {}
    while left:
        process, began = workspace.begin("-j2", target, start_new_session=True), time.monotonic()
        try:
            process.wait(draw.uniform(0.0, max(seconds - spent, seconds / 4)))
        except subprocess.TimeoutExpired:
            before = workspace.runs()
            kill(left[0], process, draw)
            process.wait(LAST)
            assert left.pop(0)[:4] != "Ctrl" or jobs_of(process) == set(), "at work after Ctrl-C"
            known |= before
            spent += time.monotonic() - began
        else:
            assert process.returncode == 0
            seconds, spent, known = spent + time.monotonic() - began, 0.0, {}
            for name in ("results", ".snakemake"):
                shutil.rmtree(workspace.folder / name)
            continue
        finally:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
        output = (workspace.folder / "output.txt").read_text()
        assert "LockException" not in output, output
        assert "IncompleteFilesException" not in output, output
        assert not re.search(r'File ".*/\.snakemake/scripts/', output), output  # the traceback of a job
        now = workspace.runs()
        again = [name for name, written in known.items() if now.get(name) != written]
        assert again == [], "whole before, written again after a kill"
        known = now
    assert workspace.begin("-j2", target).wait(LAST) == 0, (workspace.folder / "output.txt").read_text()
    now = workspace.runs()
    assert {name: now[name] for name in known} == known


def test_kills_cost_nothing_but_what_they_interrupt(study, tiny, tmp_path):
    killed = study.copy(tmp_path / "killed", "results", ".snakemake")
    (killed.folder / "overlay.yaml").write_text(yaml.safe_dump(tiny))
    torment(killed, "results/tables/peaks.csv", WAYS, seconds=15.0, seed=3)
    assert unlike(killed, study) == []


def test_kills_of_jobs_with_rows_of_blades_cost_nothing_but_what_they_interrupt(study, tiny, tmp_path):
    pair = []
    for name in ("undisturbed", "killed"):
        workspace = study.copy(tmp_path / name)
        (workspace.folder / "config" / "rotor.yaml").write_text(yaml.safe_dump(ROTOR, sort_keys=False))
        (workspace.folder / "overlay.yaml").write_text(yaml.safe_dump(tiny))
        pair.append(workspace)
    undisturbed, killed = pair
    assert undisturbed.begin("-j2", "rotor").wait(LAST) == 0
    torment(killed, "rotor", WAYS, seconds=10.0, seed=5)
    assert unlike(killed, undisturbed) == []
