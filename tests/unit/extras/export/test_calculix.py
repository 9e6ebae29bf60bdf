import dataclasses

import numpy as np
import pytest
from scipy.io import loadmat

from bladerub.blade.elasticity import Material
from bladerub.extras.export.calculix import deck, frequencies
from bladerub.extras.export.matrices import write_matrices

MATERIAL = Material(110e9, 0.32, 4430.0)


POINTS = np.arange(60.0).reshape(20, 3)


def test_a_deck_of_a_rotating_blade_has_its_load_first():
    text = deck(POINTS, np.arange(20)[None], np.array([0]), MATERIAL, 30.0)
    assert "BLADE, CENTRIF, 9.000000000000e+02, 0., 0., 0., 1., 0., 0." in text
    assert text.index("*STEP, NLGEOM") < text.index("*STEP, PERTURBATION") < text.index("*FREQUENCY")


def test_frequencies_are_read_from_the_table_of_calculix(tmp_path):
    (tmp_path / "blade.dat").write_text(
        "\n     E I G E N V A L U E   O U T P U T\n\n MODE NO    EIGENVALUE                       FREQUENCY\n"
        "                                     REAL PART            IMAGINARY PART\n"
        "                           (RAD/TIME)      (CYCLES/TIME     (RAD/TIME)\n\n"
        "      1   0.1458357E+07   0.1207625E+04   0.1921995E+03   0.0000000E+00\n"
        "      2   0.2804134E+08   0.5295407E+04   0.8427901E+03   0.0000000E+00\n"
    )
    np.testing.assert_array_equal(frequencies(tmp_path / "blade.dat"), [192.1995, 842.7901])


@pytest.mark.parametrize("name", ["blade.npz", "blade.mat"])
def test_matrices_come_back_under_their_names(blade, name, tmp_path):
    blade = dataclasses.replace(blade, stiffness_higher=(2 * blade.mass,))
    write_matrices(tmp_path / "new" / name, blade)
    read = np.load if name.endswith("npz") else loadmat
    data = read(tmp_path / "new" / name)
    for matrix_name, matrix in blade.arrays.items():
        np.testing.assert_array_equal(data[matrix_name], matrix)
    for attribute in ("f1_hz", "f_omega_max", "eta", "rank_tolerance", "length"):
        assert np.squeeze(data[attribute]) == getattr(blade, attribute)
