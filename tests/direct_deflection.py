"""The deflection of a whole grid from the exact coefficients, by numpy's transforms: what kernels are compared with."""

import numpy as np

from tehl_taichi.pressure import influence


def deflected(P, dx, dy, compliance, line, mirrored=True):
    """Deflection (ny+1, nx+1) of the pressure P of that shape; line: its last row continues beyond the grid, of a whole domain
    the mean of the first and the last."""
    ny, nx = P.shape[0] - 1, P.shape[1] - 1
    edge = (P[-1] if mirrored else (P[0] + P[-1]) / 2) if line else 0 * P[-1]
    rest = P - edge
    whole = np.concatenate([rest[:0:-1], rest]) if mirrored else rest
    found = _convolved(whole, influence.rectangle(nx, len(whole) - 1, dx, dy, compliance).T)[-ny - 1 :] if ny else 0 * P
    return found + (_convolved(edge[None], influence.strip(nx, dx)[None])[0] if line else 0.0)


def _convolved(values, coefficients):
    """values (rows, columns) by coefficients at the lags 0, 1, ... both ways, zeros around them."""
    rows, columns = values.shape
    both = np.concatenate([coefficients[:0:-1], coefficients])
    both = np.concatenate([both[:, :0:-1], both], axis=1)
    shape = 3 * rows - 2, 3 * columns - 2
    found = np.fft.irfft2(np.fft.rfft2(values, shape) * np.fft.rfft2(both, shape), shape)
    return found[rows - 1 : 2 * rows - 1, columns - 1 : 2 * columns - 1]
