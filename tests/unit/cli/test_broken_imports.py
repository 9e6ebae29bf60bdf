"""Files of blades with drawn damage: ``bladerub import`` accepts them or says in a line what is wrong.

BLADERUB_BROKEN_IMPORTS=250 draws so many; each runs in a process of its own, whose signals are seen.
"""

import multiprocessing
import os
import re
import resource
import shutil
import sys
import traceback
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from bladerub.blade.build import meshed_blade
from bladerub.blade.discrete import by_finite_elements
from bladerub.blade.elasticity import Material
from bladerub.blade.geometry import BladeShape
from bladerub.blade.mesh import BladeMesh
from bladerub.cli import main
from bladerub.config.read import load
from bladerub.export.matrices import write_fe_matrices
from bladerub.export.mesh_file import write_mesh_file
from bladerub.export.sections import write_sections

CONFIG = Path(__file__).parents[3] / "config" / "config.yaml"
COUNTS = {"chordwise": 7, "thickness": 1, "spanwise": 3}
N_DRAWN = int(os.environ.get("BLADERUB_BROKEN_IMPORTS", "12"))
LONGEST = 240  # s
MEMORY = 12 * 2**30
WORDS = (b"nan", b"inf", b"1e160", b"-1", b"0", b"99999999", b"1e-300", b"x", b"", b"1,5", b"1;5")
KINDS = ("blade.inp", "blade.msh", "blade.vtu", "blade.csv", "text", "archives")

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    """One sound blade of each kind."""
    folder = tmp_path_factory.mktemp("sound")
    blade = load(CONFIG)["blade"] | {"mesh": COUNTS}
    shape = BladeShape.from_config(blade)
    mesh = BladeMesh.from_shape(shape, COUNTS)
    for name in KINDS[:3]:
        write_mesh_file(
            folder / name, mesh.mesh.points, mesh.mesh.cells, {"ROOT": mesh.root, "TIP": mesh.tip}
        )
    write_sections(folder / "blade.csv", shape, "cartesian")
    discrete = by_finite_elements(
        meshed_blade(blade), Material.from_config(blade["material"]), [0, 0.2, 0.4], [], 8
    )
    for name, suffix in zip(KINDS[4:], (".mtx", ".npz"), strict=True):
        (folder / name).mkdir()
        write_fe_matrices(folder / name, discrete, 0.4, suffix)
    return folder


def damaged(content: bytes, random: np.random.Generator) -> bytes:
    """Damage a file as disks, editors and other programs do."""
    lines = content.splitlines(keepends=True)
    at, other = random.integers(len(lines), size=2)
    kind = random.integers(7)
    if kind == 0:
        return content[: random.integers(len(content))]
    if kind == 1:
        changed = bytearray(content)
        for where in random.integers(len(content), size=random.integers(1, 20)):
            changed[where] = random.integers(256)
        return bytes(changed)
    if kind == 2:
        start = random.integers(len(content))
        return content[:start] + content[start + random.integers(1, 2000) :]
    if kind == 3:
        lines[at], lines[other] = lines[other], lines[at]
    elif kind == 4:
        lines.insert(at, lines[other])
    elif kind == 5:
        del lines[min(at, 30) if random.random() < 0.5 else at]
    else:
        numbers = list(re.finditer(rb"[-+.\deE]+", lines[at]))
        if numbers:
            start, end = numbers[random.integers(len(numbers))].span()
            lines[at] = lines[at][:start] + WORDS[random.integers(len(WORDS))] + lines[at][end:]
    return b"".join(lines)


def damage_archive(path: Path, random: np.random.Generator) -> None:
    with np.load(path) as content:
        arrays = dict(content.items())
    name = list(arrays)[random.integers(len(arrays))]
    if arrays[name].dtype.kind in "if" and arrays[name].size:
        values = arrays[name].astype(float).ravel()
        values[random.integers(values.size)] = (-1, 0, 1e9, 2**31 - 1)[random.integers(4)]
        arrays[name] = values.astype(arrays[name].dtype).reshape(arrays[name].shape)
    else:
        del arrays[name]
    np.savez_compressed(path, **arrays)


def damage(path: Path, random: np.random.Generator) -> None:
    if path.is_dir():
        files = sorted(path.iterdir())
        path = files[random.integers(len(files))]
        if path.suffix == ".npz" and random.random() < 0.7:
            damage_archive(path, random)
            return
    path.write_bytes(damaged(path.read_bytes(), random))


def look(path: Path, said: Path) -> None:
    """Import the blade at `path` in this process, which ends."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    with said.open("w") as stream:
        os.dup2(stream.fileno(), 1)
        os.dup2(stream.fileno(), 2)
        sys.stdout = sys.stderr = stream  # in place of those of pytest
        try:
            code = main(["import", str(path), "--config", str(path.parent / "small.yaml")])
        except SystemExit as error:
            code = error.code
        except BaseException:
            traceback.print_exc(file=stream)
            code = 99
        stream.flush()
        os._exit(code or 0)


def test_damaged_blades_are_accepted_or_refused_in_a_line(sound, tmp_path):
    counts, bad = Counter(), []
    for number in range(N_DRAWN):
        random = np.random.default_rng(number)
        name = KINDS[number % len(KINDS)]
        folder = tmp_path / str(number)
        folder.mkdir()
        (folder / "small.yaml").write_text("reduction: {accuracy_speeds: 3}\n")
        copy = shutil.copytree if (sound / name).is_dir() else shutil.copy
        copy(sound / name, folder / name)
        damage(folder / name, random)
        process = multiprocessing.get_context("fork").Process(
            target=look, args=(folder / name, folder / "said")
        )
        process.start()
        process.join(LONGEST)
        if process.is_alive():
            process.kill()
            process.join()
        said = (folder / "said").read_text(errors="replace")
        counts[name, process.exitcode] += 1
        refused_well = process.exitcode == 2 and len(said.splitlines()) == 1 and name in said
        if "Traceback" in said or "Warning" in said or not (process.exitcode == 0 or refused_well):
            bad.append((number, name, process.exitcode, said[-1500:]))
        shutil.rmtree(folder)
    print(*(f"{name:10} exit {code}: {n}" for (name, code), n in sorted(counts.items())), sep="\n")
    assert not bad, "\n".join(map(str, bad))
