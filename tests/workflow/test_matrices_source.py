"""A study of a blade whose mass and stiffness come from another program."""

import pytest
from scipy import sparse

from bladerub.blade.build import discretise, meshed_blade
from bladerub.config.read import load
from bladerub.extras.export.matrices import write_fe_matrices
from bladerub.io import hdf5

PICTURE = "results/figures/fig01_blade.png"


@pytest.fixture
def foreign(workspace, tiny):
    """Overlay of a study whose blade is the default one, as matrices."""
    config = load(workspace.folder / "config" / "config.yaml")
    config["blade"]["mesh"] = tiny["blade"]["mesh"]
    config["reduction"]["accuracy_speeds"] = 3
    blade = discretise(meshed_blade(config["blade"]), config)
    write_fe_matrices(workspace.folder / "matrices", blade, 0.4, ".npz")
    tiny["blade"]["source"] = {"matrices": "matrices"}
    return tiny


@pytest.mark.nightly
def test_a_blade_of_matrices_is_made_and_drawn_and_made_anew_with_a_file(workspace, foreign):
    workspace.build(foreign, PICTURE)
    mesh, _ = hdf5.read(workspace.folder / "results" / "blade" / "mesh.h5")
    assert mesh["cells"].shape == (0, 20)
    assert mesh["static_displacement"].shape == (0, *mesh["points"].shape)
    assert (workspace.folder / PICTURE).stat().st_size > 10_000
    assert workspace.plan(foreign, PICTURE) == {}
    file = workspace.folder / "matrices" / "stiffness_half.npz"
    sparse.save_npz(file, 1.0001 * sparse.load_npz(file))
    assert workspace.plan(foreign, PICTURE) == {"blade": 1, "fig01_blade": 1}
