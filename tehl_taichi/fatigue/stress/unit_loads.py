"""Stresses by unit loads on one rectangle of a surface, by component, and their symmetries. Loads p, q_x, q_y and components
xx, yy, zz, xy, xz, yz are numbered.
"""

import numpy as np

from tehl_taichi.fatigue.stress import rectangle

BELOW = (rectangle.pressure_at_depth, rectangle.shear_x_at_depth, rectangle.shear_y_at_depth)
SURFACE = (rectangle.pressure_coefficients, rectangle.shear_x_coefficients, rectangle.shear_y_coefficients)
HELD = (0, 1, 3)  # what the surface answers elsewhere, too
CARRIED = (2, 4, 5)  # zz, xz, yz: at the surface the loads p, q_x and q_y themselves
SIGNS = (1, 1, -1)  # of p, q_x and q_y in the mirror image about the first row
TURNED = (3, 4)  # xy, xz: odd along x where the others are even (of q_x: even, where the others are odd)
ACROSS = np.array([1, 1, 1, -1, 1, -1])  # of the components on the other side across (of q_y: the other way round)


def along(load):
    """Signs (6,) of the components at the mirrored x."""
    signs = np.ones(6)
    signs[list(TURNED)] = -1.0
    return -signs if load == 1 else signs


def unit_load(load, x, y, depth, sides):
    """Stresses (6, lags, rows) at (x, y, depth) by a unit load on one rectangle; sides: half of each (m), and nu."""
    if depth:
        return np.array(BELOW[load](x, y, depth, *sides))
    out = np.zeros((6, *np.broadcast_shapes(x.shape, y.shape)))
    out[list(HELD)] = SURFACE[load](x, y, *sides)
    out[CARRIED[load]] = -1.0 * ((np.abs(x) < sides[0]) & (np.abs(y) < sides[1]))
    return out


def wrapped(values, size, signs):
    """Values (lags from 0, ...) as one period, lag 0 first; signs: of the mirrored values."""
    out, lags = np.zeros((size, *values.shape[1:]), values.dtype), len(values)
    out[:lags], out[size - lags + 1 :] = values, signs * values[:0:-1]
    return out
