import numpy as np
import pytest

from bladerub.extensions.stress.peak import ModalStress, invariants, static_peak, stress_peak


def test_invariants_are_those_of_the_eigenvalues():
    tensor = np.random.default_rng(1).normal(size=(50, 3, 3))
    tensor += np.swapaxes(tensor, 1, 2)
    i, j = np.array([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]).T
    values = np.linalg.eigvalsh(tensor)
    found = invariants(tensor[:, i, j])
    np.testing.assert_allclose(found["principal"], values[:, 2], atol=1e-9)
    squares = sum((values[:, k] - values[:, k - 1]) ** 2 for k in range(3)) / 2
    np.testing.assert_allclose(found["von_mises"], np.sqrt(squares))


def test_pressure_has_no_von_mises_stress():
    found = invariants(np.array([-2.0, -2.0, -2.0, 0, 0, 0]))
    assert (found["von_mises"], found["principal"]) == (0.0, -2.0)


def test_peak_of_one_vibrating_coordinate_about_tension():
    def tension(displacement):  # zz grows with the displacement along z
        stress = np.zeros((*displacement.shape, 3))
        stress[:, 2, 2] = 5.0 + displacement[:, 2]
        return stress

    recovery = np.zeros((1, 2, 3))
    recovery[0, :, 2] = 1.0, 3.0
    stress = ModalStress(tension, recovery, np.array([[0.0, 0, 0], [0, 0, 1]]))
    time = np.linspace(0, 1, 81)
    found = stress_peak(stress, np.sin(2 * np.pi * time)[:, None], time)
    assert found["von_mises"] == pytest.approx(8.0)
    assert found["principal"] == pytest.approx(8.0)
    assert found["alternating"] == pytest.approx(3.0)
    assert (found["von_mises_z"], found["von_mises_time"]) == (1.0, 0.25)
    assert static_peak(stress)["von_mises"] == pytest.approx(5.0)


def test_the_nodes_that_are_left_out_do_not_matter():
    rng = np.random.default_rng(5)
    slope = rng.normal(size=(400, 3, 3, 3)) * np.geomspace(0.01, 1.0, 400)[:, None, None, None]

    def linear(displacement):
        stress = np.einsum("nijk,nk->nij", slope, displacement)
        return 0.3 + stress + np.swapaxes(stress, 1, 2)

    recovery = rng.normal(size=(4, 400, 3))
    stress = ModalStress(linear, recovery, rng.normal(size=(400, 3)))
    time = np.linspace(0, 3, 600)
    coordinates = np.sin(2 * np.pi * time[:, None] * [1, 2.3, 3.1, 5.7] + [0, 1, 2, 3])
    found = stress_peak(stress, coordinates, time)
    whole = invariants(stress(coordinates))
    for name in ("von_mises", "principal"):
        assert found[name] == whole[name].max()
        assert found[f"{name}_time"] == time[np.unravel_index(whole[name].argmax(), whole[name].shape)[0]]
