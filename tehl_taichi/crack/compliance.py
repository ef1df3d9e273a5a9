"""Faces of one crack: opening, slip and stress intensities under given stresses.

The normal n points to the left on the way from the mouth to the tip. Opening and slip are displacements of the left face
relative to the right one. Openings are sqrt(distance to the tip) times nodal values (sqrt(m)). At a kink the faces may touch on
both sides of it: two contacts. Their own friction is left out (one point); the nodal normal there halves the angle.
"""

import numpy as np

from tehl_taichi.crack.dislocations import stresses
from tehl_taichi.crack.elements import Elements
from tehl_taichi.crack.stiffness import stiffness


class CrackFaces:
    """A crack along `path` (complex points, m, from the mouth to the tip) with about `count` elements.

    E_star: E/(1 - nu^2), Pa. compliance: (2 nodes, 2 nodes) nodal values by nodal forces (first normal, then tangential, from
    the mouth to the tip). points: (p,) where :meth:`forces` needs the stresses. contact: (contacts + rough, 2 nodes) opening of
    every contact by nodal values, then slip of the first `rough` contacts, which have friction; the last of these is the tip.
    """

    def __init__(self, path, E_star, count):
        elements = Elements(path, count)
        self.E_star, self.a, self.nodes = E_star, elements.a, elements.s.size
        self.points, self.direction, self.length, self.jump, self.load = elements.points()
        normal = _normals(elements.direction)
        self.turn = _turn(normal)
        self.contact, self.rough = _contacts(elements.direction, normal)
        self.compliance = np.linalg.inv(self.turn.T @ stiffness(elements, E_star) @ self.turn)

    def forces(self, stress):
        """Nodal forces (2 nodes, moments) of stresses (p, moments, 3) xx, zz, xz of the body without the crack."""
        n = 1j * self.direction[:, None]
        x = stress[..., 0] * n.real + stress[..., 2] * n.imag
        z = stress[..., 2] * n.real + stress[..., 1] * n.imag
        return self.turn.T @ np.concatenate([self.load.T @ x, self.load.T @ z])

    def opening(self):
        """Matrix (points, 2 nodes): opening at the points (m) by nodal values."""
        n = 1j * self.direction[:, None] / self.length[:, None]
        return np.concatenate([self.load * n.real, self.load * n.imag], axis=1) @ self.turn

    def pushed(self):
        """Nodal forces (2 nodes,) of unit pressure on both faces; by nodal values these are also the volume of the crack."""
        return self.length @ self.opening()

    def parts(self, count):
        """Divide the crack into `count` parts from the mouth on. Returns the part number of every point, (points,)."""
        return np.arange(self.points.size) * count // self.points.size

    def intensities(self, values):
        """K_I and K_II (2, ...), Pa sqrt(m), of nodal values (2 nodes, ...)."""
        return self.E_star / 8 * np.sqrt(2 * np.pi) * values[[self.nodes - 1, -1]]

    def around(self, points):
        """Matrix (3, points, 2 nodes): stresses xx, zz, xz in the body by nodal values.

        The sign follows from the definition: a dislocation is the end of an opening.
        """
        z, z0 = np.asarray(points)[:, None], self.points
        by_x, by_z = ([part @ self.jump for part in stresses(z, z0, -unit, self.E_star)] for unit in (1.0, 1j))
        return np.concatenate([by_x, by_z], axis=2) @ self.turn


def _normals(direction):
    """Normals at the nodes: (nodes,) unit complex numbers."""
    both = np.concatenate([direction[:1], direction]) + np.concatenate([direction, direction[-1:]])
    return 1j * both / np.abs(both)


def _contacts(direction, normal):
    """Contact rows (see :class:`CrackFaces`) and the number of contacts with friction."""
    nodes, eye = normal.size, np.eye(2 * normal.size)
    kinks = 1 + np.flatnonzero(direction[1:] != direction[:-1])
    plain = np.setdiff1d(np.arange(nodes), kinks)
    before, after = ((1j * direction[kinks - side] / normal[kinks])[:, None] for side in (1, 0))
    both = [n.real * eye[kinks] - n.imag * eye[nodes + kinks] for n in (before, after)]
    return np.concatenate([eye[plain], *both, eye[nodes + plain]]), plain.size


def _turn(normal):
    """Matrix (2 nodes, 2 nodes) from normal and tangential nodal values to their x and z parts."""
    tangent = -1j * normal
    return np.block([[np.diag(normal.real), np.diag(tangent.real)], [np.diag(normal.imag), np.diag(tangent.imag)]])
