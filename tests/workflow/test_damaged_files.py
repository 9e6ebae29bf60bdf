"""Truncated, lost and damaged files, made again or named; a disk that is full or that nobody may write."""

import os
import random
import re
import subprocess
from pathlib import Path

import h5py
import pytest

from bladerub.cli import inputs, main

COATING = "2nd_E1.1_K0.5_theta0"
OTHER = "2nd_E0.11_K0.5_theta0"


def rewrite(path: Path, content: bytes) -> None:
    """Leave the time as it was: Snakemake sees nothing."""
    times = path.stat()
    path.write_bytes(content)
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))


def cut_short(path: Path) -> None:
    rewrite(path, path.read_bytes()[: path.stat().st_size // 2])


def spoil(path: Path) -> None:
    """Change bytes of the worn depth, and not the size."""
    with h5py.File(path) as file:
        start = file["wear"].id.get_chunk_info(0).byte_offset
    content = bytearray(path.read_bytes())
    content[start : start + 20] = bytes(255 - byte for byte in content[start : start + 20])
    rewrite(path, content)


@pytest.fixture
def results(copied_study):
    return copied_study.folder / "results"


def contents(results: Path) -> dict[str, bytes]:
    folders = ("blade", "runs", "maps", "figures")
    paths = [path for folder in folders for path in (results / folder).rglob("*.*") if path.is_file()]
    return {path.relative_to(results).as_posix(): path.read_bytes() for path in paths}


def test_damage_is_found_or_named_and_costs_only_itself(copied_study, tiny, results):
    before, written = contents(results), copied_study.runs()
    cut_short(results / "runs" / COATING / "0.2300.h5")
    (results / "runs" / COATING / "0.1970.h5").unlink()
    cut_short(results / "runs" / "2nd_E2_K0.5_theta0.15" / "manifest.tsv")
    spoil(results / "maps" / "2nd_E2_K0.5_theta0.h5")
    assert copied_study.plan(tiny)["coating"] == 3  # found without being asked
    (results / "maps" / f"{OTHER}.h5").unlink()
    spoil(results / "runs" / OTHER / "0.1970.h5")  # a job that reads it computes it again
    made, damaged = "figures/fig02_campbell.png", "tables/campbell.csv"
    (results / made).unlink()
    cut_short(results / damaged)
    coatings = (COATING, "2nd_E2_K0.5_theta0.15", "2nd_E2_K0.5_theta0", OTHER)
    targets = [made, *(f"maps/{coating}.h5" for coating in coatings)]
    command = (*(f"results/{target}" for target in targets), "--keep-going", "--cores", "2")
    said = copied_study.failure(*command, config=tiny)
    named = re.findall(r"^results/(\S+): .*; delete it and run the same command", said, re.MULTILINE)
    assert named == [damaged]
    (results / damaged).unlink()
    done = copied_study.snakemake(*command, config=tiny)
    assert done.returncode == 0, done.stderr
    assert contents(results) == before
    again = {name for name, time in copied_study.runs().items() if time != written[name]}
    assert again == {f"{COATING}/0.1970.h5", f"{COATING}/0.2300.h5", f"{OTHER}/0.1970.h5"}


def flip_a_bit(path: Path, draw: random.Random) -> None:
    content = bytearray(path.read_bytes())
    bit = draw.randrange(8 * len(content))
    content[bit // 8] ^= 1 << bit % 8
    rewrite(path, content)


def test_a_damaged_blade_is_made_again_and_costs_no_run(copied_study, tiny, results):
    before, written = contents(results), copied_study.runs()
    flip_a_bit(results / "blade" / "reduced_model.h5", random.Random(1))
    assert "blade" in copied_study.plan(tiny, f"results/runs/{COATING}/manifest.tsv")
    copied_study.build(tiny, f"results/runs/{COATING}/manifest.tsv", "results/blade/mesh.h5")
    assert (contents(results), copied_study.runs()) == (before, written)


@pytest.mark.nightly
def test_what_is_lost_or_damaged_of_an_ensemble_costs_its_members_alone(copied_study, tiny, results):
    tiny["ensemble"] = {"members": 2}
    target = f"results/ensembles/{COATING}.h5"
    copied_study.build(tiny, target)
    assert copied_study.plan(tiny, target) == {}
    members = sorted((results / "runs" / COATING / "ensemble").glob("[0-9]*.h5"))
    before = {path: path.read_bytes() for path in [*members, copied_study.folder / target]}
    times = {path: path.stat().st_mtime_ns for path in members}
    lost, empty, flipped = members[:3]
    flip_a_bit(flipped, random.Random(1))
    assert copied_study.plan(tiny, target) == {}  # nothing shows it from outside
    assert copied_study.status("--thorough")["damaged"] == [str(flipped)]
    lost.unlink()
    os.truncate(empty, 0)
    flip_a_bit(copied_study.folder / target, random.Random(2))
    found = copied_study.status("--thorough")
    assert set(found["damaged"]) == {str(empty), str(flipped), str(copied_study.folder / target)}
    assert found["lost"] == [str(lost)]
    copied_study.build(tiny, target)
    assert {path: path.read_bytes() for path in before} == before
    assert {path for path in members if path.stat().st_mtime_ns != times[path]} == {lost, empty, flipped}


@pytest.mark.nightly
def test_one_random_bit_in_a_file_of_any_kind_is_found_and_repaired(copied_study, tiny, results):
    before, draw = contents(results), random.Random(8)
    tables = {path: path.read_bytes() for path in (results / "tables").iterdir()}
    of_tables = ("tables/*.csv", "tables/*.json")
    kinds = ["runs/*/[0-9]*.h5", "runs/*/manifest.tsv", "maps/*.h5", *of_tables, "blade/*.h5", *of_tables]
    hit = {draw.choice(sorted(results.glob(kind))) for kind in kinds}
    for path in hit:
        flip_a_bit(path, draw)
    found = set(copied_study.status("--thorough", "--discard")["damaged"])
    assert found == {str(path).removesuffix("-metadata.json") for path in hit}
    copied_study.build(tiny)
    assert copied_study.status("--thorough")["damaged"] == []
    assert contents(results) == before
    same = {path for path, content in tables.items() if path.read_bytes() == content}
    assert {path.name.split(".")[0] for path in tables.keys() - same} <= {"cost"}  # timings


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
