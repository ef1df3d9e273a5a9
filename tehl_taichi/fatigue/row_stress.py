"""Stresses on some rows of a surface at many depths: rows of the half-space convolution instead of all of them.

The same rectangles and strips as :mod:`tehl_taichi.fatigue.half_space`, so the same numbers to rounding; per row and depth a
fiftieth of the work on 64 rows, since only transforms along x are left and each wave is a product of matrices.

Along x the stress of a rectangle is even or odd, its transform real or imaginary, and with i q_x in place of q_x all loads go
with real numbers into a component, and i times them into sxy and sxz: half the work of complex matrices. Across it is even or
odd too, so that one quarter of the plane around a rectangle tells all.
"""

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from tehl_taichi.engine.fftw import DOUBLE, half, half_back, real_of
from tehl_taichi.engine.transforms import even_fast_length
from tehl_taichi.fatigue import rectangle
from tehl_taichi.fatigue.half_space import spacing
from tehl_taichi.fatigue.thermal_stress import WORKERS
from tehl_taichi.fatigue.unit_loads import ACROSS, SIGNS, TURNED, along, unit_load, wrapped


class RowStress:
    """Six components at `depths` (m, 0: the surface) under `rows` of a grid, from p, q_x and q_y on all its rows.

    x, y, nu, line, mirrored, kind: as for :class:`tehl_taichi.fatigue.half_space.Stress`; mirrored rows begin at y = 0.
    """

    def __init__(self, x, y, nu, line, mirrored, depths, rows, kind=DOUBLE):
        self.x, self.y, self.nu, self.line = np.asarray(x, float), np.asarray(y, float), float(nu), line
        self.n, self.size, self.wanted, self.kind = self.x.size, even_fast_length(2 * self.x.size - 1), list(rows), kind
        lags = np.arange(self.n) * spacing(self.x)
        self.strips = np.stack([self._strips(lags, z) for z in depths], axis=1) if line else None
        self.rows = None
        if self.y.size > 1:
            with ThreadPoolExecutor(WORKERS) as pool:
                found = list(pool.map(lambda z: self._rectangles(lags, z, mirrored), depths))
            self.rows = np.stack(found, axis=3).reshape(self.size // 2 + 1, 3 * self.y.size, -1).astype(real_of(kind))

    def __call__(self, p, qx, qy):
        """(rows, entries, depths, nx+1, 6) Pa from loads (entries, nx+1, ny+1) Pa."""
        loads = np.stack([p, qx, qy], axis=2)
        far = loads[..., -1:].copy() if self.line else np.zeros((1, 1, 3, 1))
        far[:, :, 2] = 0.0
        found = 0.0
        if self.rows is not None:
            loads -= far
            found = self._carried(half(loads.reshape(*loads.shape[:2], -1), self.size, 1, self.kind))
        if self.line:
            strips = np.fft.rfft(far[:, :, :2, 0], self.size, axis=1)
            found = found + np.einsum("ewl,ldwc->wedc", strips, self.strips)[:, :, None].astype(self.kind)
        return np.moveaxis(half_back(found, self.size, 0, self.kind)[: self.n], (0, 2), (3, 0)) / self.size

    def _carried(self, spectra):
        """(waves, entries, rows, depths, 6) from the loads of all rows (entries, waves, loads)."""
        entries, waves, loads = spectra.shape
        parts = np.empty((waves, 2, entries, loads), real_of(self.kind))
        parts[:, 0], parts[:, 1] = spectra.real.swapaxes(0, 1), spectra.imag.swapaxes(0, 1)
        turned, shear = slice(loads // 3, 2 * (loads // 3)), spectra[..., loads // 3 : 2 * (loads // 3)].swapaxes(0, 1)
        parts[:, 0, :, turned], parts[:, 1, :, turned] = -shear.imag, shear.real  # i q_x
        parts = (parts.reshape(waves, -1, loads) @ self.rows).reshape(waves, 2, entries, len(self.wanted), -1, 6)
        found = np.empty((waves, *parts.shape[2:]), self.kind)
        found.real, found.imag = parts[:, 0], parts[:, 1]
        found[..., TURNED] *= 1j
        return found

    def _strips(self, lags, depth):
        """(2, waves, 6): plane strain from unit pressure and unit q_x on one strip."""
        out = np.zeros((2, lags.size, 6))
        for load, parts in enumerate(rectangle.strip(lags, depth, spacing(self.x) / 2)):
            out[load][:, [0, 2, 4]] = np.transpose(parts)
        out[..., 1] = self.nu * (out[..., 0] + out[..., 2])
        return np.stack([np.fft.rfft(wrapped(out[load], self.size, along(load)), axis=0) for load in (0, 1)])

    def _rectangles(self, lags, depth, mirrored):
        """(waves, loads of every row, rows wanted, 6), real: from unit loads on one rectangle of each row and its image."""
        count, given = self.y.size, np.arange(self.y.size)
        steps = np.arange(max(self.wanted) + count) * spacing(self.y)
        out = np.zeros((self.size // 2 + 1, 3, count, len(self.wanted), 6))
        for load, sign in enumerate(SIGNS):
            table = self._transformed(unit_load(load, lags[:, None], steps, depth, self._sides), load)
            across = ACROSS * SIGNS[load]
            for n, row in enumerate(self.wanted):
                one = table[:, np.abs(row - given)] * np.where((given > row)[:, None], across, 1)
                if mirrored:
                    one[:, 1:] += sign * table[:, row + given[1:]]
                    one[:, 0] *= sign > 0  # an odd load vanishes on the mirror's row
                out[:, load, :, n] = one
        return out.reshape(len(out), -1, *out.shape[3:])

    @property
    def _sides(self):
        return spacing(self.x) / 2, spacing(self.y) / 2, self.nu

    def _transformed(self, values, load):
        """(waves, steps across, 6), real, of the stresses (6, lags, steps) of a load."""
        spectra = np.fft.rfft(wrapped(np.moveaxis(values, 0, -1), self.size, along(load)), axis=0)
        spectra[..., TURNED] *= -1j
        return (-1j * spectra if load == 1 else spectra).real  # q_x comes as i q_x
