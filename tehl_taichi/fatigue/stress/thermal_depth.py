"""Thermal stress below the surface: all six components at any depth of a body that heats from its surface.

Each wave exp(i k s) of the surface temperature (s along the wave, t across) goes down as T(z). With phi'' - k^2 phi = T,
phi = 0 at the surface (Goodier's potential) and the shear that it leaves there taken away (Airy's function -Theta z exp(-k z),
Theta = int T exp(-k z) dz; Timoshenko & Goodier, sections 17 and 151), in units of E alpha/(1 - nu):

    ss = -k^2 phi - T + (2 k - k^2 z) e Theta,   tt = -T + 2 nu k e Theta,   e = exp(-k z),
    zz = k^2 phi + k^2 z e Theta,                sz = i k (phi' + (1 - k z) e Theta).

After a sudden surface temperature T(z, t) = (A + B)/2 with A, B = exp(-+k z) erfc(z/(2 r) -+ k r), r = sqrt(D t) (Carslaw &
Jaeger, appendix V); phi follows from its integral over time. A passage is a sum of such steps, in the frame of the body.
"""

import math

import numpy as np

from tehl_taichi.engine.fftw import half_back, transform, transform_back
from tehl_taichi.fatigue.stress.half_space import ODD
from tehl_taichi.fatigue.stress.thermal_stress import SurfaceHeat, depth_after, erfcx, fast_length
from tehl_taichi.fatigue.stress.wave_table import WaveTable
from tehl_taichi.fatigue.stress.workers import WORKERS, pool

LEAD = 4.0  # a: distance that the body moves through the first state of the contact; before, it is cold
REACH = 9.0  # waves with k z above this do not reach the depth z (exp(-9) = 1e-4)
WEAK = 1e-4  # waves below this share of the strongest are left out
CHUNK = 256  # waves convolved together
PARTS = np.array([0, 1 / 64, 1 / 16, 1 / 4, 1])  # of the newest step: near the surface the stress follows it quickly
NODES, WEIGHTS = np.polynomial.legendre.leggauss(3)  # Gauss rule for means over a part of a step


def step_stresses(k, z, diffusivity, nu, t):
    """(ss, tt, zz, sz/(i k)), each over E alpha T/(1 - nu), at depth z (m) and a time t (s) after a sudden surface temperature
    T exp(i k s); k (1/m) and t broadcast; zero at t = 0."""
    late, k0 = np.where(t > 0, t, 1.0), np.where(k > 0, k, 1.0)
    r2 = diffusivity * late
    r, e = np.sqrt(r2), np.exp(-k * z)
    eta, kappa = z / (2 * r), k * r
    g = np.exp(-eta * eta - kappa * kappa)
    B, near = g * erfcx(eta + kappa), g * erfcx(np.abs(eta - kappa))
    A = np.where(eta > kappa, near, 2 * e - near)
    rest = np.where(eta > kappa, near - 2 * e, -near)  # A - 2 e without the loss of digits
    T, Theta = 0.5 * (A + B), depth_after(k, diffusivity, late)
    phi = 0.5 * (r2 * (rest + B) - z / (2 * k0) * (A - B))
    slope = 0.5 * ((B - A) / (2 * k0) + k * r2 * (B - rest) + 0.5 * z * (A + B) - 2 * r / math.sqrt(math.pi) * g)
    turn = e * Theta
    found = (-k * k * phi - T + (2 - k * z) * k * turn, -T + 2 * nu * k * turn, k * k * (phi + z * turn),
             slope + (1 - k * z) * turn)
    return np.stack([np.where(t > 0, part, 0.0) for part in found])


class ThermalBelow(SurfaceHeat):
    """The six thermal stresses (Pa) below the surface of a body, at every step: :meth:`rows` on some rows, :meth:`at` on all.

    Arguments as for :class:`tehl_taichi.fatigue.stress.thermal_stress.ThermalStress`. shallowest: smallest depth (m); waves
    that do not reach it are left out. lead: distance (a) that the body, cold before, moves through the first state. weak: waves
    below this share of the strongest are left out. Memory: one complex number of single precision per step (those of the lead
    included) and wave number.
    """

    def __init__(self, body, speed, rises, dt, x, y, front, columns, a, mirrored, shallowest, lead=LEAD, weak=WEAK):
        super().__init__(body, rises, x, y, front, columns, a, mirrored)
        self.diffusivity, self.speed, self.dt = body.k / (body.rho * body.c), speed, dt
        self.lead, self.entries = math.ceil(lead * a / (speed * dt)) if lead else 0, len(self.rises)
        self.size = fast_length(2 * self.entries + self.lead)
        spectra = self.spectra()
        self.rises = None
        strength = np.abs(spectra).max(axis=0) * np.exp(-self.waves.k * shallowest)
        self.ix, self.iy = np.nonzero((strength > weak * strength.max()) & (self.waves.k * shallowest < REACH))
        self.kx, self.ky = self.waves.kx[self.ix, 0], self.waves.ky[0, self.iy]
        self.k = np.hypot(self.kx, self.ky)
        self.shallowest = shallowest
        self.passed = self._passed(spectra[:, self.ix, self.iy].T)
        later = np.exp(-2j * np.pi * np.arange(self.size) / self.size).astype(np.complex64)
        before, now = _means(self._angle[:, None], 0.0, 1.0)
        self.before_passed, self.far_passed = later * self.passed, (before * later + now) * self.passed
        self.means = [_means(self._angle[:, None], *ends) for ends in zip(PARTS[:-1], PARTS[1:])]

    def _passed(self, waves):
        """Transform in time (waves, size) of the temperatures in the frame of the body; waves: (waves, steps)."""
        n = np.concatenate([np.zeros(self.lead, int), np.arange(self.entries)])
        turn = np.exp(1j * np.outer(self._angle, np.arange(n.size))).astype(np.complex64)
        return transform(waves[:, n] * turn, self.size)

    @property
    def _angle(self):
        """Phase (waves,) rad by which each wave moves over the body in a step."""
        return self.kx * self.speed * self.dt

    def _responses(self, depth, each=map):
        """Generator of (numbers of some waves, (answers (waves, 6, size), newest (waves, 2, 4))) for the waves that reach a
        depth.

        answers: transforms in time of ss, tt, zz, sz by all steps but the newest one, of the temperature before the newest
        step, and of the temperature at its end. newest: contributions of these two temperatures to ss, tt, zz, sz. each:
        function that maps a function over a list.
        """
        reached = np.flatnonzero(self.k * depth < REACH)
        reached = reached[np.argsort(self.k[reached], kind="stable")]  # waves of one cut take few rows of the table
        cuts = [np.sort(reached[start : start + CHUNK]) for start in range(0, reached.size, CHUNK)]
        table = WaveTable.of(self.k[reached], lambda k: self._answers(k, depth))
        for first in range(0, len(cuts), WORKERS):  # not more of them at once: there may be 100, of 8 MB each
            some = cuts[first : first + WORKERS]
            yield from zip(some, each(lambda cut: self._answers_of(table, cut), some))

    def _answers_of(self, table, cut):
        """(answers, newest) of :meth:`_responses` for the waves `cut`. Temperatures are linear over a step in the frame of the
        contact; the newest step is divided at PARTS."""
        kernels, newest = table(self.k[cut])
        out = np.empty((cut.size, 6, self.size), np.complex64)  # each wave's six in one piece, as :meth:`rows` takes them
        for n, kernel in enumerate(kernels):
            np.multiply(kernel, self.far_passed[cut], out=out[:, n])
        out[:, 4], out[:, 5] = self.before_passed[cut], self.passed[cut]
        shares = [sum(newest[..., n] * means[cut, 0] for n, means in enumerate(parts)) for parts in zip(*self.means)]
        return out, np.stack(shares).transpose(2, 0, 1)

    def _answers(self, k, depth):
        """Stresses ss, tt, zz, sz of waves k (n,) 1/m by a unit rise of temperature.

        Returns the transforms in time (4, n, size) of the response after the newest step, and the response (4, n, parts) to the
        parts of the newest step.
        """
        count, k = self.lead + self.entries, k[:, None]
        stress = step_stresses(k, depth, self.diffusivity, self.nu, np.append(np.arange(count), PARTS) * self.dt)
        stress[3] *= k
        reach = np.diff(stress[..., :count], axis=2, append=stress[..., count - 1 : count])
        reach[..., 0] = 0.0
        return transform(reach, self.size), np.diff(stress[..., count:], axis=2).astype(np.float32)

    def _turns(self, cut):
        """Matrices (waves, 4, 6) from ss, tt, zz, sz to xx, yy, zz, xy, xz, yz."""
        k = np.where(self.k[cut] > 0, self.k[cut], 1.0)
        cos, sin = np.where(self.k[cut] > 0, self.kx[cut] / k, 1.0), np.where(self.k[cut] > 0, self.ky[cut] / k, 0.0)
        none, one = 0 * cos, 1 + 0 * cos
        turns = [[cos**2, sin**2, none, cos * sin, none, none], [sin**2, cos**2, none, -cos * sin, none, none],
                 [none, none, one, none, none, none], [none, none, none, none, 1j * cos, 1j * sin]]
        return np.array(turns).transpose(2, 0, 1).astype(np.complex64)

    def _back(self, spectra, kx):
        """Values (..., waves, steps) of transforms in time (..., waves, size), back in the frame of the contact; kx:
        (waves,)."""
        back = np.exp(-1j * np.outer(kx * self.speed * self.dt, np.arange(self.lead, self.lead + self.entries)))
        return transform_back(spectra)[..., self.lead : self.lead + self.entries] * back.astype(np.complex64)

    def rows(self, depth, rows):
        """Stresses (rows, steps, columns, 6) Pa at `depth` (m) on some rows (their numbers)."""
        w, columns = self.waves, int(self.ix.max()) + 1
        both = np.array([[w.row_weights(row, odd)[self.iy] for odd in (False, True)] for row in rows])
        weights = both[:, np.array(ODD, int)].astype(np.complex64).transpose(2, 0, 1)  # (waves, rows, 6)
        used = np.flatnonzero(weights.any(axis=0))  # odd components vanish on a mirror's row
        out = np.zeros((columns, used.size, self.size), np.complex64)
        for cut, (parts, newest) in self._responses(depth):
            turns = _with_newest(self._turns(cut), newest)
            adds = (turns[:, :, None] * weights[cut][:, None]).reshape(cut.size, 6, -1)[..., used]
            ends = [*np.flatnonzero(np.diff(self.ix[cut], prepend=-1)), cut.size]
            for first, end in zip(ends[:-1], ends[1:]):  # the waves of one kx
                out[self.ix[cut[first]]] += _rows_of(adds[first:end]).T @ _rows_of(parts[first:end])
        spectra = np.zeros((used.size, w.kx.size, self.entries), np.complex64)
        spectra[:, :columns] = self._back(out.transpose(1, 0, 2), w.kx[:columns, 0])
        found = np.zeros((len(rows) * 6, self.entries, self.columns), np.float32)
        found[used] = half_back(spectra, w.nx, 1)[:, : self.columns].transpose(0, 2, 1)
        return self.stiffness / w.nx * found.reshape(len(rows), 6, self.entries, self.columns).transpose(0, 2, 3, 1)

    def at(self, depth):
        """Function of the number of a step (and a slice of rows) that returns sxx, syy, szz, sxy, sxz, syz at `depth` (m), each
        (columns, rows) Pa."""
        w, held = self.waves, np.zeros((6, self.k.size, self.entries), np.complex64)
        with pool(w.k.size) as workers:
            for cut, (parts, newest) in self._responses(depth, workers.map):
                turns = _with_newest(self._turns(cut), newest)
                held[:, cut] = self._back((turns.swapaxes(1, 2) @ parts).swapaxes(0, 1), self.kx[cut])

        def fields(entry, rows=slice(None)):
            out = []
            for n in range(6):
                spectrum = np.zeros(w.k.shape, np.complex64)
                spectrum[self.ix, self.iy] = held[n, :, entry]
                out.append(self.stiffness * w.values(spectrum, ODD[n], rows=rows)[: self.columns])
            return out

        return fields


def _with_newest(turns, newest):
    """Matrices (waves, 6, 6): `turns` (waves, 4, 6), and their product with `newest` (waves, 2, 4)."""
    return np.concatenate([turns, newest @ turns], axis=1)


def _rows_of(array):
    """(n, 6, m) as (n 6, m)."""
    return array.reshape(-1, array.shape[-1])


def _means(angle, low, high):
    """Mean weights of the temperature before a step and of the one at its end, over the ages from low to high (shares of the
    step), each (waves, 1), in the phase of the end."""
    age = low + (high - low) * (NODES + 1) / 2
    turn = np.exp(-1j * angle * age) * WEIGHTS / 2
    found = (age * turn).sum(axis=1, keepdims=True) * np.exp(1j * angle), ((1 - age) * turn).sum(axis=1, keepdims=True)
    return [means.astype(np.complex64) for means in found]
