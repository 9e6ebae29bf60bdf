"""Total-Lagrangian elasticity of a St Venant-Kirchhoff solid: mass, internal force and tangent stiffness.

With the displacement gradient ∇u, F = I + ∇u, E = (FᵀF − I)/2 and S = λ tr(E) I + 2μ E, all on the body at
rest, the virtual work and its linearisation are

    r(u; v)     = ∫ S : δE(v),                                 δE(v) = sym(Fᵀ∇v)
    k(u; v, w)  = ∫ δE(v) : C : δE(w) + ∫ S : (∇vᵀ∇w)          (material + geometric)

scikit-fem gives the isoparametric map, the gradients of the shape functions at the integration points and the
numbering; the integrals of `k` are formed for all shape functions of an element at once, because the
tangent is needed dozens of times and a form evaluated pair by pair costs ten times as much.
"""

from concurrent.futures import ThreadPoolExecutor
from functools import cached_property

import numpy as np
from scipy import sparse
from skfem import Basis, ElementVector
from skfem.models.poisson import mass

from bladerub.blade.mesh import FreeCoordinates, SolidMesh
from bladerub.settings.blade import Material

_CHUNK = 512  # elements integrated at once: bounds the memory on fine meshes
_THREADS = 2  # each integrates chunks of its own, so their number changes no bit


def lame(material: Material) -> tuple[float, float]:
    """Return the Lamé parameters λ and μ of an isotropic material, Pa."""
    young, poisson = material.young_modulus, material.poisson_ratio
    return young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))


class Solid(FreeCoordinates):
    """Finite element model of an elastic body; vectors and matrices hold its free coordinates only.

    ``mass`` (n, n) is the consistent mass matrix, kg; ``first_moment`` (n,) is ∫ ρ X · v for every v, with X
    the position at rest, kg m.
    """

    def __init__(self, mesh: SolidMesh, material: Material, clamped=()):
        super().__init__(mesh.doflocs.shape[1], clamped)
        self.mesh = mesh
        self.material = material
        scalar = Basis(mesh, mesh.elem(), quadrature=mesh.quadrature())
        dofs = Basis(mesh, ElementVector(mesh.elem()), quadrature=(scalar.X[:, :1], scalar.W[:1]))
        self._weights = scalar.dx  # (element, point)
        self._gradients = np.stack([np.moveaxis(np.asarray(b[0].grad), 0, -1) for b in scalar.basis], axis=-2)
        self._dofs = dofs.element_dofs.T  # (element, 3 n_nodes), node by node as in `_gradients`
        self._pattern = _Pattern(self._dofs, self.free, 3 * self.n_nodes)
        products = mass.assemble(Basis(mesh, mesh.elem(), quadrature=mesh.mass_quadrature()))
        of_all = sparse.kron(products, sparse.eye_array(3), format="csc") * material.density
        self.mass = sparse.csc_array(of_all[self.free][:, self.free])
        self.first_moment = (of_all @ mesh.points.ravel())[self.free]

    def internal_force(self, u: np.ndarray) -> np.ndarray:
        """Evaluate r(u; v) for every v: the internal force (n,) at the displacement `u`, N."""
        F = self.deformation_gradient(u)
        first_piola = F @ self._stress(F) * self._weights[..., None, None]
        force = np.einsum("eqij,eqaj->eai", first_piola, self._gradients, optimize=True)
        total = np.bincount(self._dofs.ravel(), weights=force.ravel(), minlength=3 * self.n_nodes)
        return total[self.free]

    def tangent(self, u: np.ndarray) -> sparse.csc_array:
        """Evaluate k(u; v, w) for every v, w: the tangent stiffness (n, n), symmetric, N/m."""
        displacement = self._element_displacement(u)
        size = self._dofs.shape[1]
        elements = np.empty((len(self._dofs), size, size))

        def integrate(start: int) -> None:
            part = slice(start, start + _CHUNK)
            elements[part] = self._element_tangents(part, displacement[part])

        with ThreadPoolExecutor(_THREADS) as pool:
            list(pool.map(integrate, range(0, len(elements), _CHUNK)))  # raises their errors
        return self._pattern.assemble(elements)

    @cached_property
    def spinning_mass(self) -> np.ndarray:
        """Mass of motion along y and z at each entry of `tangent`, kg: what the rotation acts on."""
        return self._pattern.values_of(self.mass * (self.axis != 0))  # columns: mass couples no two axes

    def deformation_gradient(self, u: np.ndarray) -> np.ndarray:
        """Evaluate F (n_elements, n_points, 3, 3) at the integration points."""
        return _deformation_gradient(self._gradients, self._element_displacement(u))

    def _element_displacement(self, u: np.ndarray) -> np.ndarray:
        return self.full(u).ravel()[self._dofs].reshape(len(self._dofs), -1, 3)

    def _stress(self, F: np.ndarray) -> np.ndarray:
        """Second Piola-Kirchhoff stress S (element, point, 3, 3), Pa."""
        lam, mu = lame(self.material)
        E = 0.5 * (np.swapaxes(F, -1, -2) @ F - np.eye(3))
        return lam * np.trace(E, axis1=-2, axis2=-1)[..., None, None] * np.eye(3) + 2 * mu * E

    def _element_tangents(self, part: slice, displacement: np.ndarray) -> np.ndarray:
        lam, mu = lame(self.material)
        gradients, weights = self._gradients[part], self._weights[part]
        F = _deformation_gradient(gradients, displacement)
        S = self._stress(F)
        n_elements, n_points, n_nodes, _ = gradients.shape
        Fv = np.einsum("eqiI,eqaJ->eqIJai", F, gradients, optimize=True).reshape(
            n_elements, n_points, 3, 3, 3 * n_nodes
        )
        dE = 0.5 * (Fv + np.swapaxes(Fv, 2, 3))  # δE of each shape function
        root = np.sqrt(weights)
        volumetric = np.sqrt(lam) * root[..., None] * np.trace(dE, axis1=2, axis2=3)
        dE *= np.sqrt(2 * mu) * root[..., None, None, None]
        dE = dE.reshape(n_elements, n_points * 9, 3 * n_nodes)
        material = np.swapaxes(dE, 1, 2) @ dE + np.swapaxes(volumetric, 1, 2) @ volumetric  # ∫ δE : C : δE
        Sg = np.einsum("eqIJ,eqbJ->eqIb", S * weights[..., None, None], gradients, optimize=True)
        flat = np.swapaxes(gradients, 2, 3).reshape(n_elements, n_points * 3, n_nodes)
        geometric = np.swapaxes(flat, 1, 2) @ Sg.reshape(n_elements, n_points * 3, n_nodes)  # ∫ S : (∇vᵀ∇w)
        blocks = material.reshape(n_elements, n_nodes, 3, n_nodes, 3)
        for axis in range(3):
            blocks[:, :, axis, :, axis] += geometric
        return material


def _deformation_gradient(gradients: np.ndarray, displacement: np.ndarray) -> np.ndarray:
    return np.eye(3) + np.einsum("eai,eqaj->eqij", displacement, gradients, optimize=True)


class _Pattern:
    """Where the entries of the element matrices go in a sparse matrix (n, n) of the free coordinates."""

    def __init__(self, dofs: np.ndarray, free: np.ndarray, n_all: int):
        self._n = free.size
        number = np.full(n_all, -1)
        number[free] = np.arange(self._n)
        row, column = number[dofs][:, :, None], number[dofs][:, None, :]
        clamped = (row < 0) | (column < 0)
        # of each entry, column by column; what is clamped goes behind the last
        keys, target = np.unique(np.where(clamped, self._n**2, column * self._n + row), return_inverse=True)
        self._target = target.ravel()
        self._keys = keys[: np.searchsorted(keys, self._n**2)]
        self._rows = (self._keys % self._n).astype(np.int32)
        self._starts = np.searchsorted(self._keys, self._n * np.arange(self._n + 1)).astype(np.int32)

    def assemble(self, elements: np.ndarray) -> sparse.csc_array:
        values = np.bincount(self._target, weights=elements.ravel(), minlength=self._keys.size)
        values = values[: self._keys.size]
        return sparse.csc_array((values, self._rows, self._starts), shape=(self._n, self._n))

    def values_of(self, matrix: sparse.sparray) -> np.ndarray:
        """Values of a `matrix` with some of these entries at each of them, 0 where it has none."""
        entries, values = sparse.coo_array(matrix), np.zeros(self._keys.size)
        column, row = entries.col.astype(np.int64), entries.row
        values[np.searchsorted(self._keys, column * self._n + row)] = entries.data
        return values
