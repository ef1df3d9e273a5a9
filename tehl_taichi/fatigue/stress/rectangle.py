"""Stresses in an elastic half-space from a uniform load on a rectangle or an endless strip of its surface.

The half-space is z >= 0, z into the body. Loads: pressure p > 0 and shear q_x, q_y (force per area on this body), so
sigma_zz = -p, tau_xz = -q_x, tau_yz = -q_y at z = 0. From the potentials of Boussinesq and Cerruti (Johnson, Contact
Mechanics, sections 2.5, 3.2 and 3.6; Love 1929; Liu & Wang 2002). No point may lie on the line of an edge.
"""

import numpy as np

SAME = 1e-6  # of a half side, by which edges of neighbours may differ


def _corners(F, x, y, a, b):
    """F summed over the corners of the rectangle |x| <= a, |y| <= b with alternating signs.

    Points of a grid whose cells are the rectangle share their corners: F is then evaluated once for each, not four times.
    """
    along_x, along_y = _edges(x, a), _edges(y, b)
    if along_x and along_y and along_x[1] != along_y[1]:
        (x, first), (y, second) = along_x, along_y
        return np.diff(np.diff(F(x, y), axis=first), axis=second)
    return F(x + a, y + b) - F(x + a, y - b) - F(x - a, y + b) + F(x - a, y - b)


def _edges(v, half):
    """(edges of rectangles around the places v, their axis counted from the last), if these are `2 half` apart along one axis;
    else None."""
    v = np.asarray(v)
    axes = [n - v.ndim for n in range(v.ndim) if v.shape[n] > 1]
    if len(axes) != 1 or np.abs(np.diff(v, axis=axes[0]) - 2 * half).max() > SAME * half:
        return None
    return np.concatenate([v.take([0], axes[0]) - half, v + half], axes[0]), axes[0]


def pressure_coefficients(x, y, a, b, nu):
    """(sxx, syy, sxy) at (x, y, 0) from unit pressure on |x| <= a, |y| <= b."""
    inside = (np.abs(x) < a) & (np.abs(y) < b)
    c = (1 - 2 * nu) / (2 * np.pi)
    sxx = -2 * nu * inside - c * _corners(lambda X, Y: np.arctan(Y / X), x, y, a, b)
    syy = -2 * nu * inside - c * _corners(lambda X, Y: np.arctan(X / Y), x, y, a, b)
    return sxx, syy, -c / 2 * _corners(lambda X, Y: np.log(X * X + Y * Y), x, y, a, b)


def shear_x_coefficients(x, y, a, b, nu):
    """(sxx, syy, sxy) at (x, y, 0) from unit q_x on |x| <= a, |y| <= b."""
    sxx = _corners(lambda X, Y: np.arcsinh(Y / np.abs(X)) + nu * Y / np.hypot(X, Y), x, y, a, b) / np.pi
    syy = _corners(lambda X, Y: np.arcsinh(Y / np.abs(X)) - Y / np.hypot(X, Y), x, y, a, b) * nu / np.pi
    sxy = _corners(lambda X, Y: np.arcsinh(X / np.abs(Y)) - 2 * nu * X / np.hypot(X, Y), x, y, a, b) / (2 * np.pi)
    return sxx, syy, sxy


def shear_y_coefficients(x, y, a, b, nu):
    """(sxx, syy, sxy) at (x, y, 0) from unit q_y: the q_x case with x and y exchanged."""
    syy, sxx, sxy = shear_x_coefficients(y, x, b, a, nu)
    return sxx, syy, sxy


def pressure_at_depth(x, y, z, a, b, nu):
    """(sxx, syy, szz, sxy, sxz, syz) at (x, y, z > 0) from unit pressure on |x| <= a, |y| <= b."""
    def rho(X, Y):
        return np.sqrt(X * X + Y * Y + z * z)

    phi_z = -_corners(lambda X, Y: np.arctan(X * Y / (z * rho(X, Y))), x, y, a, b)
    phi_xx = -_corners(lambda X, Y: X * Y / (rho(X, Y) * (X * X + z * z)), x, y, a, b)
    phi_yy = -_corners(lambda X, Y: X * Y / (rho(X, Y) * (Y * Y + z * z)), x, y, a, b)
    phi_xy = _corners(lambda X, Y: 1 / rho(X, Y), x, y, a, b)
    phi_xz = -_corners(lambda X, Y: z * Y / (rho(X, Y) * (X * X + z * z)), x, y, a, b)
    phi_yz = -_corners(lambda X, Y: z * X / (rho(X, Y) * (Y * Y + z * z)), x, y, a, b)
    psi_xx = _corners(lambda X, Y: np.arctan(Y / X) - np.arctan(z * Y / (X * rho(X, Y))), x, y, a, b)
    psi_yy = _corners(lambda X, Y: np.arctan(X / Y) - np.arctan(z * X / (Y * rho(X, Y))), x, y, a, b)
    psi_xy = _corners(lambda X, Y: np.log(rho(X, Y) + z), x, y, a, b)
    m = 1 - 2 * nu
    rows = (2 * nu * phi_z - z * phi_xx - m * psi_xx, 2 * nu * phi_z - z * phi_yy - m * psi_yy, phi_z + z * (phi_xx + phi_yy),
            -z * phi_xy - m * psi_xy, -z * phi_xz, -z * phi_yz)
    return tuple(row / (2 * np.pi) for row in rows)


def shear_x_at_depth(x, y, z, a, b, nu):
    """(sxx, syy, szz, sxy, sxz, syz) at (x, y, z > 0) from unit q_x on |x| <= a, |y| <= b."""
    def terms(X, Y):
        rho = np.sqrt(X * X + Y * Y + z * z)
        L_y, L_x = np.arcsinh(Y / np.sqrt(X * X + z * z)), np.arcsinh(X / np.sqrt(Y * Y + z * z))
        E, near = -z * Y / (rho * (X * X + z * z)), 1 / (rho + z)
        return np.array([2 * L_y + 2 * nu * Y * near + z * E + z * Y / rho * near,
                         2 * nu * L_y - 2 * nu * Y * near - z * Y / rho * near, -z * E,
                         L_x - 2 * nu * X * near - z * X / rho * near,
                         -np.arctan(X * Y / (z * rho)) + z * X * Y / (rho * (X * X + z * z)), -z / rho])

    return tuple(_corners(terms, x, y, a, b) / (2 * np.pi))


def shear_y_at_depth(x, y, z, a, b, nu):
    """Stress from unit q_y: the q_x case with x and y exchanged."""
    syy, sxx, szz, sxy, syz, sxz = shear_x_at_depth(y, x, z, b, a, nu)
    return sxx, syy, szz, sxy, sxz, syz


def strip_coefficient(x, a):
    """sxx at x from unit q_x on the endless strip |x| <= a (plane strain; pressure adds -p where it acts)."""
    return -2 / np.pi * np.log(np.abs((x + a) / (x - a)))


def strip(x, z, a):
    """Stresses of :func:`strip_at_depth`, also at the surface (z = 0)."""
    if z:
        return strip_at_depth(x, z, a)
    here, none = 1.0 * (np.abs(x) < a), np.zeros(x.shape)
    return (-here, -here, none), (strip_coefficient(x, a), none, -here)


def strip_at_depth(x, z, a):
    """((sxx, szz, sxz) from unit pressure, the same from unit q_x) at (x, z > 0) from the endless strip |x| <= a."""
    one, two = np.arctan2(z, x - a), np.arctan2(z, x + a)
    turn, sines, cosines = 2 * (one - two), np.sin(2 * one) - np.sin(2 * two), np.cos(2 * one) - np.cos(2 * two)
    logs = 2 * np.log(((x - a) ** 2 + z * z) / ((x + a) ** 2 + z * z))
    return ((-(turn + sines) / (2 * np.pi), -(turn - sines) / (2 * np.pi), cosines / (2 * np.pi)),
            ((logs - cosines) / (2 * np.pi), cosines / (2 * np.pi), -(turn + sines) / (2 * np.pi)))
