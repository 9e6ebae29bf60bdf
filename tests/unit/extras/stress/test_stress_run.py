import numpy as np

from bladerub.contact.run import simulate
from bladerub.extras.stress.run import StressSolver
from bladerub.io import hdf5


def test_a_run_of_a_blade_of_matrices_tells_of_no_stress(tmp_path, blade, spec):
    path = tmp_path / "mesh.h5"
    cells = hdf5.Variable(("element", "corner"), np.zeros((0, 20), dtype=int), "1", "nodes of each element")
    hdf5.write(path, {"cells": cells}, {"made_from": "{}"})
    solver = StressSolver(path, last=1)
    result = solver(blade, spec)
    assert solver.stress is None
    np.testing.assert_array_equal(result.wear, simulate(blade, spec).wear)
