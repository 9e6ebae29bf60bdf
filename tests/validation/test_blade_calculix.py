"""The blade against CalculiX (`ccx`, if on the path), an independent finite element program, also rotating.

For the stress a static step is added to the decks of `extras.export.blade_files`, with C3D20 elements
of 27 integration points each. Expected: the largest stress to 1 % outside of the tenths of the span at root
and tip; at each node within 1 % of it from 15 to 80 % of the span. At the edges of the root, where it depends
on the mesh, the largest stress is 5 % above that of CalculiX.
"""

import shutil
import subprocess

import numpy as np
import pytest

from bladerub.blade.build import build
from bladerub.blade.geometry import BladeShape, lattice
from bladerub.config.read import read
from bladerub.extras.blades.settings import Source
from bladerub.extras.export.blade_files import deck, write_decks
from bladerub.extras.export.mesh_file import write_mesh_file
from bladerub.extras.stress.nodal import NodalStress, running_displacement, von_mises
from bladerub.io.folders import ROOT
from bladerub.settings.blade import Mesh
from tests.unit.tetrahedra import tetrahedral_mesh

CCX = shutil.which("ccx")
SPEEDS = [0.0, 0.2, 0.4]
MATERIAL = read(ROOT / "config" / "config.yaml").blade.material

pytestmark = pytest.mark.skipif(CCX is None, reason="CalculiX (ccx) is not installed")


@pytest.fixture
def config(paper_config):
    coarser = paper_config.replaced("blade.mesh", Mesh(chordwise=14, thickness=1, spanwise=10))
    return coarser.replaced("reduction.accuracy_speeds", len(SPEEDS))


def calculix(folder, name):
    subprocess.run([CCX, "-i", name], cwd=folder, check=True, capture_output=True, timeout=300)


def frequencies(dat):
    """Frequencies (Hz) in the ``.dat`` file that CalculiX writes for a deck."""
    rows = [line.split() for line in dat.read_text().splitlines()]
    return np.array([float(row[3]) for row in rows if len(row) == 5 and row[0].isdigit()])


def largest_differences(config, folder):
    built = build(config)
    body = (built.mesh.mesh.points, built.mesh.mesh.cells, built.mesh.root, MATERIAL)
    decks = write_decks(folder, SPEEDS, built.reduced.f1_hz, *body)
    differences = []
    for f_omega, path in zip(SPEEDS, decks, strict=True):
        calculix(folder, path.stem)
        table = built.accuracy[np.isclose(built.accuracy.f_omega, f_omega)]
        ours = table.sort_values("mode").f_fe.to_numpy()
        theirs = frequencies(folder / f"{path.stem}.dat")
        differences.append(np.abs(ours[:8] / theirs[:8] - 1).max())
        print(f"f_omega = {f_omega}: largest difference of eight frequencies {differences[-1]:.1e}")
    return differences


def test_frequencies_of_hexahedra_agree(config, tmp_path):
    assert max(largest_differences(config, tmp_path)) < 1e-5


def test_frequencies_of_tetrahedra_agree(config, tmp_path):
    lattice_of = lattice(Mesh(chordwise=10, thickness=1, spanwise=12))
    mesh, _ = tetrahedral_mesh(*lattice_of, BladeShape.from_config(config.blade).points)
    write_mesh_file(tmp_path / "blade.vtu", mesh.points, mesh.cells, {})
    config = config.replaced("blade.source", Source(file=str(tmp_path / "blade.vtu")))
    # Its mass has fewer integration points than ours; with the same ones all are within 2e-7.
    assert max(largest_differences(config, tmp_path)) < 5e-4


def deck_of(mesh, omega):
    text = deck(mesh.mesh.points, mesh.mesh.cells, mesh.root, MATERIAL, omega)
    return text[: text.rindex("*STEP")]


def stress_of_calculix(folder, text):
    """Stress (n_nodes, 3, 3) at the nodes in the last step of a deck, Pa."""
    (folder / "blade.inp").write_text(text)
    calculix(folder, "blade")
    blocks = (folder / "blade.frd").read_text().split("-4  STRESS")
    rows = [line for line in blocks[-1].split("\n -3")[0].splitlines() if line.startswith(" -1")]
    # columns of twelve characters after the number of the node: xx, yy, zz, xy, yz, zx
    six = np.array([[float(row[at : at + 12]) for at in range(13, 85, 12)] for row in rows])
    return six[:, [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]


def assert_agreement(mesh, running, displacement, expected):
    found = NodalStress(mesh.points, mesh.cells, MATERIAL, running)(displacement)
    z = mesh.points[:, 2]
    span = (z - z.min()) / np.ptp(z)
    ours, theirs = von_mises(found), von_mises(expected)
    between = (span > 0.1) & (span < 0.9)
    assert ours[between].max() == pytest.approx(theirs[between].max(), rel=0.01)
    inside = (span > 0.15) & (span < 0.8)
    difference = np.abs(ours - theirs)[inside].max() / theirs[inside].max()
    print(f"largest difference from CalculiX: {difference:.1e} of the largest stress")
    assert difference < 0.01


def test_stress_of_the_rotation(built, tmp_path):
    rotating = deck_of(built.mesh, 2 * np.pi * SPEEDS[-1] * built.reduced.f1_hz)
    expected = stress_of_calculix(tmp_path, rotating.replace("*END STEP", "*EL FILE\nS\n*END STEP"))
    running = running_displacement(built.static_speed, built.static_displacement, SPEEDS[-1])
    assert_agreement(built.mesh.mesh, running, np.zeros_like(running), expected)


def test_stress_of_a_displaced_tip(built, tmp_path):
    """The interface nodes are displaced as in the first mode, which ours knows from the reduced model."""
    interface = built.mesh.interface
    displacement = 1e-3 * built.mode_shape[0, interface]
    step = ["*STEP", "*STATIC", "*BOUNDARY"]
    for node, of_node in zip(interface, displacement, strict=True):
        step += [f"{node + 1}, {axis}, {axis}, {by:.12e}" for axis, by in enumerate(of_node, 1)]
    text = deck_of(built.mesh, 0.0) + "\n".join([*step, "*EL FILE", "S", "*END STEP", ""])
    expected = stress_of_calculix(tmp_path, text)
    recovered = np.einsum("k,kna->na", displacement.ravel(), built.recovery[: displacement.size])
    assert_agreement(built.mesh.mesh, np.zeros_like(recovered), recovered, expected)
