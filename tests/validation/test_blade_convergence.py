"""Frequencies of the default blade as its mesh is refined.

Expected order: eigenvalues of smooth modes converge with 2p = 4 for the quadratic element (Strang and Fix, An
Analysis of the Finite Element Method, 1973, chapter 6). Here the clamped root meets the free flanks at right
angles, where the stress is singular like r^(λ − 1), λ the root of sin²(λπ/2) = ((κ + 1)²/4 − λ²) / κ with
κ = 3 − 4ν (Williams, Journal of Applied Mechanics 19 (1952) 526-528), and in the end the order falls to
2λ = 1.4 for ν = 0.32. On the meshes in use it lies between the two. Convergence is from above.
"""

import numpy as np
import pytest
from free_vibration import frequencies
from scipy.optimize import brentq

from bladerub.blade.geometry import BladeShape
from bladerub.blade.mesh import BladeMesh
from bladerub.settings.blade import Mesh

pytestmark = pytest.mark.slow

FINENESS = np.array([0.5, 1.0, 1.5])  # over the config's mesh, in all three directions


def of_meshes(blade):
    """Frequencies f1 to f3 on each mesh, Hz."""
    shape = BladeShape.from_config(blade)
    rows = []
    for fineness in FINENESS:
        counts = {key: round(fineness * count) for key, count in blade.mesh.plain().items()}
        mesh = BladeMesh.from_shape(shape, Mesh(**counts))
        rows.append(frequencies(mesh.mesh, mesh.root, blade.material, 3))
    return np.array(rows)


def observed_order(coarse, middle, fine):
    """Exponent p of ``f = f_ext + c h^p`` through three meshes of unequal ratio."""
    h = 1 / FINENESS

    def misfit(p):
        return (h[0] ** p - h[1] ** p) * (middle - fine) - (h[1] ** p - h[2] ** p) * (coarse - middle)

    return brentq(misfit, 0.2, 6.0)


def test_frequencies_converge_at_the_order_of_the_clamped_edge_or_better_and_are_near_the_limit(paper_config):
    found = of_meshes(paper_config.blade)
    fine, finest = found[1:]
    order = np.array([observed_order(*mode) for mode in found.T])
    print("observed order of f1 to f3:", np.round(order, 2))
    assert min(order) > 1.4  # of the clamped edge
    limit = finest - (fine - finest) / (FINENESS[2] ** order - 1)  # Richardson
    print("config's mesh over the limit, f1 to f3:", fine / limit - 1)
    assert np.all(np.diff(found, axis=0) < 0)
    np.testing.assert_allclose(fine, limit, rtol=3e-3)
