import numpy as np
import pandas as pd
import pytest
import scipy.linalg
from blade_parts import REDUCTION

from bladerub.blade.build import build
from bladerub.blade.built import write
from bladerub.blade.files import accuracy_path, mesh_path
from bladerub.blade.geometry import BladeShape
from bladerub.blade.reduction import directions
from bladerub.blade.validation import read_reduced_blade
from bladerub.io import hdf5
from bladerub.settings.blade import BladeSpec


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
