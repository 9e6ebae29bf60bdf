import meshio
import numpy as np
import pytest

from bladerub.extras.blades import mesh_file
from bladerub.io import hdf5


@pytest.fixture
def export(folder, at_home, figures):
    return lambda *words: figures("export", "--config", folder / "small.yaml", *words)


def test_decks_are_written_for_three_speeds_or_those_named(export, tmp_path):
    names = ["blade_0.0000.inp", "blade_0.2000.inp", "blade_0.4000.inp"]
    written = export("--calculix", tmp_path / "decks")["files"]
    assert written == [str(tmp_path / "decks" / name) for name in names]
    export("--calculix", tmp_path / "one", "--speeds", "0.3")
    assert [path.name for path in (tmp_path / "one").iterdir()] == ["blade_0.3000.inp"]


@pytest.mark.parametrize("name", ["blade.inp", "blade.msh", "blade.vtu"])
def test_the_mesh_is_that_of_the_blade_with_its_sets(export, folder, tmp_path, name):
    export("--mesh", tmp_path / name)
    content = mesh_file.read(tmp_path / name)
    mesh, _ = hdf5.read(folder / "results" / "blade" / "mesh.h5")
    np.testing.assert_array_equal(content.points, mesh["points"])
    np.testing.assert_array_equal(content.cells, mesh["cells"])
    for part in ("root", "tip", "interface"):
        np.testing.assert_array_equal(content.node_sets[part], np.sort(mesh[f"{part}_nodes"]))
    if name.endswith("vtu"):
        data = meshio.vtu.read(tmp_path / name).point_data
        modes = [name for name in data if name.startswith("mode_")]
        assert modes[0] == f"mode_1_{mesh['frequency'][0]:.5g}_Hz"
        np.testing.assert_array_equal([data[mode] for mode in modes], mesh["mode_shape"])
        np.testing.assert_array_equal(data["centrifugal_0.4000"], mesh["static_displacement"][-1])


def test_what_cannot_be_written_is_told(at_home, folder, refusal, tmp_path):
    deck = ("--calculix", tmp_path, "--speeds", "0.5")
    line = refusal("export", "--config", folder / "small.yaml", *deck)
    assert "--speeds 0.5: must be from 0 to 0.4 (normalised)" in line
    assert not list(tmp_path.iterdir())


def test_sections_need_no_blade_and_come_in_two_coordinates(export, tmp_path):
    assert export("--sections", tmp_path / "blade.csv")["stations"] == 21 * 61
    export("--sections", tmp_path / "blade.txt", "--coordinates", "cylindrical")
    headers = [(tmp_path / name).read_text().splitlines()[1] for name in ("blade.csv", "blade.txt")]
    assert headers == ["section,x1,y1,z1,x2,y2,z2", "section,z,r,theta1,theta2"]
