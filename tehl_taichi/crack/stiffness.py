"""Elastic energy of a crack by its nodal openings: a symmetric, positive matrix (Galerkin's method with dislocations).

The energy is the work between all pairs of jumps along the path. The kernel is singular where both coincide (a logarithm, and
at a kink a value that depends on the direction). So neighbouring elements use special integration points (after Duffy 1982).
"""

import numpy as np

from tehl_taichi.crack.dislocations import work
from tehl_taichi.crack.elements import GAUSS, gauss

CORNER, DIAGONAL, POWER = 6, 8, 3  # points along and across a triangle of touching elements; they crowd with this power


def stiffness(elements, E_star):
    """Stiffness matrix (2 nodes, 2 nodes), N/m^2, by x and z of the nodal openings over sqrt(length)."""
    count = elements.lengths.size
    pairs = np.zeros((2, count + 1, count + 1), complex)
    _add_distant(elements, pairs)
    x, y, w, between = _triangles()
    k = np.arange(count)
    _add(elements, pairs, k[:-1], k[1:], 1 - x, y, w)
    pairs += np.stack([pairs[0].conj().T, pairs[1].T])  # what the later element does to the earlier one
    _add(elements, pairs, k[:-1], k[:-1], x, y, w, between)
    _add(elements, pairs, k[-1:], k[-1:], 1 - x, 1 - y, w, -between)  # the tip is a corner, too
    A, B = pairs
    return -E_star / (8 * np.pi) * np.block([[(A - B).real, -(A + B).imag], [(A - B).imag, (A + B).real]])


def _triangles():
    """Integration points (x, y), weights and x - y on the unit square, dense at the corner (0, 0) and along the diagonal."""
    (t, wt), (e, we) = gauss(CORNER), gauss(DIAGONAL)
    far, far_w = t**POWER, POWER * t ** (POWER - 1) * wt
    off, off_w = e**POWER, POWER * e ** (POWER - 1) * we
    x, y = np.repeat(far, e.size), np.outer(far, 1 - off).ravel()
    w, between = np.outer(far_w * far, off_w).ravel(), np.outer(far, off).ravel()
    return np.concatenate([x, y]), np.concatenate([y, x]), np.tile(w, 2), np.concatenate([between, -between])


def _add_distant(elements, pairs):
    """Add the work between elements that are not neighbours, at the products of their Gauss points."""
    xi, w = gauss(GAUSS)
    i, j = np.triu_indices(elements.lengths.size, 2)
    x, y = np.repeat(xi, GAUSS), np.tile(xi, GAUSS)
    _add(elements, pairs, i, j, x, y, np.outer(w, w).ravel())


def _add(elements, pairs, i, j, x, y, w, between=None):
    """Add the work between elements i and j, at points x and y of them, to both matrices `pairs`.

    between: x - y, if i and j are one element.
    """
    u, z, _, slopes = elements.at(i[:, None], x)
    u0, z0, _, slopes0 = elements.at(j[:, None], y)
    d = None
    if between is not None:  # s - s0 = -(u - u0)(u + u0)
        d = -elements.direction[i][:, None] * np.diff(elements.u)[i][:, None] * between * (u + u0)
    kernels = [w * kernel for kernel in work(z, z0, d)]
    for p, slope in enumerate(slopes):
        for q, slope0 in enumerate(slopes0):
            both = slope * slope0
            for matrix, kernel in zip(pairs, kernels):
                np.add.at(matrix, (i + p, j + q), (kernel * both).sum(axis=1))
