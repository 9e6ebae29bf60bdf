"""Kill the workflow at random moments, and see that nothing is lost.

    python tests/workflow/kills.py --kills 20 --seed 1 --config config/quick.yaml

An undisturbed study is made first. Then another is killed, in turns by SIGTERM to snakemake, by SIGKILL to
all of its processes, by SIGKILL to one job, and by Ctrl-C once and twice, at a random moment of what is left
to do; the same command is given again and killed again. A study that has come to its end is compared with
the undisturbed one, byte by byte, and begun again. No run that was whole before a kill may be written again.
"""

import argparse
import filecmp
import itertools
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from workspace import Workspace

WAYS = (
    *("SIGTERM to snakemake", "SIGKILL to all processes", "SIGKILL to one job"),
    *("Ctrl-C", "Ctrl-C twice"),
)
UNEQUAL = re.compile(r"logs/|benchmarks/|.*\.lock")
"""Files that tell of the machine, not of the study."""
LAST = 600
"""Longest that a study may take, s."""


@dataclass(frozen=True)
class Kill:
    """One kill and what came of it.

    Parameters
    ----------
    study : int
        Which study it is, counted from 1: those before it have come to their end and were as they should be.
    way : str
        One of `WAYS`.
    after : float
        Moment, s from the start of the invocation.
    jobs : str
        Rules at work at that moment.
    whole : int
        Runs that were whole at that moment.
    left : int
        Temporary files that the kill has left.
    """

    study: int
    way: str
    after: float
    jobs: str
    whole: int
    left: int

    def __str__(self) -> str:
        found = f"{self.whole:>4} runs whole, {self.left} files half written"
        return f"study {self.study}: {self.way:<26}{self.after:>6.1f} s {found}, at work: {self.jobs}"


@dataclass(frozen=True)
class Study:
    """A folder with the workflow in it, and the command that is given there.

    Parameters
    ----------
    workspace : Workspace
        Where the workflow is.
    arguments : sequence of str
        Of snakemake.
    """

    workspace: Workspace
    arguments: Sequence[str]

    def start(self) -> subprocess.Popen:
        """Give the command, in a session of its own."""
        with self._output.open("w") as output:
            return subprocess.Popen(
                [Path(sys.executable).with_name("snakemake"), *self.arguments],
                cwd=self.workspace.folder,
                env=self.workspace.environment,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def output(self) -> str:
        """What the last command has said."""
        return self._output.read_text()

    @property
    def _output(self) -> Path:
        return self.workspace.folder / "output.txt"

    def forget(self) -> None:
        """Go back to where nothing has been made but the machine code, which takes longest to make."""
        for name in ("results", ".snakemake"):
            shutil.rmtree(self.workspace.folder / name, ignore_errors=True)


def torment(study: Study, compare: Callable[[], None], seconds: float, seed: int) -> Iterator[Kill]:
    """Kill `study` again and again.

    Parameters
    ----------
    study : Study
        The one to kill.
    compare : callable
        Called when it has come to its end nevertheless, to see that it is as it should be.
    seconds : float
        How long the study takes undisturbed.
    seed : int
        Decides the moments.

    Yields
    ------
    Kill
        As it happens.

    Raises
    ------
    AssertionError
        If a kill has cost more than the work it interrupted.
    """
    draw, ways = random.Random(seed), itertools.cycle(WAYS)
    way, spent, known, completed = next(ways), 0.0, {}, 0
    while True:
        after = draw.uniform(0.0, max(seconds - spent, seconds / 4))
        process, began = study.start(), time.monotonic()
        try:
            try:
                process.wait(after)
            except subprocess.TimeoutExpired:
                pass
            else:  # there was less left to do than expected
                _check_end(study, process.returncode, known)
                compare()
                study.forget()
                seconds, spent, known = spent + time.monotonic() - began, 0.0, {}
                completed += 1
                continue
            jobs = jobs_of(process)
            while way == WAYS[2] and not jobs and process.poll() is None:
                jobs = jobs_of(process)
            before = study.workspace.runs()
            _kill(way, process, draw)
            process.wait(LAST)
            if way in WAYS[3:]:
                assert jobs_of(process) == {}, "at work after Ctrl-C"
        finally:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
        output = study.output()
        assert "LockException" not in output, output
        assert "IncompleteFilesException" not in output, output
        known = _unchanged(known, study.workspace.runs()) | before
        half = sum(1 for _ in study.workspace.results.rglob(".*.tmp"))
        at_work = ", ".join(sorted(jobs.values())) or "snakemake alone"
        yield Kill(completed + 1, way, after, at_work, len(before), half)
        way, spent = next(ways), spent + time.monotonic() - began


def finish(study: Study) -> None:
    """Let the study come to its end; no run that is whole may be written again."""
    known = study.workspace.runs()
    _check_end(study, study.start().wait(LAST), known)


def unlike(here: Workspace, there: Workspace) -> list[str]:
    """Files of the results here that are not the same there."""
    paths = (path.relative_to(here.results).as_posix() for path in here.results.rglob("*") if path.is_file())
    names = [name for name in paths if not UNEQUAL.match(name)]
    _, unequal, missing = filecmp.cmpfiles(here.results, there.results, names, shallow=False)
    return sorted(unequal + missing)


def _check_end(study: Study, code: int, known: dict[str, tuple[int, int]]) -> None:
    assert code == 0, study.output()
    _unchanged(known, study.workspace.runs())


def _unchanged(known: dict[str, tuple[int, int]], now: dict[str, tuple[int, int]]) -> dict:
    again = [name for name, written in known.items() if now.get(name) != written]
    assert again == [], "whole before, written again after a kill"
    return now


def jobs_of(process: subprocess.Popen) -> dict[int, str]:
    """Rule of each job at work, by the process that executes its script.

    A child of it, which is about to become another program, is not one: the job would survive it.
    """
    jobs, parents = {}, {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if os.getpgid(int(folder.name)) == process.pid:
                command = (folder / "cmdline").read_text().split("\0")
                script = re.search(r"\.snakemake/scripts/tmp\w+\.(\w+)\.py$", "".join(command[1:2]))
                jobs |= {int(folder.name): script[1]} if script else {}
                parents[int(folder.name)] = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
        except (FileNotFoundError, ProcessLookupError):
            continue
    return {job: rule for job, rule in jobs.items() if parents.get(job) not in jobs}


def _kill(way: str, process: subprocess.Popen, draw: random.Random) -> None:
    if way == WAYS[0]:
        process.send_signal(signal.SIGTERM)
    elif way == WAYS[1]:
        os.killpg(process.pid, signal.SIGKILL)
    elif way in WAYS[3:]:
        os.killpg(process.pid, signal.SIGINT)
        if way == WAYS[4]:
            time.sleep(0.3)
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGINT)
    elif jobs := jobs_of(process):
        os.kill(draw.choice(sorted(jobs)), signal.SIGKILL)


def main() -> None:
    """Make a study, kill another, and print a line a kill."""
    parser = argparse.ArgumentParser(description="Kill the workflow at random moments.")
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--config", default="config/quick.yaml")
    options = parser.parse_args()
    command = ("-j2", "--configfile", str(Path(options.config).resolve()))
    with tempfile.TemporaryDirectory() as scratch:
        undisturbed, killed = (Workspace.at(Path(scratch) / name) for name in ("undisturbed", "killed"))

        def compare() -> None:
            assert unlike(killed, undisturbed) + unlike(undisturbed, killed) == []

        began = time.monotonic()
        finish(Study(undisturbed, command))
        seconds = time.monotonic() - began
        print(f"undisturbed: {seconds:.0f} s, {len(undisturbed.runs())} runs", flush=True)
        study = Study(killed, command)
        for number, kill in enumerate(torment(study, compare, seconds, options.seed), 1):
            print(f"{number:>3}  {kill}", flush=True)
            if number == options.kills:
                break
        finish(study)
        compare()
        print("every run was computed once, and the study is the same as the undisturbed one, byte by byte")


if __name__ == "__main__":
    main()
