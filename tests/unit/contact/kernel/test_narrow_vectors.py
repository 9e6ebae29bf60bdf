"""The same run on processors with shorter vectors, with and without fused products and sums."""

import os
import pickle
import platform
import subprocess
import sys

import numpy as np
import pytest

from bladerub.contact.run import simulate

pytestmark = [pytest.mark.slow, pytest.mark.nightly]

CHILD = """
import pickle, sys
from bladerub.contact.run import simulate
with open(sys.argv[1], "rb") as file:
    blade, spec = pickle.load(file)
result = simulate(blade, spec)
with open(sys.argv[2], "wb") as file:
    pickle.dump(result, file)
"""


# "generic" has 128 bits, on x86-64 and on ARM
PROCESSORS = ["generic", "haswell"] if platform.machine() == "x86_64" else ["generic"]


@pytest.mark.parametrize("processor", PROCESSORS)
def test_short_vectors_give_the_same_run(blade, spec, change, tmp_path, processor):
    spec = change(spec, E=2.0, K=0.5, theta=0.15, revolutions=2)
    with open(tmp_path / "input", "wb") as file:
        pickle.dump((blade, spec), file)
    environment = os.environ | {
        "NUMBA_CPU_NAME": processor,
        "NUMBA_CPU_FEATURES": "",
        "NUMBA_CACHE_DIR": str(tmp_path),
    }
    command = [sys.executable, "-c", CHILD, tmp_path / "input", tmp_path / "output"]
    subprocess.run(command, env=environment, check=True)
    with open(tmp_path / "output", "rb") as file:
        narrow = pickle.load(file)
    wide = simulate(blade, spec)
    assert wide.n_contact_steps == narrow.n_contact_steps > 1000
    for name in ("wear", "radial_displacement", "revolution_peak"):
        expected = getattr(wide, name)
        np.testing.assert_allclose(
            getattr(narrow, name), expected, rtol=0, atol=1e-10 * np.abs(expected).max()
        )
