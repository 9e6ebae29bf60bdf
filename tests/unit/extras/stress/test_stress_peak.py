import numpy as np
import pytest

from bladerub.extras.stress.peak import ModalStress, principal, static_peak, stress_peaks, von_mises


def six(tensor):
    i, j = np.array([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]).T
    return np.moveaxis(tensor[..., i, j], -1, 0)


def test_invariants_are_those_of_the_eigenvalues():
    tensor = np.random.default_rng(1).normal(size=(50, 3, 3))
    tensor += np.swapaxes(tensor, 1, 2)
    values = np.linalg.eigvalsh(tensor)
    np.testing.assert_allclose(principal(six(tensor)), values[:, 2], atol=1e-9)
    squares = sum((values[:, k] - values[:, k - 1]) ** 2 for k in range(3)) / 2
    np.testing.assert_allclose(von_mises(six(tensor)), np.sqrt(squares))


def test_peak_of_one_vibrating_coordinate_about_tension():
    def tension(displacement):  # zz grows with the displacement along z
        return (5.0 + displacement[:, 2])[:, None, None] * np.diag([0, 0, 1])

    recovery = np.zeros((1, 3, 3))
    recovery[0, :, 2] = 1.0, 9.0, 3.0
    points = np.array([[0.0, 0, 0], [0, 0, 2], [0, 0, 1]])
    stress = ModalStress.of_mesh(tension, recovery, points, np.array([0, 2]))
    time = np.linspace(0, 1, 81)
    (found,) = stress_peaks(stress, np.sin(2 * np.pi * time)[:, None], time, [slice(0, 81)])
    assert found["von_mises"] == pytest.approx(8.0)
    assert found["principal"] == pytest.approx(8.0)
    assert found["alternating"] == pytest.approx(3.0)
    assert (found["von_mises_z"], found["von_mises_time"]) == (1.0, 0.25)
    assert static_peak(stress)["von_mises"] == pytest.approx(5.0)


@pytest.fixture
def drawn():
    """A motion of four frequencies of a body with 400 nodes, and its stress."""
    rng = np.random.default_rng(5)
    slope = rng.normal(size=(4, 6, 400)) * np.geomspace(0.01, 1.0, 400)
    stress = ModalStress(rng.normal(size=(400, 3)), np.full((6, 400), 0.3), slope)
    time = np.linspace(0, 3, 600)
    return stress, np.sin(2 * np.pi * time[:, None] * [1, 2.3, 3.1, 5.7] + [0, 1, 2, 3]), time


def test_the_largest_of_all_nodes_and_instants_is_found_in_each_part(drawn):
    stress, coordinates, time = drawn
    parts = [slice(0, 450), slice(450, 590)]
    for part, found in zip(parts, stress_peaks(stress, coordinates, time, parts), strict=True):
        values = stress(coordinates[part])
        for name, of in (("von_mises", von_mises), ("principal", principal)):
            whole = of(values)
            assert found[name] == pytest.approx(whole.max())
            assert found[f"{name}_time"] == time[part][np.unravel_index(whole.argmax(), whole.shape)[1]]
        assert found["alternating"] == pytest.approx(von_mises(np.ptp(values, axis=-1) / 2).max())


def test_stress_of_other_coordinates_is_that_of_the_same_motion(drawn):
    stress, coordinates, _ = drawn
    patterns = np.random.default_rng(2).normal(size=(3, 4))
    np.testing.assert_allclose(stress.of(patterns)(coordinates[:, :3]), stress(coordinates[:, :3] @ patterns))
