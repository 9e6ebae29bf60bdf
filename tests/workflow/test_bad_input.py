"""Bad configs, files and command lines: one line that names the culprit, exit code 2, nothing written.

One of a kind; tests/unit/config tries the rules of the config, tests/unit/blade those of blades.
"""

import os
import re
from itertools import pairwise

import h5py
import numpy as np
import pytest
import yaml

from bladerub.blade.model import ReducedBlade, write_reduced_blade
from bladerub.cli import inputs, main

RUN = "run --casing 2nd --E 2 --K 0.5 --f 0.19"
COMMANDS = {
    "run --casing 2dn --E 2 --K 1 --f 0.19": '"2dn": must be one of 2nd, 2nd5nd; did you mean 2nd?',
    f"{RUN} --E soft": "argument --E: must be a number, or one with a unit: 'soft'",
    f"{RUN} --f 0.41": "--f = 0.41: must be at most reduction.f_omega_max = 0.4",
    f"{RUN} --revolutions {10**30}": f"--revolutions = {10**30}: ",
    f"{RUN} --config pipe": "pipe: is not a regular file, must be a YAML file",
    f"{RUN} --output text/run.h5": "--output text/run.h5: cannot be written, ",
    f"{RUN} --blade /dev/zero": "/dev/zero: is not a regular file, must be a reduced blade (HDF5)",
    f"{RUN} --blade text": "text: not a readable HDF5 file",
    f"{RUN} --blade other.h5": "other.h5: not a reduced blade, 'mass' is missing",
    f"{RUN} --blade endless.h5": "endless.h5: not a reduced blade, mass has the shape (200000, 200000)",
    "verify --sample 1": "the following arguments are required: --seed",
    "benchmark --nodes 16 33": "--nodes 33: must be from 4 to 32",
    "benchmark --config rigid.yaml": "coatings: must have an abradable one",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Here are the files that `COMMANDS` name."""
    folder = tmp_path_factory.mktemp("files")
    (folder / "folder").mkdir()
    (folder / "text").write_text("mass = 1\n")
    (folder / "rigid.yaml").write_text(
        "coatings: [{casing: 2nd, coating: rigid, friction: [0]}]\nanalysis: {histories: []}\n"
    )
    os.mkfifo(folder / "pipe")
    sound = folder / "sound.h5"
    matrices, nodes = 4 * [np.eye(24)], 3 * [np.eye(8, 3)]
    write_reduced_blade(sound, ReducedBlade(*matrices, *nodes, 1.0, 0.4, 6, 1e-5, 0.2), {})
    for name in ("other", "endless"):
        (folder / f"{name}.h5").write_bytes(sound.read_bytes())
        with h5py.File(folder / f"{name}.h5", "r+") as file:
            del file["mass"]
            if name == "endless":
                file.create_dataset("mass", shape=(200_000, 200_000), dtype=float, chunks=(100, 100))
    return folder


@pytest.mark.parametrize("line", COMMANDS)
def test_bad_command_line(folder, monkeypatch, capsys, line):
    monkeypatch.setattr(inputs, "study_folder", lambda: folder)
    monkeypatch.chdir(folder)
    before = sorted(folder.rglob("*"))
    try:
        code = main(line.split())
    except SystemExit as end:  # argparse ends the program itself
        code = end.code
    output = capsys.readouterr()
    assert (code, output.out, output.err.count("\n")) == (2, "", 1)
    assert COMMANDS[line] in output.err
    assert sorted(folder.rglob("*")) == before


def lines_of_ours(stderr):
    """All but what Snakemake says of its profile and of configs that lie over one another."""
    its_own = ("Config file config/config.yaml is extended", "Using workflow specific profile")
    return [line for line in stderr.splitlines() if not line.startswith(its_own)]


BOMB = "".join(f"{new}: &{new} [{', '.join([f'*{old}'] * 9)}]\n" for old, new in pairwise("abcdefg"))


@pytest.mark.parametrize(
    ("text", "culprit"),
    [
        ("contact:\n  damping: 0.01\n", "overlay.yaml:2: contact.damping ="),
        (f"a: &a [x, x, x, x, x, x, x, x]\n{BOMB}", "overlay.yaml:1: not valid YAML"),
    ],
)
def test_snakemake_with_a_bad_config(workspace, text, culprit):
    done = workspace.snakemake("--cores", "1", config=text)
    (line,) = lines_of_ours(done.stderr)
    assert line.startswith(culprit)
    assert (done.returncode, done.stdout, workspace.results.exists()) == (2, "", False)


def test_all_problems_are_reported_at_once_with_their_locations(workspace):
    (workspace.folder / "mine.yaml").write_text("\nblade:\n  length: 200\n")
    files, values = ("config/quick.yaml", "mine.yaml"), ("coating=[]", "figures={dpi: 2}")
    done = workspace.snakemake("--cores", "1", "--configfile", *files, "--config", *values)
    culprits = [line.split(" =")[0] for line in lines_of_ours(done.stderr)]
    assert culprits == ["mine.yaml:3: blade.length", "--config: coating", "--config: figures.dpi"]
    assert done.returncode == 2


def test_files_lie_over_one_another_and_the_command_line_over_all(workspace, tiny):
    folder = workspace.folder
    (folder / "base.yaml").write_text(
        yaml.safe_dump(tiny | {"results": "base", "figures": {"dpi": 31, "max_frequency": 2}})
    )
    (folder / "mine.yaml").write_text(
        "results: own\nfigures: {dpi: 32}\n"
        "coatings: [{casing: 2nd, E: [2], K: [0.5], theta: [0.0, 0.15]}]\nsolver: {max_time_step: 25e-8}\n"
    )
    files, values = ("base.yaml", "mine.yaml"), ("figures={max_frequency: 1e0}", "results=said")
    done = workspace.snakemake("--dry-run", "--configfile", *files, "--config", *values)
    assert done.returncode == 0, done.stderr
    assert "said/maps/2nd_E2_K0.5_theta0.15.h5" in done.stdout
    assert not re.search("2nd5nd|own/|base/", done.stdout)
