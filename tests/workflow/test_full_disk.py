"""A results folder on a disk of its own that is full, or that nobody may write."""

import subprocess

import pytest

from bladerub.cli import inputs, main

COATING = "2nd_E2_K0.5_theta0"
TARGET = f"results/maps/{COATING}.h5"


@pytest.fixture
def mount(workspace):
    results = workspace.folder / "results"
    results.mkdir()

    def set_options(options):
        command = ["mount", "-t", "tmpfs", "-o", options, "results", str(results)]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            pytest.skip(f"no disk can be mounted here: {done.stderr.strip()}")

    yield set_options
    subprocess.run(["umount", "--lazy", str(results)], capture_output=True)


def size(study, *names):
    return sum(path.stat().st_size for name in names for path in (study.folder / "results").glob(name))


@pytest.mark.nightly
def test_a_full_disk_loses_nothing(workspace, study, tiny, mount):
    before = size(study, "blade/*", "tables/[cr]*.csv")
    runs = size(study, f"runs/{COATING}/*.h5")
    mount(f"size={(before + runs // 2) // 1024}k")
    workspace.sources = study.sources  # which have their machine code
    failed = workspace.snakemake(TARGET, "--cores", "1", config=tiny)
    assert failed.returncode != 0
    output = failed.stdout + failed.stderr
    assert f"results/runs/{COATING}/" in output
    assert ".h5: the disk is full; make room and run the same command again" in output
    times = workspace.runs()
    assert 0 < len(times) < 8
    assert not list((workspace.folder / "results").rglob(".*.tmp"))
    mount(f"remount,size={(before + 3 * runs) // 1024 + 1024}k")
    workspace.build(tiny, TARGET)
    assert times.items() <= workspace.runs().items()
    assert (workspace.folder / TARGET).read_bytes() == (study.folder / TARGET).read_bytes()


def test_a_folder_that_cannot_be_written_is_named_before_any_work(
    workspace, tiny, mount, monkeypatch, capsys
):
    mount("ro,size=1m")
    results = workspace.folder / "results"
    said = workspace.failure(TARGET, "--cores", "1", config=tiny)
    assert "results: Read-only file system; make it writable, or choose another folder" in said
    assert "localrule" not in said
    monkeypatch.setattr(inputs, "study_folder", lambda: workspace.folder)
    overlay = ["--config", str(workspace.folder / "overlay.yaml")]
    assert main(["run", "--casing", "2nd", "--E", "2", "--K", "0.5", "--f", "0.2", *overlay]) == 2
    assert capsys.readouterr().err.startswith(f"bladerub run: {results}: Read-only file system; make it")
    assert main(["status", *overlay]) == 0  # it writes nothing
