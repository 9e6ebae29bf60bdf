"""Files with drawn damage: the command that reads them accepts them or says in a line what is wrong.

BLADERUB_BROKEN_FILES=250 draws so many blades, and as many laws, curves and tables.
"""

import os
import re
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from bladerub.blade.build import meshed_blade
from bladerub.blade.discrete import by_finite_elements
from bladerub.blade.geometry import BladeShape
from bladerub.blade.mesh import BladeMesh
from bladerub.config.read import read
from bladerub.contact import law
from bladerub.extras.export.blade_files import write_fe_matrices, write_sections
from bladerub.extras.export.mesh_file import write_mesh_file
from bladerub.settings.blade import Mesh

CONFIG = Path(__file__).parents[3] / "config" / "config.yaml"
COUNTS = Mesh(chordwise=7, thickness=1, spanwise=3)
N_DRAWN = int(os.environ.get("BLADERUB_BROKEN_FILES", "12"))
LONGEST = 240  # s
MEMORY = (12 * 2**30,) * 2
PROGRAM = Path(sys.executable).with_name("bladerub")
WORDS = (b"nan", b"inf", b"1e160", b"-1", b"0", b"99999999", b"1e-300", b"x", b"", b"1,5", b"1;5")
BLADES = ("blade.inp", "blade.msh", "blade.vtu", "blade.csv", "text", "archives")
TEXTS = {"law.py": "check-law", "curves.csv": "fit-coating", "gap.csv": "config"}
"""Commands that read other files."""
STUDY = """
casings: {measured: {table: {file: gap.csv, unit: mm}, interference: 2.0e-4, start_angle: 0.0}}
coatings: [{casing: measured, E: [2], K: [0.5], theta: [0.0]}]
analysis: {histories: []}
"""

pytestmark = [pytest.mark.slow, pytest.mark.nightly]


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sound")
    blade = read(CONFIG).blade.replaced("mesh", COUNTS)
    shape = BladeShape.from_config(blade)
    mesh = BladeMesh.from_shape(shape, COUNTS)
    for name in BLADES[:3]:
        write_mesh_file(
            folder / name, mesh.mesh.points, mesh.mesh.cells, {"ROOT": mesh.root, "TIP": mesh.tip}
        )
    write_sections(folder / "blade.csv", shape, "cartesian")
    discrete = by_finite_elements(meshed_blade(blade), blade.material, [0, 0.2, 0.4], [], 8)
    for name, suffix in zip(BLADES[4:], (".mtx", ".npz"), strict=True):
        (folder / name).mkdir()
        write_fe_matrices(folder / name, discrete, 0.4, suffix)
    shutil.copy(law.__file__, folder / "law.py")
    strain = np.linspace(0.1, 3.0, 30)
    curve = np.column_stack([strain, np.minimum(9.0 * strain, 9.0 + 0.1 * strain), np.full(30, 1e-3)])
    header = "strain (%);stress (MPa);rate (1/s)"
    np.savetxt(folder / "curves.csv", curve, "%.4g", ";", header=header, comments="")
    angle = np.arange(0.0, 360.0, 5.0)
    gap = np.column_stack([angle, 0.42 + 0.2 * np.cos(2 * np.deg2rad(angle))])
    np.savetxt(folder / "gap.csv", gap, "%.4f", ",", header="# measured cold\nangle,gap", comments="")
    return folder


def damaged(content: bytes, random: np.random.Generator) -> bytes:
    lines, kind = content.splitlines(keepends=True), random.integers(6)
    at, other = random.integers(len(lines), size=2)
    start = random.integers(len(content))
    if kind == 0:
        return content[:start] + content[start + random.choice([1, 2000, len(content)]) :]
    if kind == 1:
        changed = bytearray(content)
        for where in random.integers(len(content), size=random.integers(1, 20)):
            changed[where] = random.integers(256)
        return bytes(changed)
    if kind == 2:
        lines[at], lines[other] = lines[other], lines[at]
    elif kind == 3:
        lines.insert(at, lines[other])
    elif kind == 4:
        del lines[min(at, 30) if random.random() < 0.5 else at]
    elif numbers := list(re.finditer(rb"[-+.\deE]+", lines[at])):
        start, end = numbers[random.integers(len(numbers))].span()
        lines[at] = lines[at][:start] + WORDS[random.integers(len(WORDS))] + lines[at][end:]
    return b"".join(lines)


def damage(path: Path, random: np.random.Generator) -> None:
    if path.is_dir():
        path = random.choice(sorted(path.iterdir()))
    if path.suffix != ".npz" or random.random() < 0.3:
        path.write_bytes(damaged(path.read_bytes(), random))
        return
    with np.load(path) as content:
        arrays = dict(content.items())
    name = random.choice([*arrays])
    if arrays[name].dtype.kind in "if" and arrays[name].size:
        values = arrays[name].ravel()
        values[random.integers(values.size)] = random.choice([-1, 0, 10**9, 2**31 - 1])
        arrays[name] = values.reshape(arrays[name].shape)
    else:
        del arrays[name]
    np.savez_compressed(path, **arrays)


def tried(sound: Path, folder: Path, seed: int, name: str, command: str, *options: str) -> str | None:
    """Give the command that reads a damaged copy, the first of a kind sound; its answer if that is bad."""
    folder.mkdir()
    (folder / "study.yaml").write_text(STUDY.replace("gap.csv", str(folder / "gap.csv")))
    copy = shutil.copytree if (sound / name).is_dir() else shutil.copy
    copy(sound / name, folder / name)
    is_sound = seed < len(BLADES if command == "import" else TEXTS)
    if not is_sound:
        damage(folder / name, np.random.default_rng(seed))
    file = folder / ("study.yaml" if command == "config" else name)
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True, "errors": "replace"}
    limits = {"timeout": LONGEST, "preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_AS, MEMORY)}
    done = subprocess.run([PROGRAM, command, file, *options], **streams, **limits)
    code, said = done.returncode, done.stdout
    refused_well = not is_sound and code == 2 and len(said.splitlines()) == 1
    wrong_law = code == 1 and command == "check-law"
    shutil.rmtree(folder)
    if "Traceback" in said or "Warning" in said or not (code == 0 or refused_well or wrong_law):
        return f"{seed} {name}: exit {code}, {said[-1500:]}"
    return None


@pytest.mark.parametrize("names", [BLADES, [*TEXTS]], ids=["blades", "laws, curves and tables"])
def test_damaged_files_are_accepted_or_refused_in_a_line(sound, tmp_path, names):
    (tmp_path / "small.yaml").write_text("reduction: {accuracy_speeds: 3}\n")
    bad = []
    for seed in range(N_DRAWN):
        name = names[seed % len(names)]
        command = [TEXTS[name]] if name in TEXTS else ["import", "--config", str(tmp_path / "small.yaml")]
        bad.append(tried(sound, tmp_path / str(seed), seed, name, *command))
    assert not any(bad), "\n".join(filter(None, bad))
