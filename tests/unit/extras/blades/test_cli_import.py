import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

from bladerub.blade import build, built, cache
from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.geometry import BladeShape
from bladerub.blade.mesh import BladeMesh
from bladerub.cli import main
from bladerub.config import read as configuration
from bladerub.extras.blade_meshes import read_built
from bladerub.extras.export.blade_files import write_sections
from bladerub.extras.export.mesh_file import write_mesh_file
from bladerub.io.folders import ROOT
from bladerub.io.provenance import provenance
from bladerub.settings.blade import Mesh
from bladerub.settings.study import typed

CONFIG = Path(__file__).parents[4] / "config" / "config.yaml"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The default blade on a coarse mesh, in mm, and a config that asks for few speeds."""
    folder = tmp_path_factory.mktemp("blade")
    counts = Mesh(chordwise=7, thickness=1, spanwise=6)
    mesh = BladeMesh.from_shape(BladeShape.from_config(configuration.read(CONFIG).blade), counts)
    sets = {"FOOT": mesh.root, "TOP": mesh.tip}
    write_mesh_file(folder / "blade.inp", 1e3 * mesh.mesh.points, mesh.mesh.cells, sets)
    (folder / "small.yaml").write_text("reduction: {accuracy_speeds: 3}\n")
    return folder


@pytest.fixture
def look(folder, capsys):
    def run(*more, file="blade.inp"):
        before = sorted(folder.iterdir())
        code = main(["import", str(folder / file), "--config", str(folder / "small.yaml"), *more])
        assert sorted(folder.iterdir()) == before
        assert code == 0
        return capsys.readouterr()

    return run


def test_figures_of_the_default_blade(look, folder, tmp_path, monkeypatch):
    monkeypatch.setenv("BLADERUB_CACHE", str(tmp_path / "cache"))
    out, _ = look("--unit", "mm", "--root-set", "foot", "--tip-set", "TOP", "--json")
    figures = json.loads(out)
    assert figures["f1_hz"] == pytest.approx(195.3, abs=0.1)
    assert figures["campbell_ratio"] == pytest.approx(1.305, abs=0.005)
    assert max(figures["error_eq2"]) > 1e-5  # speeds between those of the fit are looked at
    assert figures["tip_cone_degrees"] == pytest.approx(12.45)
    scale = figures["config"]["contact"]["scale"]
    assert scale == pytest.approx({"length": 1, "modulus": 1, "time": 1}, abs=0.03)
    assert figures["node_sets"] == {"FOOT": 38, "TOP": 38}
    assert (figures["nominal_speed"], "figures" in figures["config"]) == (None, False)
    source = {"file": str(folder / "blade.inp"), "unit": "mm", "root_set": "foot", "tip_set": "TOP"}
    assert source.items() <= figures["config"]["blade"]["source"].items()
    (path,) = (tmp_path / "cache").rglob("reduced_model.h5")
    blade, orders = read_built(path).reduced, []
    for each in figures["crossings"]:
        first = reduced_frequencies(blade, each["f_omega"], 1)[0]
        orders.append(60 * first / each["rpm"])
    assert orders == pytest.approx(list(range(4, 13)), rel=1e-6)


def test_what_it_prints_is_a_config_of_the_blade(look, folder):
    (folder / "steel.yaml").write_text("blade: {material: {density: 7800, poisson_ratio: 0.32}}\n")
    out, _ = look("--unit", "mm", "--config", str(folder / "steel.yaml"))
    assert "warning             its mesh is coarse, with 6 elements" in out
    printed = yaml.safe_load(out.split("are absolute\n")[1])
    study = yaml.safe_load((ROOT / "config" / "config.yaml").read_text(encoding="utf-8"))
    material = study["blade"]["material"] | {"density": 7800, "poisson_ratio": 0.32}
    assert printed["blade"]["material"] == material  # whole, so that no other blade's is taken
    assert printed["reduction"] == {"accuracy_speeds": 3}
    (folder / "printed.yaml").write_text(out.split("are absolute\n")[1])
    assert look("--config", str(folder / "printed.yaml")).out == out


def test_a_sense_of_rotation_that_no_compressor_has_is_told(look):
    right, wrong = (
        json.loads(look("--unit", "mm", "--rotation", axis, "--json").out) for axis in ("-x", "x")
    )
    np.testing.assert_allclose(right["tip_lean"], np.negative(wrong["tip_lean"]), rtol=1e-4)
    assert right["tip_stagger_degrees"] == pytest.approx(62, abs=0.5)
    (told,) = [line for line in wrong["warnings"] if line not in right["warnings"]]
    assert "has rotation = x or downstream = x the wrong sign?" in told


def test_sections_are_meshed_as_the_config_says_and_reported(look, folder):
    shape = BladeShape.from_config(configuration.read(CONFIG).blade)
    write_sections(folder / "blade.csv", shape, "cylindrical")
    (folder / "coarse.yaml").write_text("blade: {mesh: {chordwise: 7, thickness: 1, spanwise: 6}}\n")
    coarse = ("--config", str(folder / "coarse.yaml"))
    out, _ = look("--angle-unit", "rad", "--json", *coarse, file="blade.csv")
    figures = json.loads(out)
    assert figures["f1_hz"] == pytest.approx(195.3, abs=0.1)
    assert (figures["elements"], len(figures["sections"])) == (7 * 1 * 6, 21)
    assert figures["sections"][-1]["mean_radius"] == pytest.approx(0.6582, abs=0.01)
    assert figures["config"]["blade"]["source"]["angle_unit"] == "rad"


def test_what_is_no_blade_is_refused_before_anything_takes_time(tmp_path):
    (tmp_path / "short.csv").write_text("section,z,r,theta1,theta2\n1,0,1,0\n")
    program = "import sys; from bladerub.cli import main; code = main(sys.argv[1:]); "
    program += "print(code, {'numba', 'pandas', 'scipy', 'skfem', 'meshio'} & sys.modules.keys())"
    command = [sys.executable, "-c", program, "import", str(tmp_path / "short.csv")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout == "2 set()\n"
    assert "short.csv: line 2: has 4 cells, must have 5" in done.stderr


def test_the_study_takes_the_blade_that_was_imported(look, folder, tmp_path, monkeypatch):
    monkeypatch.setenv("BLADERUB_CACHE", str(tmp_path / "cache"))
    (folder / "five.yaml").write_text("reduction: {accuracy_speeds: 5}\n")
    out, _ = look("--unit", "mm", "--rpm", "9000", "--config", str(folder / "five.yaml"))
    assert "nominal speed       9000 1/min, f_omega = 0.76" in out
    (tmp_path / "printed.yaml").write_text(out.split("are absolute\n")[1])
    config = configuration.read(CONFIG, tmp_path / "printed.yaml")
    assert config.figures.nominal_speed == 9000
    values = config.plain()
    del values["blade"]["source"]["radial"]  # its default, as in a config by hand
    config = typed(values)
    meshed = build.meshed_blade(config.blade)
    built_now, folders = build.reduce_meshed(meshed, config), [tmp_path / name for name in ("now", "kept")]
    monkeypatch.setattr(build, "meshed_blade", lambda *_: pytest.fail("built again"))
    for blade, into in zip((built_now, build.build(config)), folders, strict=True):
        into.mkdir()
        built.write(blade, provenance(values), into / "reduced_model.h5")
    files = sorted(path.name for path in folders[0].iterdir())
    assert len(files) == 4
    assert all((folders[0] / name).read_bytes() == (folders[1] / name).read_bytes() for name in files)
    cache.kept_at(config).write_bytes(b"damaged")
    monkeypatch.setattr(build, "meshed_blade", lambda *_: None)
    monkeypatch.setattr(build, "reduce_meshed", lambda *_: "built again")
    assert build.build(config) == "built again"
    assert build.build(config.replaced("blade.source.unit", "m")) == "built again"


def test_the_layout_of_rotor_67_is_converted_as_its_page_says(tmp_path, monkeypatch):
    """A rotor on cones, whose blade is from 0 to 0.13 with stations at its edges."""
    x = np.linspace(-0.03, 0.16, 39)
    blocks, expected = ["A ROTOR OF OUR OWN\n"], []
    names = ("Axial Distance", "Radius*Theta Distance", "Delta (Radius*Theta) = thickness", "Radius")
    for number in range(1, 6):
        r = 0.3 + 0.06 * number + 0.1 * (x - 0.065)
        thickness = (0.013 - 0.0016 * number) * np.maximum(0, 1 - ((x - 0.065) / 0.065) ** 2).round(12)
        upper = (x - 0.065) * np.tan(np.deg2rad(30 + 6 * number)) + thickness / 2
        blocks.append(f" Surface number  {number} from hub (surface 1 is the hub)\n")
        for name, values in zip(names, (x, upper, thickness, r), strict=True):
            lines = [" ".join(f"{value:.9f}" for value in row) for row in np.split(values, [8, 16, 24, 32])]
            blocks.append("\n ".join([f" {name}", " 1.000000", *lines]) + "\n")
        table = [np.full(39, number), x, r, upper / r, (upper - thickness) / r]
        expected.append(np.transpose(table)[6:33])  # of which the first and the last have no thickness
    page = (ROOT / "docs" / "how-to" / "bring_a_blade.md").read_text(encoding="utf-8")
    code, _ = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    (tmp_path / "rotor67geometry.dat").write_text("".join(blocks))
    monkeypatch.chdir(tmp_path)
    exec(code, {})
    found = np.loadtxt("rotor67.csv", delimiter=",", skiprows=1)
    np.testing.assert_allclose(found, np.vstack(expected), atol=1e-8)
