"""The blade against CalculiX, an independent finite element program, at rest and rotating.

The decks are those of `bladerub.extras.export.calculix`. The test needs the solver `ccx` on the path.
"""

import shutil
import subprocess

import numpy as np
import pytest
from skfem import MeshTet1

from bladerub.blade.build import build
from bladerub.blade.elasticity import Material
from bladerub.blade.geometry import BladeShape, lattice
from bladerub.extras.blades.mesh_file import raised
from bladerub.extras.export.calculix import frequencies, write_decks
from bladerub.extras.export.mesh_file import write_mesh_file

CCX = shutil.which("ccx")
SPEEDS = [0.0, 0.2, 0.4]

pytestmark = pytest.mark.skipif(CCX is None, reason="CalculiX (ccx) is not installed")


@pytest.fixture
def config(paper_config):
    paper_config["blade"]["mesh"] = {"chordwise": 14, "thickness": 1, "spanwise": 10}
    paper_config["reduction"]["accuracy_speeds"] = len(SPEEDS)
    return paper_config


def largest_differences(config, folder):
    """Of the first eight frequencies from those of CalculiX, at each speed."""
    built = build(config)
    mesh, material = built.mesh.mesh, Material.from_config(config["blade"]["material"])
    body = (mesh.points, mesh.cells, built.mesh.root, material)
    decks = write_decks(folder, SPEEDS, built.reduced.f1_hz, *body)
    differences = []
    for f_omega, deck in zip(SPEEDS, decks, strict=True):
        subprocess.run([CCX, "-i", deck.stem], cwd=folder, check=True, capture_output=True, timeout=300)
        table = built.accuracy[np.isclose(built.accuracy.f_omega, f_omega)]
        ours = table.sort_values("mode").f_fe.to_numpy()
        theirs = frequencies(folder / f"{deck.stem}.dat")
        differences.append(np.abs(ours[:8] / theirs[:8] - 1).max())
        print(f"f_omega = {f_omega}: largest difference of eight frequencies {differences[-1]:.1e}")
    return differences


def test_frequencies_of_hexahedra_agree(config, tmp_path):
    assert max(largest_differences(config, tmp_path)) < 1e-5


def test_frequencies_of_tetrahedra_agree(config, tmp_path):
    cube = MeshTet1.init_tensor(*lattice({"chordwise": 10, "thickness": 1, "spanwise": 12}))
    edges = np.diff(cube.p[:, cube.t], axis=1)
    left_handed = np.einsum("in,in->n", np.cross(edges[:, 0], edges[:, 1], axis=0), edges[:, 2]) < 0
    nodes, cells = raised(cube.p.T, np.where(left_handed, cube.t[[1, 0, 2, 3]], cube.t).T)
    points = BladeShape.from_config(config["blade"]).points(*nodes.T).T
    write_mesh_file(tmp_path / "blade.vtu", points, cells, {})
    blade = config["blade"] | {"source": {"file": str(tmp_path / "blade.vtu")}}
    # Its mass has fewer integration points than ours; with the same ones all are within 2e-7.
    assert max(largest_differences(config | {"blade": blade}, tmp_path)) < 5e-4
