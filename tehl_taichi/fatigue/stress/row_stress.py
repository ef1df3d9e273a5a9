"""Stresses under some rows of a surface at many depths: a few rows of the half-space convolution, not all of them.

Rectangles and strips are those of :mod:`tehl_taichi.fatigue.stress.half_space`, so results are equal to rounding. Only
transforms along x are needed, and each wave is a product of matrices: on 64 rows a fiftieth of the work per row and depth.

Symmetry halves the work. Along x the stress of a rectangle is even or odd, so its transform is real or imaginary. With i q_x in
place of q_x, all matrices are real (for sxy and sxz after division by i). Along y the stress is even or odd too, so one quarter
of the plane around a rectangle is enough.
"""

import itertools

import numpy as np

from tehl_taichi.engine.fftw import DOUBLE, even_fast_length, half, half_back, real_of
from tehl_taichi.fatigue.stress.half_space import endless, spacing
from tehl_taichi.fatigue.stress.strip_stress import StripStress
from tehl_taichi.fatigue.stress.unit_loads import ACROSS, CARRIED, HELD, SIGNS, TURNED, along, unit_load, wrapped
from tehl_taichi.fatigue.stress.workers import pool

STEPS = 16  # tables have a multiple of so many rows, so that operators of neighbouring rows share them


class RowStress:
    """Operator from p, q_x, q_y on all rows of a grid to the six stresses at `depths` (m, 0: the surface) under `rows`.

    x, y, nu, line, mirrored, kind: as for :class:`tehl_taichi.fatigue.stress.half_space.HalfSpaceStress`; mirrored rows begin
    at y = 0. rows: their numbers. tables: :class:`tehl_taichi.values.kept_arrays.KeptArrays` that operators for other rows
    share, or None. If the surface is the only depth, three components are computed; the others are the loads themselves.
    On the mirror's row alone xy and yz are zero.
    """

    def __init__(self, x, y, nu, line, mirrored, depths, rows, kind=DOUBLE, tables=None):
        self.x, self.y, self.nu, self.line = np.asarray(x, float), np.asarray(y, float), float(nu), line
        self.n, self.size, self.rows_used, self.kind = self.x.size, even_fast_length(2 * self.x.size - 1), list(rows), kind
        self.depths, self.tables, self.deep, self.mirrored = depths, tables, bool(np.any(depths)), mirrored
        on_mirror = mirrored and self.rows_used == [0]
        self.found = [n for n in (range(6) if self.deep else HELD) if not (on_mirror and ACROSS[n] < 0)]
        lags = np.arange(self.n) * spacing(self.x)
        self.strips = StripStress(self.x, self.nu, depths) if line else None
        self.rows = self._rows(lags) if self.y.size > 1 else None

    def __call__(self, p, qx, qy):
        """Stresses (entries, nx+1, rows, depths, 6) Pa from loads (entries, nx+1, ny+1) Pa."""
        far = [self.line * endless(load, self.mirrored) for load in (p, qx)]
        if self.rows is None:
            return self.strips(*far)[:, :, None]
        found = self._carried(self._waves(zip(p, qx, qy), np.stack(far, axis=-1)))
        if self.line:
            found += self.strips(*far)[:, :, None, :, self.found]
        return self._whole(found, (p, qx, qy))

    def _whole(self, found, loads):
        """Six components from the computed ones `found`; at the surface szz, sxz and syz are minus the loads."""
        if len(self.found) == 6:
            return found
        out = np.zeros((*found.shape[:-1], 6), found.dtype)
        out[..., self.found] = found
        if not self.deep:
            for component, load in zip(CARRIED, loads):
                out[..., 0, component] = -load[..., self.rows_used]
        return out

    def _waves(self, entries, far):
        """Spectra (waves, real and imaginary part, entries, loads of all rows) of p, i q_x, q_y.

        far: (entries, nx+1, 2), the parts of p and q_x that continue along y for ever; they are subtracted. One entry at a time
        stays in the cache, and neighbours along x are neighbours in memory.
        """
        out = np.empty((self.size // 2 + 1, 2, len(far), 3 * self.y.size), real_of(self.kind))
        shear = slice(self.y.size, 2 * self.y.size)
        for n, (p, qx, qy) in enumerate(entries):
            loads = np.concatenate([p - far[n, :, :1], qx - far[n, :, 1:], qy], axis=1)
            spectrum = half(loads.T, self.size, -1, self.kind)
            spectrum[shear] *= 1j
            out[:, 0, n], out[:, 1, n] = spectrum.real.T, spectrum.imag.T
        return out

    def _carried(self, parts):
        """Stresses (entries, nx+1, rows, depths, components) from the spectra of :meth:`_waves`. Transforms back are made for
        one entry at a time, along neighbours in memory: 14 ms instead of 44 for 324 waves, 4 rows and 12 depths."""
        waves, _, entries, loads = parts.shape
        parts = (parts.reshape(waves, -1, loads) @ self.rows).reshape(waves, 2, entries, -1)
        turned = np.flatnonzero(np.tile(np.isin(self.found, TURNED), parts.shape[-1] // len(self.found)))
        out = np.empty((entries, self.n, parts.shape[-1]), real_of(self.kind))
        spectra = np.empty((parts.shape[-1], waves), self.kind)
        for n in range(entries):
            spectra.real, spectra.imag = parts[:, 0, n].T, parts[:, 1, n].T
            spectra[turned] *= 1j
            np.divide(half_back(spectra, self.size, -1, self.kind)[:, : self.n].T, self.size, out=out[n])
        return out.reshape(entries, self.n, len(self.rows_used), -1, len(self.found))

    def _rows(self, lags):
        """Matrices (waves, loads of all rows, rows depths components): transforms of the stresses by unit loads."""
        shape = self.size // 2 + 1, 3, self.y.size, len(self.rows_used), len(self.depths), len(self.found)
        out = np.empty(shape, real_of(self.kind))

        def put(one):
            load, n = one
            out[:, load, :, :, n] = self._rectangles(lags, load, self.depths[n])

        with pool(self.x.size * self.y.size) as workers:
            list(workers.map(put, itertools.product(range(3), range(len(self.depths)))))
        return out.reshape(shape[0], 3 * self.y.size, -1)

    def _rectangles(self, lags, load, depth):
        """Real transforms (waves, rows of the load, rows of the stress, components): unit load on one rectangle of each row,
        and on its mirror image."""
        count, sign, across = self.y.size, SIGNS[load], (ACROSS * SIGNS[load])[self.found]
        reach = max(self.rows_used) + count
        table = self._table(lags, load, depth, reach)
        sides = np.concatenate([table[:, :0:-1], table[:, :1], table[:, 1:] * across], axis=1)
        out = np.empty((len(table), count, len(self.rows_used), len(self.found)), table.dtype)
        for n, row in enumerate(self.rows_used):
            first = reach - 1 - row
            out[:, :, n] = sides[:, first : first + count]
            if self.mirrored:
                out[:, 1:, n] += sign * table[:, row + 1 : row + count]
                out[:, 0, n] *= sign > 0  # an odd load vanishes on the mirror's row
        return out

    def _table(self, lags, load, depth, reach):
        """Real transforms (waves, reach, components) of a unit load on one rectangle, at distances of 0 to reach - 1 rows."""
        def made(steps):
            across = np.arange(steps) * spacing(self.y)
            return self._transformed(unit_load(load, lags[:, None], across, depth, self._sides), load)

        if self.tables is None:
            return made(reach)
        more = -(-reach // STEPS) * STEPS
        return self.tables.of((load, depth, self.n, more, self._sides, *self.found, self.kind), lambda: made(more))[:, :reach]

    @property
    def _sides(self):
        """Half sides of a rectangle (m, m), and nu."""
        return spacing(self.x) / 2, spacing(self.y) / 2, self.nu

    def _transformed(self, values, load):
        """Real transforms (waves, steps across, components) of the stresses (6, lags, steps across) of a unit load."""
        signs, out = along(load), np.empty((self.size // 2 + 1, values.shape[2], len(self.found)), real_of(self.kind))
        for n, component in enumerate(self.found):
            spectrum = half(wrapped(values[component], self.size, signs[component]), self.size, 0, DOUBLE)
            turns = (component in TURNED) + (load == 1)  # q_x comes as i q_x
            out[..., n] = (spectrum.real, spectrum.imag, -spectrum.real)[turns]
        return out
