"""The blade against CalculiX, an independent finite element program, at rest and rotating.

CalculiX (Dhondt, The Finite Element Method for Three-Dimensional Thermomechanical Applications, 2004) gets
the same nodes as C3D20 elements: a static step with geometric nonlinearity under centrifugal load, then the
frequencies of small vibrations about it. The test needs its solver `ccx` on the path.
"""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import yaml

from bladerub.blade.build import build

CCX = shutil.which("ccx")
CONFIG = Path(__file__).parents[2] / "config" / "config.yaml"

pytestmark = pytest.mark.skipif(CCX is None, reason="CalculiX (ccx) is not installed")


@pytest.fixture(scope="module")
def config():
    config = yaml.safe_load(CONFIG.read_text(encoding="utf-8"))
    config["blade"]["mesh"] = {"chordwise": 14, "thickness": 1, "spanwise": 10}
    config["reduction"]["accuracy_speeds"] = 3
    return config


@pytest.fixture(scope="module")
def built(config):
    return build(config)


def deck(built, material, f_omega):
    """Input of CalculiX, which reads at most 20 characters a number and 16 numbers a line."""
    mesh = built.mesh.mesh
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{i}, {x:.12e}, {y:.12e}, {z:.12e}" for i, (x, y, z) in enumerate(mesh.points, 1)]
    lines.append("*ELEMENT, TYPE=C3D20, ELSET=BLADE")
    for i, nodes in enumerate(mesh.cells + 1, 1):
        first, last = ", ".join(map(str, nodes[:15])), ", ".join(map(str, nodes[15:]))
        lines += [f"{i}, {first},", last]
    lines.append("*NSET, NSET=ROOT")
    lines += [f"{node}," for node in built.mesh.root + 1]
    elastic = f"{material['young_modulus']:.9e}, {material['poisson_ratio']:.9e}"
    lines += ["*MATERIAL, NAME=METAL", "*ELASTIC", elastic, "*DENSITY", f"{material['density']:.9e}"]
    lines += ["*SOLID SECTION, ELSET=BLADE, MATERIAL=METAL", "*BOUNDARY", "ROOT, 1, 3"]
    if f_omega > 0:
        square = (2 * np.pi * f_omega * built.reduced.f1_hz) ** 2
        lines += ["*STEP, NLGEOM", "*STATIC", "1., 1.", "*DLOAD"]
        lines += [f"BLADE, CENTRIF, {square:.12e}, 0., 0., 0., 1., 0., 0.", "*END STEP"]
    lines.append("*STEP, PERTURBATION" if f_omega > 0 else "*STEP")
    return "\n".join([*lines, "*FREQUENCY", "10", "*END STEP", ""])


@pytest.mark.parametrize("f_omega", [0.0, 0.2, 0.4])
def test_frequencies_agree(built, config, f_omega, tmp_path):
    (tmp_path / "blade.inp").write_text(deck(built, config["blade"]["material"], f_omega))
    subprocess.run([CCX, "-i", "blade"], cwd=tmp_path, check=True, capture_output=True, timeout=300)
    rows = [line.split() for line in (tmp_path / "blade.dat").read_text().splitlines()]
    calculix = [float(row[3]) for row in rows if len(row) == 5 and row[0].isdigit()]
    table = built.accuracy[np.isclose(built.accuracy.f_omega, f_omega)]
    ours = table.sort_values("mode").f_fe.to_numpy()
    difference = np.abs(ours[:8] / calculix[:8] - 1).max()
    print(f"f_omega = {f_omega}: largest difference of eight frequencies {difference:.1e}")
    assert difference < 1e-5
