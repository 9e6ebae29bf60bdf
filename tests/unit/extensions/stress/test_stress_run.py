import numpy as np

from bladerub.extensions.stress.run import run_stress
from bladerub.io import hdf5


def test_a_blade_of_matrices_tells_of_no_stress(tmp_path):
    path = tmp_path / "mesh.h5"
    cells = hdf5.Variable(("element", "corner"), np.zeros((0, 20), dtype=int), "1", "nodes of each element")
    hdf5.write(path, {"cells": cells}, {"made_from": "{}"})
    assert run_stress(path, None, _Spec(), last=1) is None


class _Spec:
    f_omega, revolutions = 0.3, 2
