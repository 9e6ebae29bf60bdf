"""The profile for clusters: what it sends to SLURM, and a real SLURM that loses a job."""

import os
import re
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor, wait
from pathlib import Path

import h5py
import numpy as np
import pytest

PROFILE = ["--workflow-profile", "config/profiles/slurm"]
ONE_NODE = Path(__file__).parents[1] / "slurm" / "one_node.sh"
FINDINGS = "results/tables/findings.csv"
JOBS_LOG = Path("/run/bladerub-slurm/jobs.log")


def obstacle():
    """Why there is no SLURM to test on; having it installed is no leave to start daemons as root."""
    if os.environ.get("BLADERUB_TEST_SLURM") != "1":
        return "starts SLURM on this machine, as root: set BLADERUB_TEST_SLURM=1 to run it"
    if not all(map(shutil.which, ("slurmctld", "slurmd", "munged"))):
        return "SLURM is not installed: apt-get install slurm-wlm munge"
    return None if os.geteuid() == 0 else "SLURM's daemons need root"


@pytest.fixture
def cluster():
    subprocess.run([ONE_NODE, "start"], check=True)
    yield
    subprocess.run([ONE_NODE, "stop"], check=True)


def datasets(path):
    with h5py.File(path) as file:
        return {name: file[name][()] for name in file}


def running_job(kind):
    command = ["squeue", "--noheader", "--states=RUNNING", "--format=%i %k"]
    done = subprocess.run(command, capture_output=True, text=True)
    return next(line.split()[0] for line in done.stdout.splitlines() if f"rule_{kind}" in line)


@pytest.mark.parametrize(("revolutions", "minutes"), [(3, 2), (300, 3)])
def test_every_job_but_the_first_two_shares_its_place_in_the_queue(workspace, tiny, revolutions, minutes):
    tiny["solver"]["revolutions"] = revolutions
    tiny["analysis"]["divergence"]["confirmation_revolutions"] = 0
    text = workspace.dry_run(*PROFILE, config=tiny)
    assert sorted(re.findall(r"^rule (\w+):", text, re.MULTILINE)) == ["all", "blade", "compile_kernel"]
    assert sorted(re.findall(r"Group job (\w+)", text)) == ["drawing", "rubs"]
    asked = dict(re.findall(r"rule (\w+):.*?runtime=(\d+)", text, re.DOTALL))
    assert (asked["coating"], asked["margins"]) == (str(minutes), "1")


@pytest.mark.nightly
@pytest.mark.slurm
@pytest.mark.skipif(obstacle() is not None, reason=str(obstacle()))
def test_study_goes_on_after_scancel_and_is_what_a_local_one_is(cluster, workspace, tiny, tmp_path_factory):
    del tiny["solver"], tiny["analysis"]  # runs long enough to be hit
    longer = tiny | {"speeds": tiny["speeds"] | {"step": 0.02}}
    often = "--slurm-init-seconds-before-status-checks=3"
    on_cluster = [*PROFILE, "--slurm-status-command=squeue", often]
    earlier = JOBS_LOG.read_text()
    with ThreadPoolExecutor() as pool:
        killed = pool.submit(workspace.snakemake, FINDINGS, *on_cluster, "--retries", "0", config=longer)
        while len(workspace.runs()) < 15:  # the second coating
            assert not killed.done(), killed.result().stderr
            wait([killed], timeout=0.05)
        subprocess.run(["scancel", running_job("rubs")], check=True)
    assert killed.result().returncode == 1
    assert "Error in group rubs" in killed.result().stderr
    finished = workspace.runs()
    assert not (workspace.folder / FINDINGS).exists()

    completed = workspace.snakemake(FINDINGS, *on_cluster, config=longer)
    assert completed.returncode == 0, completed.stderr
    assert workspace.plan(longer, FINDINGS) == {}
    runs = workspace.runs()
    assert finished.items() < runs.items()
    # blade, kernel, rubs, rubs again, drawing
    states = re.findall(r"JobState=(\w+)", JOBS_LOG.read_text().removeprefix(earlier))
    assert sorted(states) == ["CANCELLED", *["COMPLETED"] * 4]

    local = type(workspace).at(tmp_path_factory.mktemp("local"))
    local.build(longer, FINDINGS)
    maps = (workspace.results / "maps").glob("*.h5")
    names = [f"runs/{name}" for name in runs] + [f"maps/{path.name}" for path in maps]
    for name in names:
        np.testing.assert_equal(datasets(workspace.results / name), datasets(local.results / name))
    for table in ("peaks", "divergence", "findings"):
        name = f"results/tables/{table}.csv"
        assert (workspace.folder / name).read_text() == (local.folder / name).read_text()
