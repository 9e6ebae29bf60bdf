import dataclasses

import numpy as np
import pandas as pd
import pytest
from free_vibration import frequencies
from scipy.io import loadmat

from bladerub.blade.geometry import BladeShape
from bladerub.blade.mesh import BladeMesh
from bladerub.config.read import read
from bladerub.contact.modes import at_tip
from bladerub.contact.setup import set_up
from bladerub.contact.spec import Coating
from bladerub.extras.blades.importing import import_blade
from bladerub.extras.blades.settings import Source
from bladerub.extras.export.blade_files import deck, write_matrices, write_sections
from bladerub.extras.export.recording import record
from bladerub.extras.rows.row import simulate_row
from bladerub.extras.rows.spec import Disk, Row
from bladerub.io.folders import ROOT
from bladerub.settings.blade import Material, Mesh

COUNTS = Mesh(chordwise=7, thickness=1, spanwise=6)


@pytest.mark.parametrize("coordinates", ["cartesian", "cylindrical"])
def test_the_default_blade_comes_back_from_its_sections_in_inches_and_degrees(tmp_path, coordinates):
    blade = read(ROOT / "config" / "config.yaml").blade
    path = tmp_path / "blade.csv"
    write_sections(path, BladeShape.from_config(blade), coordinates)
    table = pd.read_csv(path, comment="#")
    lengths = [name for name in table if name not in ("section", "theta1", "theta2")]
    table[lengths] /= 0.0254
    if coordinates == "cylindrical":
        table[["theta1", "theta2"]] = np.rad2deg(table[["theta1", "theta2"]])
    table.to_csv(path, index=False)
    imported = import_blade(Source(file=str(path), unit="inch", angle_unit="deg"), COUNTS)
    ours = BladeMesh.from_shape(BladeShape.from_config(blade), COUNTS)
    found, expected = (frequencies(of.mesh, of.root, blade.material) for of in (imported.blade.mesh, ours))
    np.testing.assert_allclose(found, expected, rtol=3e-4)
    assert np.rad2deg(imported.blade.tip_cone) == pytest.approx(blade.tip_cone, abs=1e-4)
    interface = imported.blade.mesh.mesh.points[imported.blade.mesh.interface]
    np.testing.assert_allclose(interface, ours.mesh.points[ours.interface], atol=1e-4)


def test_a_deck_of_a_rotating_blade_has_its_load_first():
    material = Material(young_modulus=110e9, poisson_ratio=0.32, density=4430.0)
    points = np.arange(60.0).reshape(20, 3)
    text = deck(points, np.arange(20)[None], np.array([0]), material, 30.0)
    assert "BLADE, CENTRIF, 9.000000000000e+02, 0., 0., 0., 1., 0., 0." in text
    assert text.index("*STEP, NLGEOM") < text.index("*STEP, PERTURBATION") < text.index("*FREQUENCY")


@pytest.mark.parametrize("name", ["blade.npz", "blade.mat"])
def test_matrices_come_back_under_their_names(blade, name, tmp_path):
    blade = dataclasses.replace(blade, stiffness_higher=(2 * blade.mass,))
    write_matrices(tmp_path / "new" / name, blade)
    data = (np.load if name.endswith("npz") else loadmat)(tmp_path / "new" / name)
    for matrix_name, matrix in blade.arrays.items():
        np.testing.assert_array_equal(data[matrix_name], matrix)
    for attribute in ("f1_hz", "f_omega_max", "eta", "rank_tolerance", "length"):
        assert np.squeeze(data[attribute]) == getattr(blade, attribute)


def tip_at(blade, spec, instants):
    return at_tip(blade, record(blade, spec, Row.even(1), instants).coordinates[:, 0].T)


LONG = {"steps_per_element": 6, "max_time_step": 2e-5}  # step, too long for the highest mode
RIGID = {"coating": Coating(np.inf, np.inf, 0.1, 1e-6, 150e6, 5e-3, 200)}  # shares the modes out
CENTRAL = {"scheme": "central_differences", "max_time_step": 1e-6}


@pytest.mark.parametrize("values", [LONG, LONG | RIGID, CENTRAL])
def test_the_tip_is_where_the_run_has_it(blade, spec, change, values):
    spec = change(spec, **values)
    tip = tip_at(blade, spec, [100, 200 * spec.revolutions])[:, -1]
    rule, simulation = set_up(blade, spec)
    for _ in range(spec.revolutions):
        simulation.advance(np.empty(200))
    assert (rule.share < 1).any() == (spec.scheme == "exponential")
    np.testing.assert_allclose(tip, simulation.state.u[0, :16], rtol=0, atol=1e-9 * np.abs(tip).max())


def test_contact_forces_move_what_the_scheme_does_not_resolve(blade, spec, change):
    spec = change(spec, E=20.0, revolutions=1, **LONG)
    tip = tip_at(blade, spec, range(1, 201))
    rule, simulation = set_up(blade, spec)
    moved = 0
    for element in range(200):
        simulation.advance(np.empty(1), element)
        np.testing.assert_allclose(tip[:, element], simulation.state.u[0, :16], rtol=0, atol=1e-12)
        static = rule.static_compliance @ simulation.state.force[0, :16]
        moved += np.abs(static).max() > 1e-9
    assert moved > 5


def test_a_row_moves_and_wears_as_in_its_run(blade, spec, change):
    spec = change(spec, E=2.0, revolutions=3)
    row = Row.even(2, length=[0.0, 2e-5], frequency=[0.0, 0.01], disk=Disk.ring(2, [1e-3]))
    recording = record(blade, spec, row, range(401, 601))
    whole = simulate_row(blade, spec, row)
    assert whole.wear.any()
    np.testing.assert_array_equal(recording.time, np.arange(401, 601) / 200)
    np.testing.assert_array_equal(recording.wear[-1], whole.wear)
    np.testing.assert_array_equal(recording.revolution_peak, [of.revolution_peak for of in whole.blades])
    for number, of in enumerate(whole.blades):
        tip = at_tip(blade, recording.coordinates[:, number].T)[0]
        between = 0.5 * (tip[1:] + tip[:-1])  # of a coarse ring
        means = of.radial_displacement[401:]
        np.testing.assert_allclose(between, means, rtol=0, atol=0.06 * np.abs(means).max())
