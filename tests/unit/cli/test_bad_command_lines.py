"""Bad command lines, and files that they name: one line with the culprit, and nothing written."""

import os

import h5py
import numpy as np
import pytest

from bladerub.blade.model import ReducedBlade, write_reduced_blade

RUN = "run --casing 2nd --E 2 --K 0.5 --f 0.19"
COMMANDS = {
    "run --casing 2dn --E 2 --K 1 --f 0.19": '"2dn": must be one of 2nd, 2nd5nd; did you mean 2nd?',
    "run --casing 2nd --coating rigid --E 1GPa --f 1": '--E = "1GPa": goes with --coating abradable only',
    f"{RUN} --f 0.41": "--f = 0.41: must be at most reduction.f_omega_max = 0.4",
    "run --casing 2nd --E 2 --K 1 --rpm 9000 --config small.yaml": "--rpm = 0.7",
    f"{RUN} --interference 6.5mm": "below the layer thickness, 0.006 m (6 mm), or the blade",
    f"{RUN} --law-parameter viscosity=1 --law-parameter viscosity=2": "viscosity=2: must be there once",
    f"{RUN} --revolutions {10**30}": f"--revolutions = {10**30}: ",
    f"{RUN} --coupling 0.1": "--coupling = 0.1: goes with --blades only",
    f"{RUN} --law-parameter viscosity": "--law-parameter = viscosity: must be NAME=VALUE",
    f"{RUN} --config pipe": "pipe: is not a regular file, must be a YAML file",
    f"{RUN} --output text/run.h5": "--output text/run.h5: cannot be written, ",
    f"{RUN} --blade /dev/zero": "/dev/zero: is not a regular file, must be a reduced blade (HDF5)",
    f"{RUN} --blade text": "text: not a readable HDF5 file",
    f"{RUN} --blade other.h5": "other.h5: not a reduced blade, 'mass' is missing",
    f"{RUN} --blade endless.h5": "endless.h5: not a reduced blade, mass has the shape (200000, 200000)",
    "verify --sample 1": "the following arguments are required: --seed",
    "benchmark --nodes 16 33": "--nodes 33: must be from 4 to 32",
    "benchmark --config rigid.yaml": "coatings: must have an abradable one",
    "config unsafe.yaml": "unsafe.yaml:2: not valid YAML (the tag",
    "compare nowhere rotor37": "nowhere",
}


@pytest.fixture(scope="module")
def folder(folder):
    (folder / "text").write_text("mass = 1\n")
    rigid = "coatings: [{casing: 2nd, coating: rigid, friction: [0]}]\nanalysis: {histories: []}\n"
    (folder / "rigid.yaml").write_text(rigid)
    (folder / "unsafe.yaml").write_text("a: 1\nb: !!python/object/apply:os.system [touch executed]\n")
    os.mkfifo(folder / "pipe")
    matrices, nodes = 4 * [np.eye(24)], 3 * [np.eye(8, 3)]
    blade = ReducedBlade(*matrices, *nodes, 1.0, 0.4, 6, 1e-5, 0.2)
    for name in ("other", "endless"):
        write_reduced_blade(folder / f"{name}.h5", blade, {})
        with h5py.File(folder / f"{name}.h5", "r+") as file:
            del file["mass"]
            if name == "endless":
                file.create_dataset("mass", shape=(200_000, 200_000), dtype=float, chunks=(100, 100))
    return folder


@pytest.mark.extras(cases=r"--(blades|coupling|law)|verify|benchmark|config unsafe|compare")
@pytest.mark.parametrize("line", COMMANDS)
def test_a_bad_command_line_is_refused(folder, at_home, refusal, monkeypatch, line):
    monkeypatch.chdir(folder)
    before = sorted(folder.rglob("*"))
    assert COMMANDS[line] in refusal(*line.split())
    assert sorted(folder.rglob("*")) == before
