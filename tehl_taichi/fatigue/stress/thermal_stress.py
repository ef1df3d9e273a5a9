"""Thermal stress at the surface of a body from the temperatures that pass over it: thermoelastic half-space.

A body heated from its surface wants to expand. With the displacement potential that vanishes at z = 0 (Goodier), the surface
layer is held in its plane, sigma_xx = sigma_yy = -E alpha T/(1 - nu), and leaves the shear (E alpha/(1 - nu)) grad Theta on
the surface, Theta(k) = int T(k, z) exp(-|k| z) dz; taking that away adds 2 E alpha/(1 - nu) (k_x^2 + nu k_y^2)/|k| Theta to
sigma_xx and 2 E alpha k_x k_y/|k| Theta to sigma_xy (tangential loads in Fourier space, Johnson section 3.6). How deep the
heat has come follows from the surface temperature alone (conduction from the surface, Carslaw & Jaeger section 2.4, along it
too): Theta = T sqrt(D)/(sqrt(s + D k^2) + |k| sqrt(D)) in Laplace space, D the diffusivity.
"""

import math

import numpy as np

from tehl_taichi.engine.fftw import half_back, transform, transform_back
from tehl_taichi.fatigue.stress.wave_table import WaveTable
from tehl_taichi.fatigue.stress.waves import Waves
from tehl_taichi.fatigue.stress.workers import pool

SERIES = 32  # terms of Weideman's rational series
TAPER = 1.0  # a: behind the grid its last temperatures fade over this length
CHUNK = 1000  # wave numbers convolved at once


def erfcx(x):
    """exp(x^2) erfc(x) for x >= 0, to 1e-12 (Weideman 1994, SIAM J. Numer. Anal. 31, 1497)."""
    L, n = math.sqrt(SERIES / math.sqrt(2)), 2 * SERIES
    t = L * np.tan(np.arange(-n + 1, n) * np.pi / (2 * n))
    values = np.concatenate([[0.0], np.exp(-t * t) * (L * L + t * t)])
    terms = np.real(np.fft.fft(np.fft.fftshift(values)))[1 : SERIES + 1][::-1] / (2 * n)
    return 2 * np.polyval(terms, (L - x) / (L + x)) / (L + x) ** 2 + 1 / math.sqrt(math.pi) / (L + x)


def depth_after(k, diffusivity, t):
    """Theta/T (m) at a time t (s) after a sudden rise of the surface temperature; k (1/m), diffusivity (m2/s), t broadcast."""
    x = k * np.sqrt(diffusivity * t)
    small = x < 1e-6
    fade, safe = np.exp(-x * x), np.where(small, 1.0, k)
    erfc = erfcx(x) * fade
    full = (0.5 * (1 - erfc) - x * x * erfc + x / math.sqrt(math.pi) * fade) / safe
    return np.where(small, 2 * np.sqrt(diffusivity * t / math.pi), full)


def steady_depth(kx, k, diffusivity, speed):
    """Theta/T (m) of temperatures at rest above a surface that moves at `speed` (m/s); 0 for k = 0, which has no gradient."""
    root = np.sqrt(1j * kx * speed + diffusivity * k * k) + k * math.sqrt(diffusivity)
    return np.where(k > 0, math.sqrt(diffusivity) / np.where(k > 0, root, 1.0), 0.0)


def fast_length(n):
    """The next length >= n with a fast transform."""
    from tehl_taichi.engine.fftw import pyfftw

    return pyfftw.next_fast_len(n)


class WaveNumbers(Waves):
    """Waves of fields on `columns` x `rows` nodes, with their wave numbers kx, ky, k (1/m); fields are even about the first row
    (mirrored) or padded with zeros."""

    def __init__(self, columns, rows, dx, dy, mirrored):
        ny = 1 if rows == 1 else 2 * (rows - 1) if mirrored else fast_length(2 * rows)
        super().__init__(columns, rows, fast_length(2 * columns), ny, mirrored)
        kx = 2 * np.pi * np.fft.rfftfreq(self.nx, dx)
        ky = 2 * np.pi * np.fft.fftfreq(self.ny, dy if rows > 1 else 1.0)
        self.kx, self.ky = kx[:, None], ky[None, : self.modes]
        self.k = np.hypot(self.kx, self.ky)

    def row_weights(self, row, odd=False):
        """Weights (modes of y,) whose product with a spectrum is the spectrum along x of the field's row `row`."""
        turn = np.exp(2j * np.pi * np.arange(self.ny) * row / self.ny) / self.ny
        if not self.mirrored or self.rows == 1:
            return turn
        back = np.concatenate([[0.0], turn[1 : self.rows - 1].conj() * (-1 if odd else 1), [0.0]])
        return (turn[: self.rows] + back) * (1 - odd * np.isin(np.arange(self.rows), (0, self.rows - 1)))


def stiffness(body):
    """Stress (Pa) along the surface of a layer that is held in its plane, per K of its temperature; under pressure."""
    return body.E * body.alpha / (1 - body.nu)


class SurfaceHeat:
    """A body and the temperatures that pass over its surface; arguments as for :class:`ThermalStress`."""

    def __init__(self, body, rises, x, y, front, columns, a, mirrored):
        self.stiffness, self.nu, self.front = stiffness(body), body.nu, front
        self.dx, rows = x[1] - x[0], y.size
        self.taper = math.ceil(TAPER * a / self.dx)
        self.columns = columns
        whole = max(columns, front + x.size + self.taper)
        self.waves = WaveNumbers(whole, rows, self.dx, y[1] - y[0] if rows > 1 else 1.0, mirrored)
        self.rises = [np.asarray(rise, np.float32) for rise in rises]

    def _extended(self, rise):
        """Temperature rise on the wide grid (columns, rows) K, which fades to 0 behind the last column."""
        out = np.zeros((self.waves.columns, rise.shape[1]), rise.dtype)
        end = self.front + rise.shape[0]
        out[self.front : end] = rise
        fade = 0.5 * (1 + np.cos(np.pi * np.arange(1, self.taper + 1) / self.taper))
        out[end : end + self.taper] = rise[-1] * fade[: out.shape[0] - end, None]
        return out

    def spectra(self, since=0.0):
        """Spectra (entries, nx//2+1, modes) of all rises less the field `since` (K)."""
        out = np.empty((len(self.rises), *self.waves.k.shape), np.complex64)

        def put(n):
            out[n] = self.waves.spectrum(self._extended(self.rises[n] - since))

        with pool(self.waves.k.size) as workers:
            list(workers.map(put, range(len(out))))
        return out


class ThermalStress(SurfaceHeat):
    """sigma_xx, sigma_yy, sigma_xy (Pa) at the surface of `body`, which moves at `speed` (m/s), at every step of a passage.

    rises: iterable of temperatures above ambient (nx+1, ny+1) K, dt (s) apart; before the first one the contact is in its
    steady state. x, y: nodes of the rises, m. columns: number of columns of the stresses; the first column of the rises is
    number `front` of them. a: length (m) over which rises fade behind the grid. mirrored: rows begin at a mirror. Memory: one
    complex number of single precision per step and wave number.
    """

    def __init__(self, body, speed, rises, dt, x, y, front, columns, a, mirrored):
        super().__init__(body, rises, x, y, front, columns, a, mirrored)
        diffusivity = body.k / (body.rho * body.c)
        w = self.waves
        first = (w.spectrum(self._extended(self.rises[0])) * steady_depth(w.kx, w.k, diffusivity, speed)).astype(np.complex64)
        self.thetas = _convolved(self.spectra(since=self.rises[0]), w, diffusivity, speed, dt)
        self.thetas += first
        self.strength = (2 * self.stiffness / np.where(w.k > 0, w.k, 1.0)).astype(np.float32)

    def on(self, rows):
        """Function of the number of a step that returns sxx, syy, sxy (columns, rows, 3) Pa on these rows."""
        w, rows, nu, kx = self.waves, list(rows), self.nu, self.waves.kx.astype(np.float32)
        even, odd = (np.stack([w.row_weights(row, odd) for row in rows], axis=1) for odd in (False, True))
        weights = np.concatenate([even, w.ky.T**2 * even, w.ky.T * odd], axis=1).astype(np.complex64)

        def stresses(entry):
            along, across, turned = np.split((self.thetas[entry] * self.strength) @ weights, 3, axis=1)
            pushed = np.stack([kx**2 * along + nu * across, nu * kx**2 * along + across, (1 - nu) * kx * turned], axis=-1)
            out = half_back(pushed, w.nx, 0)[: self.columns] / w.nx
            out[..., :2] -= self.stiffness * self._extended(self.rises[entry][:, rows])[: self.columns, :, None]
            return out

        return stresses


def _convolved(changes, waves, diffusivity, speed, dt):
    """Theta (steps, ...) of the changes against the steady state, in place of their spectra `changes`.

    It is a convolution over the past, in the frame of the body; temperatures are linear in time over a step (their mean
    counts).
    """
    entries, shape = changes.shape[0], waves.k.shape
    k, along = waves.k.ravel(), np.repeat(np.arange(shape[0]), shape[1])
    flat, size = changes.reshape(entries, -1), fast_length(2 * entries)
    turns = np.exp(1j * speed * dt * np.outer(waves.kx[:, 0], np.arange(entries))).astype(np.complex64)
    reaches = WaveTable.of(k, lambda k: [_reach(k, diffusivity, dt, entries, size)])

    def convolve(start):
        cut = slice(start, start + CHUNK)
        turn = turns[along[cut]]
        moving = flat[:, cut].T * turn
        moving[:, 1:] = 0.5 * (moving[:, 1:] + moving[:, :-1])
        moving[:, 0] = 0.0
        theta = transform_back(transform(moving, size) * reaches(k[cut])[0][0])[:, :entries]
        flat[:, cut] = (theta * turn.conj()).T

    with pool(k.size) as workers:
        list(workers.map(convolve, range(0, k.size, CHUNK)))
    return changes


def _reach(k, diffusivity, dt, entries, size):
    """(1, waves, size): transform in time of the response of Theta to a unit temperature that lasts one step."""
    deep = depth_after(k[:, None], diffusivity, np.arange(entries) * dt)
    return transform(np.diff(deep, axis=1, append=deep[:, -1:]), size)[None]
