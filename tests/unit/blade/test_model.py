import dataclasses
from types import SimpleNamespace

import h5py
import numpy as np
import pandas as pd
import pytest
import scipy.linalg
from blade_parts import REDUCTION

from bladerub.blade.build import build
from bladerub.blade.built import write
from bladerub.blade.files import accuracy_path, mesh_path
from bladerub.blade.frequencies import accuracy_table, doubts, reduced_frequencies
from bladerub.blade.geometry import BladeShape
from bladerub.blade.mesh import BladeMesh
from bladerub.blade.model import write_reduced_blade
from bladerub.blade.reduction import directions, tip_slope
from bladerub.blade.validation import read_reduced_blade, read_valid_blade
from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.settings.blade import BladeSpec

RADIUS = 0.6


@pytest.fixture
def finer(blade):
    n = len(blade.mass)
    return dataclasses.replace(blade, stiffness_higher=(3 * np.eye(n), -5 * np.eye(n)))


def test_every_coefficient_is_stored_and_read(finer, tmp_path):
    write_reduced_blade(tmp_path / "blade.h5", finer, {})
    blade = read_reduced_blade(tmp_path / "blade.h5")
    assert blade.arrays.keys() == finer.arrays.keys() >= {"stiffness_3", "stiffness_4"}
    for name, matrix in finer.arrays.items():
        np.testing.assert_array_equal(blade.arrays[name], matrix)
    assert (blade.length, blade.f1_hz, blade.eta) == (finer.length, finer.f1_hz, finer.eta)


def test_higher_coefficients_add_the_next_even_powers(blade, finer):
    without = dict.fromkeys(("stiffness_0", "stiffness_1", "stiffness_2"), 0 * blade.mass)
    added = dataclasses.replace(finer, **without).stiffness(0.3)
    np.testing.assert_allclose(np.diag(added), 3 * 0.3**6 - 5 * 0.3**8, rtol=1e-12)
    np.testing.assert_allclose(finer.stiffness(0.3), blade.stiffness(0.3) + added, rtol=1e-12)


def test_a_speed_beyond_the_fit_is_refused(blade):
    np.testing.assert_array_equal(blade.stiffness(0.0), blade.stiffness_0)
    blade.stiffness(0.4)
    for f_omega in (0.4001, -0.0001):
        with pytest.raises(ValueError, match=r"is outside the fitted range \[0, 0.4\]"):
            blade.stiffness(f_omega)


def test_reduced_frequencies_are_those_of_the_oscillators(oscillators):
    expected = np.sqrt(np.arange(1, 6) ** 2 + 100 * 0.3**2 / (2 * np.pi) ** 2)
    np.testing.assert_allclose(reduced_frequencies(oscillators, 0.3, 5), expected, rtol=1e-12)
    assert reduced_frequencies(oscillators, 0.0)[-1] == pytest.approx(30.0)


def test_the_radius_of_the_tip_is_the_distance_from_the_axis(blade):
    moved = dataclasses.replace(blade, node_position=blade.node_position + np.array([1.0, 0.0, 0.0]))
    assert moved.tip_radius == pytest.approx(0.65)


def test_turn_about_the_axis_of_rotation_has_its_angle_as_slope():
    """On a tip of 15 by 3 nodes on a cylinder, staggered, whose middle row has the interface."""
    along, across = np.meshgrid(np.linspace(-0.04, 0.04, 15), np.linspace(-4e-3, 4e-3, 3), indexing="ij")
    x, arc = (0.5 * along - 0.8 * across).ravel(), (0.8 * along + 0.5 * across).ravel()
    points = np.column_stack([x, RADIUS * np.sin(arc / RADIUS), RADIUS * np.cos(arc / RADIUS)])
    middle = np.flatnonzero(np.isclose(across.ravel(), 0))[::2]
    tip = BladeMesh(SimpleNamespace(points=points), np.array([], dtype=int), np.arange(len(points)), middle)
    _, y, z = tip.mesh.points.T
    turn = np.column_stack([0 * y, z, -y])  # forward by 1 rad, to first order
    along = directions(tip.mesh.points[tip.interface], 0.0)
    np.testing.assert_allclose(tip_slope(tip, turn[None], *along), -1.0, rtol=0, atol=1e-4)
    line = BladeMesh(tip.mesh, tip.root, tip.interface, tip.interface)  # has no slope
    assert tip_slope(line, turn[None], *along) is None


def test_what_is_no_blade_is_named(blade, tmp_path):
    broken, path = blade.mass.copy(), tmp_path / "blade.h5"
    broken[3, 4] = np.nan
    stacked = blade.node_position * [0.0, 1.0, 1.0]
    for changes, words in (
        ({"mass": broken}, "mass: must be finite"),
        ({"stiffness_2": np.triu(blade.stiffness_2)}, "stiffness_2: must be symmetric"),
        ({"mass": -blade.mass}, "mass: must be positive definite"),
        ({"length": -0.2}, "length = -0.2: "),
        ({"node_position": stacked}, "node_position: must go on along the axis"),
        ({"f1_hz": 2 * np.pi * blade.f1_hz}, "f1_hz = .*: must be the lowest frequency at rest"),
    ):
        write_reduced_blade(path, dataclasses.replace(blade, **changes), {})
        with pytest.raises(ValueError, match=f"not a valid reduced blade.* {words}"):
            read_valid_blade(path)


def test_an_edited_blade_can_be_tried_and_is_not_that_of_the_study(blade, tmp_path):
    path = tmp_path / "blade.h5"
    write_reduced_blade(path, blade, {})
    with h5py.File(path, "r+") as file:
        file["node_position"][3, 2] *= 1.001
    assert read_valid_blade(path).node_position[3, 2] == 1.001 * blade.node_position[3, 2]
    with pytest.raises(DamagedFile, match=r"blade\.h5: not as it was written"):
        read_reduced_blade(path)


def test_table_has_a_row_for_each_speed_and_mode(oscillators):
    finite_element = {0.0: np.array([1.0, 2.0]), 0.4: np.array([1.1, 2.2])}
    by_law = {0.0: np.array([1.0, 2.0]), 0.4: np.array([1.2, 2.3])}
    table = accuracy_table(oscillators, finite_element, by_law)
    assert table[["f_omega", "mode"]].to_numpy().tolist() == [[0.0, 1], [0.0, 2], [0.4, 1], [0.4, 2]]
    assert table.f_fe_eq2.tolist() == [1.0, 2.0, 1.2, 2.3]
    expected = reduced_frequencies(oscillators, 0.4, 2) / [1.1, 2.2] - 1
    np.testing.assert_allclose(table.relative_error, [0.0, 0.0, *expected], atol=1e-12)


@pytest.fixture
def built(twisted_config):
    return build(BladeSpec(blade=twisted_config, reduction=REDUCTION.replaced("accuracy_modes", 4)))


def test_radial_direction_is_the_normal_of_a_conical_flow_path(twisted_config):
    shape = BladeShape.from_config(twisted_config.replaced("tip_cone", 12.0))
    tip = shape.points(np.linspace(0, 1, 9), 0.5, 1.0).T
    radius = np.hypot(tip[:, 1], tip[:, 2])
    np.testing.assert_allclose(radius, 0.65 + tip[:, 0] * np.tan(np.deg2rad(12.0)))
    radial, tangential = directions(tip, shape.tip_cone)
    outwards = tip * [0, 1, 1] / radius[:, None]
    along = np.array([1, 0, 0]) * np.cos(shape.tip_cone) + outwards * np.sin(shape.tip_cone)
    np.testing.assert_allclose(np.sum(radial * along, axis=1), 0, atol=1e-15)
    np.testing.assert_allclose(np.sum(radial * tangential, axis=1), 0, atol=1e-15)
    np.testing.assert_allclose(np.sum(radial * outwards, axis=1), np.cos(shape.tip_cone))
    np.testing.assert_allclose(np.cross(tangential, outwards), [[1.0, 0.0, 0.0]] * 9, atol=1e-15)  # ahead


def test_files_hold_what_was_built(built, tmp_path):
    reduced_model = tmp_path / "new" / "reduced_model.h5"
    write(built, {"provenance_software": "bladerub"}, reduced_model)
    blade = read_reduced_blade(reduced_model)
    np.testing.assert_array_equal(blade.stiffness_1, built.reduced.stiffness_1)
    assert blade.f1_hz == built.frequency[0]
    data, _ = hdf5.read(mesh_path(reduced_model))
    n_nodes = len(data["points"])
    assert data["cells"].shape == (7 * 1 * 3, 20)
    np.testing.assert_array_equal(data["points"][data["interface_nodes"]], blade.node_position)
    assert list(data["interface_node"]) == list(range(1, 9))
    assert data["mode_shape"].shape == (4, n_nodes, 3)
    assert data["static_displacement"].shape == (3, n_nodes, 3)
    assert not data["mode_shape"][:, data["root_nodes"]].any()
    np.testing.assert_allclose(np.abs(data["mode_shape"]).max(axis=(1, 2)), 1.0)
    accuracy = pd.read_csv(accuracy_path(reduced_model))
    assert len(accuracy) == 3 * 4
    assert accuracy.f_fe[0] == pytest.approx(blade.f1_hz, rel=1e-9)


@pytest.mark.extras
@pytest.mark.parametrize(
    ("eq2", "reduced", "nominal", "n_doubts"),
    [(0.009, 0.015, None, 0), (0.039, 0.04, 2400.0, 1), (0.009, 0.009, 3000.0, 1)],
)
def test_each_doubt_of_frequencies_has_a_line(eq2, reduced, nominal, n_doubts):
    """Of one mode of 100 Hz at rest, with these errors at one speed."""
    f_omega = np.arange(5) / 10
    f_fe, at = 100 * (1 + f_omega), f_omega == 0.3
    columns = {"f_fe": f_fe, "f_fe_eq2": f_fe * (1 + eq2 * at), "f_rom": f_fe * (1 + reduced * at)}
    table = pd.DataFrame({"f_omega": f_omega, "mode": 1, **columns, "relative_error": reduced * at})
    assert len(doubts(table, nominal)) == n_doubts


def test_nodes_follow_the_reduced_coordinates(built):
    """At the interface by definition, eq. (5); in the first mode as in that of the finite elements."""
    at_interface = built.recovery[:24, built.mesh.interface].reshape(24, 24)
    np.testing.assert_array_equal(at_interface, np.eye(24))
    assert not built.recovery[24:, built.mesh.interface].any()
    assert not built.recovery[:, built.mesh.root].any()
    _, modes = scipy.linalg.eigh(built.reduced.stiffness_0, built.reduced.mass)
    recovered = np.tensordot(modes[:, 0], built.recovery, axes=1)
    shape, largest = built.mode_shape[0], np.argmax(np.abs(built.mode_shape[0]))
    np.testing.assert_allclose(recovered / recovered.flat[largest], shape / shape.flat[largest], atol=1e-3)


def test_reduced_blade_is_symmetric_of_the_size_of_eq_4_and_bent_by_its_speeds(built):
    """Static displacements grow with the square of a low speed, later less, as the blade gets stiffer."""
    blade = built.reduced
    assert 24 + 3 < len(blade.mass) <= 3 * 24 + 3 * 3
    for matrix in (blade.mass, blade.stiffness_0, blade.stiffness_1, blade.stiffness_2):
        np.testing.assert_array_equal(matrix, matrix.T)
    assert np.linalg.eigvalsh(blade.mass).min() > 0
    assert built.static_speed.tolist() == pytest.approx([0, 0.2, 0.4])
    at_rest, half, full = np.linalg.norm(built.static_displacement, axis=(1, 2))
    assert at_rest == 0
    assert 2 < full / half < 4
