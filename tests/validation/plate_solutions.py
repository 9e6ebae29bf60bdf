"""Cantilevers, straight, twisted or curved: their elements, and their frequencies by a Ritz method.

The displacements are products of Legendre polynomials over the whole plate, in three dimensions, so the
method shares Hooke's law with the finite elements and nothing else: no element, no mesh, no quadrature of
theirs. Its frequencies fall towards the exact ones as terms are added.
"""

import numpy as np
from numpy.polynomial import Legendre
from scipy.linalg import eigh

from bladerub.blade.elasticity import Solid, lame
from bladerub.blade.mesh import hexahedral_mesh
from bladerub.settings.blade import Material


def isotropic(young, poisson, density):
    return Material.model_construct(young_modulus=young, poisson_ratio=poisson, density=density)


def clamped(points, counts, material, grading=1.0):
    """Hexahedra (chordwise, spanwise) of what `points` makes of the cube, clamped at ζ = 0."""
    across, along = (np.linspace(0, 1, count + 1) for count in counts)
    mesh, cube = hexahedral_mesh(across, np.array([0.0, 1.0]), along**grading, points)
    return Solid(mesh, material, np.flatnonzero(cube[2] == 0))


def straight(size, foot=0.0):
    """Map the unit cube to a box along z, about the axis of x and y, from the height `foot` on."""
    size, shift = np.array(size)[:, None], np.array([[0.5], [0.5], [0.0]])
    return lambda *cube: (np.stack(cube) - shift) * size + np.array([[0.0], [0.0], [foot]])


def twisted(length, chord, thickness, degrees):
    """Map the unit cube to a plate along z whose sections turn about z in proportion to z."""

    def points(xi, eta, zeta):
        turn = np.deg2rad(degrees) * zeta
        along, across = chord * (xi - 0.5), thickness * (eta - 0.5)
        x, y = along * np.cos(turn) - across * np.sin(turn), along * np.sin(turn) + across * np.cos(turn)
        return np.stack([x, y, length * zeta])

    return points


def curved(length, arc, thickness, radius):
    """Map the unit cube to a plate along z whose sections are arcs of a circle."""

    def points(xi, eta, zeta):
        angle, r = arc / radius * (xi - 0.5), radius + thickness * (eta - 0.5)
        return np.stack([r * np.sin(angle), r * np.cos(angle), length * zeta])

    return points


def plate_unit(material, thickness, length):
    """√(D / ρh) / a², rad/s, in which frequencies of plates of length a are tabulated."""
    rigidity = material.young_modulus * thickness**3 / (12 * (1 - material.poisson_ratio**2))
    return np.sqrt(rigidity / (material.density * thickness)) / length**2


def ritz(points, material, n_modes, terms=(9, 3, 11)):
    """Lowest frequencies (n_modes,), Hz, of the body that `points` makes of the cube, clamped at ζ = 0.

    Minimises the elastic over the kinetic energy with `terms` polynomials along ξ, η and ζ, those along ζ
    times ζ; the Jacobian is that of `points` by differences, the integrals are Gauss's.
    """
    rules = [_shapes(n, power) for n, power in zip(terms, (0, 0, 1), strict=True)]
    cube = np.stack([axis.ravel() for axis in np.meshgrid(*(rule[0] for rule in rules), indexing="ij")])
    weight = np.einsum("i,j,k->ijk", *(rule[1] for rule in rules)).ravel()
    jacobian = np.stack([_slope(points, cube, axis) for axis in range(3)], axis=1).transpose(2, 0, 1)

    def products(*orders):
        factors = (rule[2][order] for rule, order in zip(rules, orders, strict=True))
        return np.einsum("ia,jb,kc->ijkabc", *factors).reshape(weight.size, -1)

    on_cube = np.stack([products(1, 0, 0), products(0, 1, 0), products(0, 0, 1)])
    gradient = np.einsum("dqn,qdi->iqn", on_cube, np.linalg.inv(jacobian))
    volume = (weight * np.linalg.det(jacobian))[:, None]
    shape = products(0, 0, 0)
    product = np.array([[(left * volume).T @ right for right in gradient] for left in gradient])
    first, shear = lame(material)
    stiffness = first * product + shear * product.swapaxes(0, 1)
    stiffness[range(3), range(3)] += shear * np.trace(product)
    mass = material.density * np.kron(np.eye(3), (shape * volume).T @ shape)
    blocks = np.block([list(row) for row in stiffness])
    squares = eigh(blocks, mass, eigvals_only=True, subset_by_index=[0, n_modes - 1])
    return np.sqrt(squares) / (2 * np.pi)


def beam_ritz(speed, hub_radius=0.0):
    """Flapwise frequencies of the rotating Euler-Bernoulli beam, dimensionless.

    Minimises ∫ w″² + T w′² over ∫ w² with T = η² (δ (1 − x) + (1 − x²) / 2), hub radius δ L.
    """
    x, weight, (w, slope, bend) = _shapes(16, 2)
    tension = speed**2 * (hub_radius * (1 - x) + (1 - x**2) / 2)
    stiffness = (bend.T * weight) @ bend + (slope.T * weight * tension) @ slope
    return np.sqrt(eigh(stiffness, (w.T * weight) @ w, eigvals_only=True))


def _shapes(n_terms, power):
    """Give Gauss's points and weights on [0, 1], and the terms, times x to a power, and derivatives there."""
    x, weight = np.polynomial.legendre.leggauss(n_terms + 4)
    x, weight = (x + 1) / 2, weight / 2
    clamp = Legendre([0.5, 0.5], [0, 1]) ** power
    terms = [clamp * Legendre.basis(k, [0, 1]) for k in range(n_terms)]
    return x, weight, [np.stack([term.deriv(order)(x) for term in terms], axis=1) for order in (0, 1, 2)]


def _slope(points, cube, axis, step=1e-4):
    """Derivative (3, n) of `points` along one axis of the cube, to the fourth order."""
    shift = step * np.eye(3)[:, [axis]]
    near, far = (points(*(cube + k * shift)) - points(*(cube - k * shift)) for k in (1, 2))
    return (8 * near - far) / (12 * step)
