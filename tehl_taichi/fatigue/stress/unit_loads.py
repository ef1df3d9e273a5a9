"""Stresses by unit loads on one rectangle of a surface, by component, and their symmetries. Loads p, q_x, q_y and components
xx, yy, zz, xy, xz, yz are numbered.
"""

import numpy as np

from tehl_taichi.fatigue.stress import rectangle

BELOW = (rectangle.pressure_at_depth, rectangle.shear_x_at_depth, rectangle.shear_y_at_depth)
SURFACE = (rectangle.pressure_coefficients, rectangle.shear_x_coefficients, rectangle.shear_y_coefficients)
HELD = (0, 1, 3)  # xx, yy, xy: components at the surface that a load also causes elsewhere
CARRIED = (2, 4, 5)  # zz, xz, yz: components at the surface that are minus the loads p, q_x and q_y
SIGNS = (1, 1, -1)  # signs of p, q_x and q_y in the mirror image about the first row
TURNED = (3, 4)  # xy, xz: by p and q_y odd along x, by q_x even; the other components: by p and q_y even, by q_x odd
ACROSS = np.array([1, 1, 1, -1, 1, -1])  # signs of the components in the mirror image, by p and q_x (by q_y: minus these)


def along(load):
    """Signs (6,) of the components at -x, by a load (its number)."""
    signs = np.ones(6)
    signs[list(TURNED)] = -1.0
    return -signs if load == 1 else signs


def unit_load(load, x, y, depth, sides):
    """Stresses (6, lags, rows) Pa at (x, y, depth) m by a load of 1 Pa on one rectangle; load: its number; sides: both half
    sides (m), and nu."""
    if depth:
        return np.array(BELOW[load](x, y, depth, *sides))
    out = np.zeros((6, *np.broadcast_shapes(x.shape, y.shape)))
    out[list(HELD)] = SURFACE[load](x, y, *sides)
    out[CARRIED[load]] = -1.0 * ((np.abs(x) < sides[0]) & (np.abs(y) < sides[1]))
    return out


def wrapped(values, size, signs):
    """One period (size, ...) of values (lags from 0, ...), lag 0 first; signs: of the values at negative lags."""
    out, lags = np.zeros((size, *values.shape[1:]), values.dtype), len(values)
    out[:lags], out[size - lags + 1 :] = values, signs * values[:0:-1]
    return out
