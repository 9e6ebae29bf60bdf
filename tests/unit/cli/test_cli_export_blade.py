import json

import meshio
import numpy as np
import pytest

from bladerub.blade.validation import read_reduced_blade
from bladerub.cli import inputs, main
from bladerub.extras.blades import mesh_file
from bladerub.io import hdf5


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Stands for the repository, with a config of a coarse blade."""
    folder = tmp_path_factory.mktemp("repository")
    (folder / "small.yaml").write_text(
        "blade: {mesh: {chordwise: 7, thickness: 1, spanwise: 4}}\nreduction: {accuracy_speeds: 3}\n"
    )
    return folder


@pytest.fixture
def export(folder, monkeypatch, capsys):
    """Run the command on `folder`: exit code, what it printed and its errors."""
    monkeypatch.setattr(inputs, "study_folder", lambda: folder)

    def run(*more):
        capsys.readouterr()
        try:
            code = main(["export", "--config", str(folder / "small.yaml"), *map(str, more)])
        except SystemExit as error:  # argparse ends the program itself
            code = error.code
        return code, *capsys.readouterr()

    return run


def test_decks_are_written_for_three_speeds_or_those_named(export, tmp_path):
    code, out, _ = export("--calculix", tmp_path / "decks", "--json")
    assert code == 0
    names = ["blade_0.0000.inp", "blade_0.2000.inp", "blade_0.4000.inp"]
    assert json.loads(out)["files"] == [str(tmp_path / "decks" / name) for name in names]
    assert export("--calculix", tmp_path / "one", "--speeds", "0.3")[0] == 0
    assert [path.name for path in (tmp_path / "one").iterdir()] == ["blade_0.3000.inp"]


@pytest.mark.parametrize("name", ["blade.inp", "blade.msh", "blade.vtu"])
def test_the_mesh_is_that_of_the_blade_with_its_sets(export, folder, tmp_path, name):
    code, out, _ = export("--mesh", tmp_path / name)
    assert code == 0
    assert out.splitlines()[-1] == f"wrote {tmp_path / name}"
    content = mesh_file.read(tmp_path / name)
    mesh, _ = hdf5.read(folder / "results" / "blade" / "mesh.h5")
    np.testing.assert_array_equal(content.points, mesh["points"])
    np.testing.assert_array_equal(content.cells, mesh["cells"])
    for part in ("root", "tip", "interface"):
        np.testing.assert_array_equal(content.node_sets[part], np.sort(mesh[f"{part}_nodes"]))


def test_a_vtu_file_has_modes_and_centrifugal_displacements(export, folder, tmp_path):
    assert export("--mesh", tmp_path / "blade.vtu")[0] == 0
    data = meshio.vtu.read(tmp_path / "blade.vtu").point_data
    mesh, _ = hdf5.read(folder / "results" / "blade" / "mesh.h5")
    modes = [name for name in data if name.startswith("mode_")]
    assert len(modes) == len(mesh["frequency"])
    assert modes[0] == f"mode_1_{mesh['frequency'][0]:.5g}_Hz"
    np.testing.assert_array_equal(data[modes[2]], mesh["mode_shape"][2])
    assert {"centrifugal_0.2000", "centrifugal_0.4000"} <= data.keys()
    np.testing.assert_array_equal(data["centrifugal_0.4000"], mesh["static_displacement"][-1])


def test_matrices_are_those_of_the_reduced_blade(export, folder, tmp_path):
    assert export("--matrices", tmp_path / "blade.npz")[0] == 0
    blade = read_reduced_blade(folder / "results" / "blade" / "reduced_model.h5")
    with np.load(tmp_path / "blade.npz") as data:
        np.testing.assert_array_equal(data["stiffness_1"], blade.stiffness_1)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            [],
            "one of the arguments --vtu --animation --calculix --mesh --matrices --fe-matrices --sections is "
            "required",
        ),
        (["--calculix", "{}", "--speeds", "0.5"], "--speeds 0.5: must be from 0 to 0.4 (normalised)"),
        (
            ["--matrices", "{}/blade.npz", "--speeds", "0.1"],
            "--speeds: goes with --calculix or --fe-matrices only",
        ),
        (["--vtu", "{}/motion"], "--vtu: needs --run"),
        (["--mesh", "{}/blade.inp", "--matrices", "{}/blade.npz"], "not allowed with argument"),
    ],
)
def test_what_cannot_be_written_is_told(export, tmp_path, arguments, said):
    code, out, err = export(*(argument.format(tmp_path) for argument in arguments))
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert said in err
    assert not list(tmp_path.iterdir())


def test_sections_need_no_blade_and_come_in_two_coordinates(export, folder, tmp_path):
    code, out, _ = export("--sections", tmp_path / "blade.csv", "--json")
    assert code == 0
    assert json.loads(out) == {
        "files": [str(tmp_path / "blade.csv")],
        "coordinates": "cartesian",
        "sections": 21,
        "stations": 21 * 61,
    }
    code, out, _ = export("--sections", tmp_path / "blade.txt", "--coordinates", "cylindrical")
    assert code == 0
    assert out.splitlines()[-1] == f"wrote {tmp_path / 'blade.txt'}"
    headers = [(tmp_path / name).read_text().splitlines()[1] for name in ("blade.csv", "blade.txt")]
    assert headers == ["section,x1,y1,z1,x2,y2,z2", "section,z,r,theta1,theta2"]


def test_sections_that_cannot_be_written_are_told(export, tmp_path):
    code, _, err = export("--sections", tmp_path / "blade.xls")
    assert code == 2
    assert err == f"bladerub export: --sections {tmp_path}/blade.xls: must end in .csv, .txt, .dat\n"
    code, _, err = export("--mesh", tmp_path / "blade.vtu", "--coordinates", "cartesian")
    assert (code, err) == (2, "bladerub export: --coordinates: goes with --sections only\n")
    export("--sections", tmp_path / "blade.csv")
    (tmp_path / "foreign.yaml").write_text(f"blade: {{source: {{file: {tmp_path}/blade.csv}}}}\n")
    code, _, err = export("--sections", tmp_path / "other.csv", "--config", tmp_path / "foreign.yaml")
    assert code == 2
    assert "blade.csv; only a parametric one has sections" in err
    assert not (tmp_path / "other.csv").exists()
    steep = "{span: %g, chord: 0.08, thickness: 0.1, camber: 40, stagger: 75, sweep: 0, lean: 0}"
    (tmp_path / "steep.yaml").write_text(f"blade: {{sections: [{steep % 0}, {steep % 1}]}}\n")
    to_steep = ("--sections", tmp_path / "other.csv", "--config", tmp_path / "steep.yaml")
    code, _, err = export(*to_steep, "--coordinates", "cylindrical")
    assert (code, err.count("\n")) == (2, 1)
    assert "--coordinates cylindrical: the section at 0% of the span goes back along the axis" in err
