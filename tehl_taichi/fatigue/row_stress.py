"""Stresses on some rows of a surface at many depths: rows of the half-space convolution instead of all of them.

The same rectangles and strips as :mod:`tehl_taichi.fatigue.half_space`, so the same numbers to rounding; per row and depth a
fiftieth of the work on 64 rows, since only transforms along x are left and each wave is a product of matrices.

Along x the stress of a rectangle is even or odd, its transform real or imaginary, and with i q_x in place of q_x all loads go
with real numbers into a component, and i times them into sxy and sxz: half the work of complex matrices. Across it is even or
odd too, so that one quarter of the plane around a rectangle tells all.
"""

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from tehl_taichi.engine.transforms import even_fast_length
from tehl_taichi.fatigue import rectangle
from tehl_taichi.fatigue.half_space import spacing
from tehl_taichi.fatigue.thermal_stress import WORKERS

LOADS = (rectangle.pressure_at_depth, rectangle.shear_x_at_depth, rectangle.shear_y_at_depth)
SURFACE = (rectangle.pressure_coefficients, rectangle.shear_x_coefficients, rectangle.shear_y_coefficients)
CARRIED = (2, 4, 5)  # zz, xz, yz: at the surface the loads p, q_x and q_y themselves
SIGNS = (1, 1, -1)  # of p, q_x and q_y in the mirror image about the first row
TURNED = (3, 4)  # xy, xz: i times what the loads p, i q_x and q_y give; odd along x where the others are even
ACROSS = np.array([1, 1, 1, -1, 1, -1])  # of the components on the other side across; xy and yz change


class RowStress:
    """Six components at `depths` (m, 0: the surface) under `rows` of a grid, from p, q_x and q_y on all its rows.

    x, y, nu, line, mirrored: as for :class:`tehl_taichi.fatigue.half_space.Stress`; mirrored rows begin at y = 0.
    """

    def __init__(self, x, y, nu, line, mirrored, depths, rows):
        self.x, self.y, self.nu, self.line = np.asarray(x, float), np.asarray(y, float), float(nu), line
        self.n, self.size, self.wanted = self.x.size, even_fast_length(2 * self.x.size - 1), list(rows)
        lags = np.arange(self.n) * spacing(self.x)
        self.strips = np.stack([self._strips(lags, z) for z in depths], axis=1) if line else None
        self.rows = None
        if self.y.size > 1:
            with ThreadPoolExecutor(WORKERS) as pool:
                found = list(pool.map(lambda z: self._rectangles(lags, z, mirrored), depths))
            self.rows = np.stack(found, axis=3).reshape(self.size // 2 + 1, 3 * self.y.size, -1)

    def __call__(self, p, qx, qy):
        """(rows, entries, depths, nx+1, 6) Pa from loads (entries, nx+1, ny+1) Pa."""
        loads = np.stack([p, qx, qy], axis=-1)
        far = loads[:, :, -1:, :2].copy() if self.line else np.zeros((1, 1, 1, 2))
        found = 0.0
        if self.rows is not None:
            loads[..., :2] -= far
            found = self._carried(np.fft.rfft(loads.reshape(*loads.shape[:2], -1), self.size, axis=1))
        if self.line:
            strips = np.einsum("ewl,ldwc->wedc", np.fft.rfft(far[:, :, 0], self.size, axis=1), self.strips)
            found = found + strips[:, :, None]
        return np.moveaxis(np.fft.irfft(found, self.size, axis=0)[: self.n], (0, 2), (3, 0))

    def _carried(self, spectra):
        """(waves, entries, rows, depths, 6) from the loads of all rows (entries, waves, loads)."""
        spectra[..., 1::3] *= 1j
        entries, waves, loads = spectra.shape
        parts = np.empty((waves, 2, entries, loads))
        parts[:, 0], parts[:, 1] = spectra.real.swapaxes(0, 1), spectra.imag.swapaxes(0, 1)
        parts = (parts.reshape(waves, -1, loads) @ self.rows).reshape(waves, 2, entries, len(self.wanted), -1, 6)
        found = np.empty((waves, *parts.shape[2:]), complex)
        found.real, found.imag = parts[:, 0], parts[:, 1]
        found[..., TURNED] *= 1j
        return found

    def _strips(self, lags, depth):
        """(2, waves, 6): plane strain from unit pressure and unit q_x on one strip."""
        out = np.zeros((2, lags.size, 6))
        for load, parts in enumerate(rectangle.strip(lags, depth, spacing(self.x) / 2)):
            out[load][:, [0, 2, 4]] = np.transpose(parts)
        out[..., 1] = self.nu * (out[..., 0] + out[..., 2])
        return np.stack([np.fft.rfft(self._wrapped(out[load], load), axis=0) for load in (0, 1)])

    def _wrapped(self, values, load):
        """Values (lags from 0, ..., 6) of a load as one period, lag 0 first."""
        out = np.zeros((self.size, *values.shape[1:]))
        out[: self.n], out[self.size - self.n + 1 :] = values, _along(load) * values[:0:-1]
        return out

    def _rectangles(self, lags, depth, mirrored):
        """(waves, loads of every row, rows wanted, 6), real: from unit loads on one rectangle of each row and its image."""
        count, given = self.y.size, np.arange(self.y.size)
        steps = np.arange(max(self.wanted) + count) * spacing(self.y)
        out = np.zeros((self.size // 2 + 1, count, 3, len(self.wanted), 6))
        for load, sign in enumerate(SIGNS):
            table = self._transformed(_unit_load(load, lags[:, None], steps, depth, self._sides), load)
            across = ACROSS * SIGNS[load]
            for n, row in enumerate(self.wanted):
                one = table[:, np.abs(row - given)] * np.where((given > row)[:, None], across, 1)
                if mirrored:
                    one[:, 1:] += sign * table[:, row + given[1:]]
                    one[:, 0] *= sign > 0  # an odd load vanishes on the mirror's row
                out[:, :, load, n] = one
        return out.reshape(len(out), -1, *out.shape[3:])

    @property
    def _sides(self):
        return spacing(self.x) / 2, spacing(self.y) / 2, self.nu

    def _transformed(self, values, load):
        """(waves, steps across, 6), real, of the stresses (6, lags, steps) of a load."""
        spectra = np.fft.rfft(self._wrapped(np.moveaxis(values, 0, -1), load), axis=0)
        spectra[..., TURNED] *= -1j
        return (-1j * spectra if load == 1 else spectra).real  # q_x comes as i q_x


def _along(load):
    """Signs (6,) of the components of p, q_x or q_y on the other side along x."""
    signs = np.ones(6)
    signs[list(TURNED)] = -1.0
    return -signs if load == 1 else signs


def _unit_load(n, x, y, depth, sides):
    """(6, lags, rows): stresses at (x, y, depth) from unit p, q_x or q_y (n = 0, 1, 2) on one rectangle."""
    if depth:
        return np.array(LOADS[n](x, y, depth, *sides))
    out = np.zeros((6, *np.broadcast_shapes(x.shape, y.shape)))
    out[[0, 1, 3]] = SURFACE[n](x, y, *sides)
    out[CARRIED[n]] = -1.0 * ((np.abs(x) < sides[0]) & (np.abs(y) < sides[1]))
    return out
