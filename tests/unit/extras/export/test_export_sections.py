import dataclasses

import numpy as np
import pandas as pd
import pytest
from scipy.io import loadmat

from bladerub.blade.elasticity import Material, Solid
from bladerub.blade.geometry import BladeShape
from bladerub.blade.linear import lowest_modes
from bladerub.blade.mesh import BladeMesh
from bladerub.blade.rotation import equilibrium
from bladerub.config.read import load
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.importing import import_blade
from bladerub.extras.blades.origin import Source
from bladerub.extras.export.calculix import deck
from bladerub.extras.export.calculix import frequencies as read_frequencies
from bladerub.extras.export.matrices import write_matrices
from bladerub.extras.export.sections import write_sections
from bladerub.io.folders import ROOT

COUNTS = {"chordwise": 7, "thickness": 1, "spanwise": 6}


def frequencies(mesh, material):
    solid = Solid(mesh.mesh, Material.from_config(material), clamped=mesh.root)
    return lowest_modes(equilibrium(solid, 0.0).stiffness, solid.mass, 8)[0]


@pytest.mark.parametrize("coordinates", ["cartesian", "cylindrical"])
def test_the_default_blade_comes_back_from_its_sections_in_inches_and_degrees(tmp_path, coordinates):
    blade = load(ROOT / "config" / "config.yaml")["blade"]
    path = tmp_path / "blade.csv"
    write_sections(path, BladeShape.from_config(blade), coordinates)
    table = pd.read_csv(path, comment="#")
    lengths = [name for name in table if name not in ("section", "theta1", "theta2")]
    table[lengths] /= 0.0254
    if coordinates == "cylindrical":
        table[["theta1", "theta2"]] = np.rad2deg(table[["theta1", "theta2"]])
    table.to_csv(path, index=False)
    imported = import_blade(Source(path, Frame("inch"), angle_unit="deg"), COUNTS)
    ours = BladeMesh.from_shape(BladeShape.from_config(blade), COUNTS)
    found, expected = (frequencies(mesh, blade["material"]) for mesh in (imported.blade.mesh, ours))
    np.testing.assert_allclose(found, expected, rtol=3e-4)
    assert np.rad2deg(imported.blade.tip_cone) == pytest.approx(blade["tip_cone"], abs=1e-4)
    assert all(section.cut == (0, 0) for section in imported.sections)
    interface = imported.blade.mesh.mesh.points[imported.blade.mesh.interface]
    np.testing.assert_allclose(interface, ours.mesh.points[ours.interface], atol=1e-4)


MATERIAL = Material(110e9, 0.32, 4430.0)
POINTS = np.arange(60.0).reshape(20, 3)


def test_a_deck_of_a_rotating_blade_has_its_load_first_and_the_frequencies_of_calculix_are_read(tmp_path):
    text = deck(POINTS, np.arange(20)[None], np.array([0]), MATERIAL, 30.0)
    assert "BLADE, CENTRIF, 9.000000000000e+02, 0., 0., 0., 1., 0., 0." in text
    assert text.index("*STEP, NLGEOM") < text.index("*STEP, PERTURBATION") < text.index("*FREQUENCY")
    (tmp_path / "blade.dat").write_text(
        "\n     E I G E N V A L U E   O U T P U T\n\n MODE NO    EIGENVALUE                       FREQUENCY\n"
        "                                     REAL PART            IMAGINARY PART\n"
        "                           (RAD/TIME)      (CYCLES/TIME     (RAD/TIME)\n\n"
        "      1   0.1458357E+07   0.1207625E+04   0.1921995E+03   0.0000000E+00\n"
        "      2   0.2804134E+08   0.5295407E+04   0.8427901E+03   0.0000000E+00\n"
    )
    np.testing.assert_array_equal(read_frequencies(tmp_path / "blade.dat"), [192.1995, 842.7901])


@pytest.mark.parametrize("name", ["blade.npz", "blade.mat"])
def test_matrices_come_back_under_their_names(blade, name, tmp_path):
    blade = dataclasses.replace(blade, stiffness_higher=(2 * blade.mass,))
    write_matrices(tmp_path / "new" / name, blade)
    data = (np.load if name.endswith("npz") else loadmat)(tmp_path / "new" / name)
    for matrix_name, matrix in blade.arrays.items():
        np.testing.assert_array_equal(data[matrix_name], matrix)
    for attribute in ("f1_hz", "f_omega_max", "eta", "rank_tolerance", "length"):
        assert np.squeeze(data[attribute]) == getattr(blade, attribute)
