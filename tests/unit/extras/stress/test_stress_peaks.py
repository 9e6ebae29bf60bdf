import numpy as np
import pytest

from bladerub.contact.kernel import loop
from bladerub.contact.run import simulate
from bladerub.extras.export.recording import record
from bladerub.extras.rows.spec import Row
from bladerub.extras.stress import sampling
from bladerub.extras.stress.peak import ModalStress, principal, static_peak, stress_peaks, von_mises
from bladerub.extras.stress.run import BladeStress, StressSolver
from bladerub.io import hdf5
from bladerub.io.errors import BadInput


def six(tensor):
    i, j = np.array([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]).T
    return np.moveaxis(tensor[..., i, j], -1, 0)


def test_invariants_are_those_of_the_eigenvalues_and_peaks_of_one_vibrating_coordinate_known():
    tensor = np.random.default_rng(1).normal(size=(50, 3, 3))
    tensor += np.swapaxes(tensor, 1, 2)
    values = np.linalg.eigvalsh(tensor)
    np.testing.assert_allclose(principal(*six(tensor)), values[:, 2], atol=1e-9)
    squares = sum((values[:, k] - values[:, k - 1]) ** 2 for k in range(3)) / 2
    np.testing.assert_allclose(von_mises(*six(tensor)), np.sqrt(squares))

    def tension(displacement):  # zz grows with the displacement along z
        return (5.0 + displacement[:, 2])[:, None, None] * np.diag([0, 0, 1])

    recovery = np.zeros((1, 3, 3))
    recovery[0, :, 2] = 1.0, 9.0, 3.0
    points = np.array([[0.0, 0, 0], [0, 0, 2], [0, 0, 1]])
    stress = ModalStress.of_mesh(tension, recovery, points, np.array([0, 2]))
    time = np.linspace(0, 1, 81)
    (found,) = stress_peaks(stress, np.sin(2 * np.pi * time)[:, None], time, [slice(0, 81)])
    assert [found[of] for of in ("von_mises", "principal", "alternating")] == pytest.approx([8.0, 8.0, 3.0])
    assert (found["von_mises_z"], found["von_mises_time"]) == (1.0, 0.25)
    assert static_peak(stress)["von_mises"] == pytest.approx(5.0)


def test_one_mode_alternates_by_the_von_mises_stress_of_its_amplitude_whatever_the_signs():
    slope = np.random.default_rng(3).normal(size=(1, 6, 50)).astype(np.float32)  # as of runs
    stress = ModalStress(np.zeros((50, 3)), np.zeros((6, 50), np.float32), slope)
    time = np.linspace(0, 1, 81)
    motion = np.sin(2 * np.pi * time)[:, None].astype(np.float32)
    (found,) = stress_peaks(stress, motion, time, [slice(0, 81)])
    assert found["alternating"] == pytest.approx(von_mises(*slope[0]).max(), rel=1e-5)


def test_the_largest_of_all_nodes_and_instants_is_found_in_each_part():
    rng = np.random.default_rng(5)
    slope = rng.normal(size=(4, 6, 400)) * np.geomspace(0.01, 1.0, 400)
    stress = ModalStress(rng.normal(size=(400, 3)), np.full((6, 400), 0.3), slope)
    time = np.linspace(0, 3, 600)
    coordinates = np.sin(2 * np.pi * time[:, None] * [1, 2.3, 3.1, 5.7] + [0, 1, 2, 3])
    parts = [slice(0, 450), slice(450, 590)]
    for part, found in zip(parts, stress_peaks(stress, coordinates, time, parts), strict=True):
        values = stress(coordinates[part])
        for name, of in (("von_mises", von_mises), ("principal", principal)):
            whole = of(*values)
            assert found[name] == pytest.approx(whole.max())
            assert found[f"{name}_time"] == time[part][np.unravel_index(whole.argmax(), whole.shape)[1]]
        furthest = np.max([von_mises(*(values - values[..., [k]])).max() / 2 for k in range(0, 140, 7)])
        assert furthest < found["alternating"] < 1.5 * furthest
    patterns = np.random.default_rng(2).normal(size=(3, 4))
    np.testing.assert_allclose(stress.of(patterns)(coordinates[:, :3]), stress(coordinates[:, :3] @ patterns))


INSTANTS = 40


@pytest.mark.parametrize("by_parts", [False, True])
def test_it_is_the_same_run(blade, spec, by_parts, monkeypatch):
    if by_parts:  # as with more interface nodes than the compiled loop has lanes
        monkeypatch.setattr(sampling, "_advance", sampling._advance_by_parts)
    run, sampled = simulate(blade, spec), sampling.simulate_sampled(blade, spec, INSTANTS)
    assert sampled.result.n_contact_steps == run.n_contact_steps > 0
    for name in ("wear", "radial_displacement", "revolution_peak", "revolution_amplitude"):
        np.testing.assert_array_equal(getattr(sampled.result, name), getattr(run, name))
    assert sampled.result.energy.residual == pytest.approx(run.energy.residual, abs=1e-9)
    assert not any("Literal" in str(kinds) for kinds in loop.integrate.signatures)  # compiled for both


def test_its_motion_is_that_of_a_recording(blade, spec):
    sampled = sampling.simulate_sampled(blade, spec, INSTANTS)
    elements = np.rint(sampled.time * spec.coating.n_elements).astype(int)
    assert len(elements) == INSTANTS * spec.revolutions
    recorded = record(blade, spec, Row.even(1), elements.tolist()).coordinates[:, 0]
    found = sampled.amplitudes @ sampled.patterns
    np.testing.assert_allclose(found, recorded, atol=1e-6 * np.abs(recorded).max())


def test_a_run_of_a_blade_of_matrices_tells_of_no_stress(tmp_path, blade, spec):
    path = tmp_path / "mesh.h5"
    cells = hdf5.Variable(("element", "corner"), np.zeros((0, 20), dtype=int), "1", "nodes of each element")
    hdf5.write(path, {"cells": cells}, {"made_from": "{}"})
    solver = StressSolver(path, last=1)
    (result,) = solver.simulate_longer(blade, spec, lambda result: 0)
    assert solver.stress is None
    np.testing.assert_array_equal(result.wear, simulate(blade, spec).wear)
    with pytest.raises(BadInput, match="the blade is of matrices alone"):
        BladeStress(path, blade)
