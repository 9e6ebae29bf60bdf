"""Stress of the rubbing blade at the nodes of its mesh: that of the rotation and of the vibration about it.

The first is that of the nonlinear equilibrium, the second linear in the displacement, as the reduced model
is. Both are found at the points where quadratic elements are most accurate (2×2×2 Gauss points of a
hexahedron, four points of a tetrahedron; Barlow 1976), extrapolated to the nodes of each element and averaged
over the elements that share a node. At sharp edges of the clamped root the stress depends on the mesh.
"""

import numpy as np
from scipy.interpolate import CubicSpline
from skfem import Basis
from skfem.quadrature import get_quadrature

from bladerub.blade.elasticity import lame
from bladerub.blade.mesh import MeshHexS2
from bladerub.extras.blade_meshes import solid_mesh
from bladerub.settings.blade import Material


class NodalStress:
    """Cauchy stress at the nodes of a mesh, in axes that turn with the vibrating material.

    `points` (n_nodes, 3) are at rest, m, `cells` (n_elements, 20 or 10) in the order of CalculiX and VTK; the
    `material` is St Venant-Kirchhoff's; `running` (n_nodes, 3) leads from rest to equilibrium at speed, m.
    """

    def __init__(self, points: np.ndarray, cells: np.ndarray, material: Material, running: np.ndarray):
        mesh, self._rows = solid_mesh(points, cells)
        self._material = material
        self._nodes = mesh.dofs.element_dofs.T  # (element, node)
        X, weights = get_quadrature(mesh.elem.refdom, 3 if isinstance(mesh, MeshHexS2) else 2)
        basis = Basis(mesh, mesh.elem(), quadrature=(X, weights))
        self._gradients = np.stack([np.moveaxis(np.asarray(b[0].grad), 0, -1) for b in basis.basis], axis=-2)
        corners = len(weights)  # as many as corners
        at_points, at_nodes = (_monomials(x, corners) for x in (X, mesh.elem().doflocs.T))
        self._to_nodes = at_nodes @ np.linalg.inv(at_points)  # (node, point)
        self._shared = np.bincount(self._nodes.ravel(), minlength=len(self._rows))
        gradient = self._gradient(running)
        self._F = np.eye(3) + gradient
        self._strain = _symmetric(gradient) + 0.5 * np.swapaxes(gradient, -1, -2) @ gradient

    def __call__(self, displacement: np.ndarray) -> np.ndarray:
        """Stress (n_nodes, 3, 3), Pa, at a displacement (n_nodes, 3), m, from `running`; NaN off elements."""
        lam, mu = lame(self._material)
        F_transposed = np.swapaxes(self._F, -1, -2)
        E = self._strain + _symmetric(F_transposed @ self._gradient(displacement))
        S = lam * np.trace(E, axis1=-2, axis2=-1)[..., None, None] * np.eye(3) + 2 * mu * E
        cauchy = self._F @ S @ F_transposed / np.linalg.det(self._F)[..., None, None]
        of_elements = np.einsum("aq,eqij->eaij", self._to_nodes, cauchy)
        total = np.zeros((len(self._rows), 3, 3))
        np.add.at(total, self._nodes, of_elements)
        stress = np.full((len(displacement), 3, 3), np.nan)
        stress[self._rows] = total / self._shared[:, None, None]
        return stress

    def _gradient(self, displacement: np.ndarray) -> np.ndarray:
        u = displacement[self._rows][self._nodes]
        return np.einsum("eai,eqaj->eqij", u, self._gradients, optimize=True)


def _symmetric(tensor: np.ndarray) -> np.ndarray:
    return 0.5 * (tensor + np.swapaxes(tensor, -1, -2))


def von_mises(stress: np.ndarray) -> np.ndarray:
    """Von Mises stress (...) of stress tensors (..., 3, 3), in their unit."""
    deviator = stress - np.trace(stress, axis1=-2, axis2=-1)[..., None, None] / 3 * np.eye(3)
    return np.sqrt(1.5 * np.sum(deviator**2, axis=(-2, -1)))


def running_displacement(f_omega: np.ndarray, static: np.ndarray, speed: float) -> np.ndarray:
    """Centrifugal displacement (n_nodes, 3) at `speed`, m, between `static` (n_speeds, n_nodes, 3)."""
    return CubicSpline(f_omega**2, static, axis=0)(speed**2)  # nearly proportional to the square of the speed


def _monomials(x: np.ndarray, corners: int) -> np.ndarray:
    """Terms of the interpolation between the corners at the points x (3, n): eight, or four."""
    a, b, c = x
    terms = [np.ones_like(a), a, b, c, a * b, b * c, c * a, a * b * c]
    return np.stack(terms[:corners], axis=1)
