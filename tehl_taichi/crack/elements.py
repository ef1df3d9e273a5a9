"""Elements of a crack path: the opening is sqrt(a - s) times a polygon (s: length from the mouth, a: length of the path).

So the nodal value at the tip is the stress intensity, and the opening is nowhere negative if no nodal value is. In u = sqrt(a -
s) all functions of an element are polynomials. The elements shrink towards the mouth, every kink and the tip.
"""

import numpy as np

LEAST = 4        # a straight piece has at least this part of the elements of a whole crack
STRAIGHT = 1e-9  # rad: a smaller turn is no kink
GAUSS = 4        # points of an element: 1e-5 of K


def gauss(count):
    """Gauss points and weights on 0..1."""
    x, w = np.polynomial.legendre.leggauss(count)
    return (x + 1) / 2, w / 2


def without_straight(points):
    """Path (complex points, m) without the points at which it does not turn."""
    points = np.asarray(points, complex)
    turn = np.abs(np.angle(np.diff(points)[1:] / np.diff(points)[:-1]))
    return points[np.concatenate([[True], turn > STRAIGHT, [True]])]


class Elements:
    """Elements of a path (complex points, m, from the mouth to the tip), about `count` of them.

    s: (nodes,) length from the mouth, m; a: length of the path; lengths: of the elements; direction: (elements,) unit complex
    numbers.
    """

    def __init__(self, path, count):
        self.path = without_straight(path)
        steps = np.diff(self.path)
        starts = np.concatenate([[0.0], np.cumsum(np.abs(steps))])
        self.a = starts[-1]
        shares = [max(count // LEAST, int(np.ceil(count * abs(step) / self.a))) for step in steps]
        piece = np.repeat(np.arange(steps.size), shares)
        self.s = np.concatenate([[0.0]] + [start + abs(step) * _graded(m) for start, step, m in zip(starts, steps, shares)])
        self.s[-1] = self.a
        self.lengths, self.u = np.diff(self.s), np.sqrt(np.maximum(self.a - self.s, 0.0))
        self.direction = (steps / np.abs(steps))[piece]
        self.origin, self.offset = self.path[piece], starts[piece]

    def at(self, k, xi):
        """Values in elements k at xi = 0..1 in u: u, z, both shape functions (without u) and their d/dxi (with it)."""
        turn = np.diff(self.u)[k]
        u = self.u[k] + turn * xi
        s = self.a - u * u
        second, bend = (s - self.s[k]) / self.lengths[k], 2 * u * u / self.lengths[k]
        z = self.origin[k] + self.direction[k] * (s - self.offset[k])
        z = z.real + 1j * np.maximum(z.imag, 0.0)  # rounding at the mouth
        return u, z, (1 - second, second), ((1 - second + bend) * turn, (second - bend) * turn)

    def points(self):
        """Values at the Gauss points of all elements: z, direction, length that each stands for, and two matrices (points,
        nodes): weighted jump and weighted opening by nodal values.
        """
        xi, w = gauss(GAUSS)
        k = np.arange(self.lengths.size)[:, None]
        u, z, shapes, slopes = self.at(k, xi)
        length = 2 * u * np.abs(np.diff(self.u))[:, None] * w
        jump, load = np.zeros((2, z.size, self.s.size))
        rows, first = np.arange(z.size), np.repeat(k.ravel(), GAUSS)
        for side in (0, 1):
            jump[rows, first + side] = (slopes[side] * w).ravel()
            load[rows, first + side] = (u * shapes[side] * length).ravel()
        return z.ravel(), np.repeat(self.direction, GAUSS), length.ravel(), jump, load


def _graded(count):
    """Ends of `count` elements on 0..1, denser towards both sides."""
    return (1 - np.cos(np.pi * np.arange(1, count + 1) / count)) / 2
