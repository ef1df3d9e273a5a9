"""Thermal stress at the surface of a body from the temperatures that pass over it: thermoelastic half-space.

A body heated from its surface wants to expand. With the displacement potential that vanishes at z = 0 (Goodier), the surface
layer is held in its plane, sigma_xx = sigma_yy = -E alpha T/(1 - nu), and leaves the shear (E alpha/(1 - nu)) grad Theta on
the surface, Theta(k) = int T(k, z) exp(-|k| z) dz; taking that away adds 2 E alpha/(1 - nu) (k_x^2 + nu k_y^2)/|k| Theta to
sigma_xx and 2 E alpha k_x k_y/|k| Theta to sigma_xy (tangential loads in Fourier space, Johnson section 3.6). How deep the
heat has come follows from the surface temperature alone (conduction from the surface, Carslaw & Jaeger section 2.4, along it
too): Theta = T sqrt(D)/(sqrt(s + D k^2) + |k| sqrt(D)) in Laplace space, D the diffusivity.
"""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from tehl_taichi.engine import cores

SERIES = 32  # terms of Weideman's rational series
TAPER = 1.0  # a: behind the grid its last temperatures fade over this length
CHUNK = 1000  # wave numbers convolved at once
WORKERS = min(4, cores.available())  # threads of a fatigue pass (transforms run outside the interpreter's lock)


def erfcx(x):
    """exp(x^2) erfc(x) for x >= 0, to 1e-12 (Weideman 1994, SIAM J. Numer. Anal. 31, 1497)."""
    L, n = math.sqrt(SERIES / math.sqrt(2)), 2 * SERIES
    t = L * np.tan(np.arange(-n + 1, n) * np.pi / (2 * n))
    values = np.concatenate([[0.0], np.exp(-t * t) * (L * L + t * t)])
    terms = np.real(np.fft.fft(np.fft.fftshift(values)))[1 : SERIES + 1][::-1] / (2 * n)
    return 2 * np.polyval(terms, (L - x) / (L + x)) / (L + x) ** 2 + 1 / math.sqrt(math.pi) / (L + x)


def depth_after(k, diffusivity, t):
    """Theta/T a time t after a sudden surface temperature, m: int_0^t of the kernel; k in 1/m, all arrays."""
    x = k * np.sqrt(diffusivity * t)
    small = x < 1e-6
    fade, safe = np.exp(-x * x), np.where(small, 1.0, k)
    erfc = erfcx(x) * fade
    full = (0.5 * (1 - erfc) - x * x * erfc + x / math.sqrt(math.pi) * fade) / safe
    return np.where(small, 2 * np.sqrt(diffusivity * t / math.pi), full)


def steady_depth(kx, k, diffusivity, speed):
    """Theta/T, m, of temperatures that stand still above a surface moving at `speed`; k = 0: 0 (it has no gradient)."""
    root = np.sqrt(1j * kx * speed + diffusivity * k * k) + k * math.sqrt(diffusivity)
    return np.where(k > 0, math.sqrt(diffusivity) / np.where(k > 0, root, 1.0), 0.0)


def fast_length(n):
    """The next length of which a transform is quick."""
    from tehl_taichi.engine.fftw import pyfftw

    return pyfftw.next_fast_len(n)


class Waves:
    """Wave numbers of fields on `columns` x `rows` nodes, even about the first row (mirrored) or padded with zeros."""

    def __init__(self, columns, rows, dx, dy, mirrored):
        self.columns, self.rows, self.mirrored = columns, rows, mirrored
        self.nx = fast_length(2 * columns)
        self.ny = 1 if rows == 1 else 2 * (rows - 1) if mirrored else fast_length(2 * rows)
        kx = 2 * np.pi * np.fft.rfftfreq(self.nx, dx)
        ky = 2 * np.pi * np.fft.fftfreq(self.ny, dy if rows > 1 else 1.0)
        self.kx, self.ky = kx[:, None], ky[None, : rows if mirrored else None]
        self.k = np.hypot(self.kx, self.ky)

    def spectrum(self, values):
        """(nx//2+1, modes of y) of values (columns, rows)."""
        whole = np.zeros((self.nx, self.ny))
        whole[: self.columns, : self.rows] = values
        if self.mirrored and self.rows > 1:
            whole[: self.columns, self.rows :] = values[:, -2:0:-1]
        return np.fft.fft(np.fft.rfft(whole, axis=0), axis=1)[:, : self.k.shape[1]]

    def values(self, spectrum, odd=False):
        """(columns, rows) of a spectrum; odd: about the first row."""
        if self.mirrored and self.rows > 1:
            sign = -1 if odd else 1
            spectrum = np.concatenate([spectrum, sign * spectrum[:, -2:0:-1]], axis=1)
        return np.fft.irfft(np.fft.ifft(spectrum, axis=1), self.nx, axis=0)[: self.columns, : self.rows]

    def row_weights(self, row, odd=False):
        """(modes of y,): their sum with a spectrum is its row `row`, still a spectrum along x."""
        turn = np.exp(2j * np.pi * np.arange(self.ny) * row / self.ny) / self.ny
        if not self.mirrored or self.rows == 1:
            return turn
        back = np.concatenate([[0.0], turn[1 : self.rows - 1].conj() * (-1 if odd else 1), [0.0]])
        return (turn[: self.rows] + back) * (1 - odd * np.isin(np.arange(self.rows), (0, self.rows - 1)))


class Heated:
    """A body and the temperatures that pass over its surface; arguments: see :class:`ThermalStress`."""

    def __init__(self, body, rises, x, y, front, columns, a, mirrored):
        self.stiffness, self.nu, self.front = body.E * body.alpha / (1 - body.nu), body.nu, front
        self.dx, rows = x[1] - x[0], y.size
        self.taper = math.ceil(TAPER * a / self.dx)
        self.columns = columns
        whole = max(columns, front + x.size + self.taper)
        self.waves = Waves(whole, rows, self.dx, y[1] - y[0] if rows > 1 else 1.0, mirrored)
        self.rises = [self._extended(rise).astype(np.float32) for rise in rises]

    def _extended(self, rise):
        """The rise on the wide grid, fading out behind its last column."""
        out = np.zeros((self.waves.columns, rise.shape[1]))
        end = self.front + rise.shape[0]
        out[self.front : end] = rise
        fade = 0.5 * (1 + np.cos(np.pi * np.arange(1, self.taper + 1) / self.taper))
        out[end : end + self.taper] = rise[-1] * fade[: out.shape[0] - end, None]
        return out


class ThermalStress(Heated):
    """sigma_xx, sigma_yy, sigma_xy (Pa) at the surface of `body`, which moves at `speed` (m/s), at every entry of a passage.

    rises: entries of the temperature above ambient, (nx+1, ny+1) K, an iterable; entry 0 is the steady state in which the
    contact has been for ever, the others follow at distances dt (s). columns: of the grid that stresses are wanted on, the
    rises standing `front` columns behind its first. Holds one complex number of single precision per entry and wave number.
    """

    def __init__(self, body, speed, rises, dt, x, y, front, columns, a, mirrored):
        super().__init__(body, rises, x, y, front, columns, a, mirrored)
        diffusivity = body.k / (body.rho * body.c)
        w = self.waves
        steady = w.spectrum(self.rises[0])
        self.first = steady * steady_depth(w.kx, w.k, diffusivity, speed)
        with ThreadPoolExecutor(WORKERS) as pool:
            changes = np.stack(list(pool.map(lambda rise: w.spectrum(rise - self.rises[0]).astype(np.complex64), self.rises)))
        self.thetas = _convolved(changes, w, diffusivity, speed, dt)

    def __call__(self, entry):
        """(sxx, syy, sxy), each (columns, ny+1)."""
        w = self.waves
        theta = (self.first + self.thetas[entry]) * 2 * self.stiffness / np.where(w.k > 0, w.k, 1.0)
        held = -self.stiffness * self.rises[entry]
        sxx = held + w.values((w.kx**2 + self.nu * w.ky**2) * theta)
        syy = held + w.values((w.ky**2 + self.nu * w.kx**2) * theta)
        sxy = w.values((1 - self.nu) * w.kx * w.ky * theta, odd=True)
        return tuple(v[: self.columns] for v in (sxx, syy, sxy))


def _convolved(changes, waves, diffusivity, speed, dt):
    """Theta of the changes against the steady state, (entries, ...): a sum over the past in the frame of the body, linear in
    time between the entries (their mean over a step)."""
    entries, shape = changes.shape[0], waves.k.shape
    k, kx = waves.k.ravel(), np.broadcast_to(waves.kx, shape).ravel()
    flat, times, size = changes.reshape(entries, -1), np.arange(entries) * dt, fast_length(2 * entries)

    def convolve(start):
        cut = slice(start, start + CHUNK)
        turn = np.exp(1j * np.outer(times, kx[cut]) * speed)
        moving = flat[:, cut] * turn
        moving[1:] = 0.5 * (moving[1:] + moving[:-1])
        moving[0] = 0.0
        reach = np.diff(depth_after(k[cut], diffusivity, times[:, None]), axis=0, append=0.0)
        reach[-1] = 0.0
        theta = np.fft.ifft(np.fft.fft(moving, size, axis=0) * np.fft.fft(reach, size, axis=0), axis=0)[:entries]
        flat[:, cut] = theta / turn

    with ThreadPoolExecutor(WORKERS) as pool:
        list(pool.map(convolve, range(0, k.size, CHUNK)))
    return changes
