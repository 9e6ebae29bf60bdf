import xml.etree.ElementTree as ET

import meshio
import numpy as np
import pytest
from PIL import Image
from stand_in import edited

from bladerub.blade.validation import read_reduced_blade
from bladerub.cli import inputs, main
from bladerub.extras.blades import mesh_file
from bladerub.io import hdf5

RUN = ["--casing", "2nd", "--E", "2", "--K", "0.5", "--theta", "0.15", "--f", "0.19", "--revolutions", "2"]


@pytest.fixture(scope="module")
def folder(folder):
    """The coarse blade is in its results folder, and beside it a short run."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(inputs, "study_folder", lambda: folder)
        config = ["--config", str(folder / "small.yaml")]
        assert main(["run", *RUN, *config, "--output", str(folder / "run.h5")]) == 0
    return folder


@pytest.fixture
def words(folder, at_home):
    return ["export", "--run", folder / "run.h5", "--config", folder / "small.yaml", "--vtu"]


def collection(folder):
    entries = ET.parse(folder / "blade.pvd").getroot().find("Collection")
    return [(entry.get("file"), float(entry.get("timestep")), entry.get("part")) for entry in entries]


def test_node_1_moves_as_in_the_history_of_the_run(words, figures, folder):
    motion = folder / "new" / "motion"
    figures(*words, motion, "--samples", "40")
    blade = read_reduced_blade(folder / "results" / "blade" / "reduced_model.h5")
    data, _ = hdf5.read(folder / "results" / "blade" / "mesh.h5")
    history = hdf5.read(folder / "run.h5")[0]["radial_displacement"]
    node_1, root = data["interface_nodes"][0], data["root_nodes"]
    names, times, _ = zip(*collection(motion), strict=True)
    assert sorted(path.name for path in motion.iterdir()) == sorted(["blade.pvd", *names])
    np.testing.assert_allclose(times, 1 + np.arange(1, 41) / 40)
    for name, time in list(zip(names, times, strict=True))[:-1]:
        displacement = meshio.read(motion / name).point_data["displacement"]
        assert not displacement[root].any()
        passed = round(time * 2000)
        in_run = history[passed - 1 : passed + 1].mean()  # means over the elements before and after
        radial = displacement[node_1] @ blade.radial_direction[0]
        assert radial == pytest.approx(in_run, abs=2e-3 * np.abs(history).max())


def test_figures_as_json(words, figures, tmp_path, folder):
    told = figures(*words, tmp_path / "motion", "--samples", "2")
    data = [meshio.read(file) for file in (tmp_path / "motion").glob("*.vtu")]
    assert (told["samples"], told["revolution"]) == (len(data), 2)
    np.testing.assert_array_equal(data[0].points, hdf5.read(folder / "results/blade/mesh.h5")[0]["points"])
    moved = [np.linalg.norm(mesh.point_data["displacement"], axis=1).max() for mesh in data]
    assert told["largest_displacement"] == pytest.approx(max(moved))
    for name in ("von_mises", "principal"):
        at = np.array([mesh.point_data[name] for mesh in data])
        assert told[f"largest_{name}"] == pytest.approx(at.max())
        node = np.unravel_index(at.argmax(), at.shape)[1]
        np.testing.assert_allclose(told[f"largest_{name}_at"], data[0].points[node])


def test_a_row_of_blades_is_shown_with_its_coating(words, command, figures, tmp_path, folder):
    run, blades = tmp_path / "row.h5", ["--blades", "3", "--length-scatter", "5e-5", "--coupling", "0.01"]
    config = ["--config", folder / "small.yaml"]
    assert command("run", *RUN, *blades, *config, "--output", run)[0] == 0
    told = figures(*words, tmp_path / "motion", "--samples", "2", "--run", run)
    assert (told["blades"], told["revolution"]) == (3, 2)
    names = [f"{name}_000{number}.vtu" for number in (1, 2) for name in ("blade", "coating")]
    parts = [(name, part) for name, _, part in collection(tmp_path / "motion")]
    assert parts == list(zip(names, "0101", strict=True))
    mesh = hdf5.read(folder / "results" / "blade" / "mesh.h5")[0]
    blades, coating = (meshio.read(tmp_path / "motion" / f"{name}_0002.vtu") for name in ("blade", "coating"))
    points = blades.points.reshape(3, -1, 3)
    np.testing.assert_allclose(points[0], mesh["points"])
    tip = points[:, mesh["interface_nodes"][0]]
    ahead = np.diff(np.unwrap(np.arctan2(tip[:, 1], tip[:, 2])))
    np.testing.assert_allclose(ahead, 2 * np.pi / 3)  # the blades stand at even angles in the rotation
    wear = hdf5.read(run, {"wear"})[0]["wear"]
    np.testing.assert_allclose(coating.point_data["wear"].reshape(8, -1), wear)
    # after whole revolutions the first element is back where the first blade was
    first = coating.points.reshape(8, 2000, 3)[0, 0]
    assert np.arctan2(first[1], first[2]) == pytest.approx(np.pi / 2000)
    animation = ["export", "--run", run, *config, "--samples", "3", "--animation"]
    assert command(*animation, tmp_path / "row.gif")[0] == 0
    with Image.open(tmp_path / "row.gif") as image:
        assert image.n_frames == 3
    assert [command(*animation, tmp_path / name)[0] for name in ("row.gif", "row.mp4")] == [2, 2]


def changed(run, path, **attributes):
    path.write_bytes(run.read_bytes())
    with edited(path) as file:
        for name, value in attributes.items():
            file.attrs[name] = value
        if "peak" in attributes:
            file["revolution_peak"][...] *= 1.001
    return path


def test_a_run_that_left_all_bounds_is_shown_until_then(words, figures, tmp_path, folder):
    run = changed(folder / "run.h5", tmp_path / "run.h5", status="unbounded")
    with edited(run) as file:
        file["revolution_amplitude"][-1] = np.nan
    assert figures(*words, tmp_path / "motion", "--samples", "1", "--run", run)["revolution"] == 1


@pytest.mark.parametrize(
    ("attributes", "said"), [({"E": 2.5}, "its run_key differs"), ({"peak": 1}, "its peaks differ by")]
)
def test_a_run_of_something_else_is_refused(words, refusal, tmp_path, folder, attributes, said):
    run = changed(folder / "run.h5", tmp_path / "run.h5", **attributes)
    line = refusal(*words, tmp_path / "motion", "--run", run)
    assert line.startswith(f"bladerub export: --run {run}: ")
    assert said in line
    assert not (tmp_path / "motion").exists()


def test_a_mesh_that_is_not_that_of_the_blade_is_refused(words, refusal, tmp_path, folder):
    blade, mesh = (tmp_path / name for name in ("reduced_model.h5", "mesh.h5"))
    for path in (blade, mesh):
        path.write_bytes((folder / "results" / "blade" / path.name).read_bytes())
    with edited(mesh) as file:
        file["points"][...] *= 1.01
    assert f"{mesh}: is not the mesh" in refusal(*words, tmp_path / "motion", "--blade", blade)


@pytest.fixture
def export(folder, at_home, figures):
    return lambda *words: figures("export", "--config", folder / "small.yaml", *words)


def test_decks_are_written_for_three_speeds_or_those_named(export, tmp_path):
    names = ["blade_0.0000.inp", "blade_0.2000.inp", "blade_0.4000.inp"]
    written = export("--calculix", tmp_path / "decks")["files"]
    assert written == [str(tmp_path / "decks" / name) for name in names]
    export("--calculix", tmp_path / "two", "--speeds", "0.3", "1000 rpm")
    slow, fast = sorted(float(deck.stem.removeprefix("blade_")) for deck in (tmp_path / "two").iterdir())
    assert 0.05 < slow < 0.15 < fast == 0.3


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
    assert "--speeds 0.5: must be from 0 to 0.4 of the first frequency at rest, " in line
    assert not list(tmp_path.iterdir())


def test_sections_need_no_blade_and_come_in_two_coordinates(export, refusal, tmp_path):
    assert export("--sections", tmp_path / "blade.csv")["stations"] == 21 * 61
    export("--sections", tmp_path / "blade.txt", "--coordinates", "cylindrical")
    headers = [(tmp_path / name).read_text().splitlines()[1] for name in ("blade.csv", "blade.txt")]
    assert headers == ["section,x1,y1,z1,x2,y2,z2", "section,z,r,theta1,theta2"]
    assert "is there already" in refusal("export", "--sections", tmp_path / "blade.csv")
