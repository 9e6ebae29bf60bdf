import numpy as np
import pytest

from bladerub import plugins
from bladerub.contact.kernel import loop
from bladerub.contact.run import simulate
from bladerub.extras.export.recording import record
from bladerub.extras.rows.spec import Row
from bladerub.extras.stress import sampling
from bladerub.extras.stress import table as stress_table
from bladerub.extras.stress.run import StressSolver
from bladerub.io import hdf5
from bladerub.io.tables import described_columns

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
    result = solver(blade, spec)
    assert solver.stress is None
    assert {*stress_table.COLUMNS} <= described_columns(*plugins.files("columns.csv")).keys()
    np.testing.assert_array_equal(result.wear, simulate(blade, spec).wear)
