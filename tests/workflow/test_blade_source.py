"""A study of a blade whose mesh comes from a file."""

import pytest

from bladerub.blade.build import meshed_blade
from bladerub.config.read import read
from bladerub.extras.export.mesh_file import write_mesh_file
from bladerub.io import hdf5
from bladerub.settings.blade import Mesh

PICTURE = "results/figures/fig01_blade.png"


@pytest.fixture
def foreign(workspace, tiny):
    """Overlay of a study whose blade is the default one, in mm."""
    blade = read(workspace.folder / "config" / "config.yaml").blade
    mesh = meshed_blade(blade.replaced("mesh", Mesh(chordwise=7, thickness=1, spanwise=4))).mesh.mesh
    write_mesh_file(workspace.folder / "meshes" / "blade.msh", 1e3 * mesh.points, mesh.cells, {})
    tiny["blade"]["source"] = {"file": "meshes/blade.msh", "unit": "mm"}
    return tiny


def test_a_blade_from_a_file_is_made_and_drawn_and_made_anew_with_the_file(workspace, foreign):
    workspace.build(foreign, PICTURE)
    mesh, _ = hdf5.read(workspace.folder / "results" / "blade" / "mesh.h5")
    assert mesh["cells"].shape == (7 * 4, 20)
    assert workspace.plan(foreign, PICTURE) == {}
    file = workspace.folder / "meshes" / "blade.msh"
    file.write_bytes(file.read_bytes() + b"$Comments\nlonger\n$EndComments\n")
    assert workspace.plan(foreign, PICTURE) == {"blade": 1, "fig01_blade": 1}


def test_a_study_of_it_draws_wear_maps_casings_and_on_those_of_its_own_spectra(workspace, foreign):
    casing = read(workspace.folder / "config" / "config.yaml").casings["2nd"].plain()
    foreign["casings"] = {"own": casing | {"nodal_diameters": [3]}}
    entry = {"E": [2, 5], "K": [0.5], "theta": [0.0]}
    foreign["coatings"] = [{"casing": name} | entry for name in ("2nd", "own")]
    foreign["coatings"] += [{"casing": "own", "coating": "rigid", "friction": [0.0]}]
    plan = workspace.plan(foreign)
    assert (plan["coating"], plan["spectrum"], plan["casing"]) == (5, 5, 2)
    assert plan["wear_map"] == 4  # the rigid casing does not wear
    assert not {"findings", "margins"} & plan.keys()  # the paper speaks of another blade


def test_a_broken_file_ends_the_study_with_one_line(workspace, foreign):
    (workspace.folder / "meshes" / "blade.msh").write_text("$MeshFormat\n")
    said = workspace.failure(PICTURE, "--cores", "1", config=foreign)
    assert said.count("meshes/blade.msh: does not end with") == 1
    assert not (workspace.folder / "results" / "blade").exists()
