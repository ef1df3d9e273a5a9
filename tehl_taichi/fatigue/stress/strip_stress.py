"""Plane-strain stresses at many depths, by loads on endless strips, as in a smooth line contact."""

import numpy as np

from tehl_taichi.engine.fftw import DOUBLE, even_fast_length, half, half_back
from tehl_taichi.fatigue.stress import rectangle
from tehl_taichi.fatigue.stress.half_space import spacing
from tehl_taichi.fatigue.stress.unit_loads import along, wrapped

IN_PLANE = [0, 2, 4]  # xx, zz, xz: yy follows from them, xy and yz are zero


class StripStress:
    """Six components at `depths` (m, 0: the surface) by p and q_x on endless strips around the equally spaced nodes x (m); nu:
    Poisson's ratio of the body.
    """

    def __init__(self, x, nu, depths):
        x = np.asarray(x, float)
        self.n, self.size, self.nu, self.count = x.size, even_fast_length(2 * x.size - 1), float(nu), len(depths)
        lags, side = np.arange(self.n) * spacing(x), spacing(x) / 2
        # waves last: transforms of neighbouring numbers, an eighth of the time of those along the first axis
        self.answers = np.stack([self._answers(rectangle.strip(lags, z, side)) for z in depths], axis=1)

    def __call__(self, p, qx):
        """Stresses (entries, nx+1, depths, 6), Pa, of loads (entries, nx+1), Pa. One entry at a time: its spectra stay in the
        cache.
        """
        out = np.zeros((*np.shape(p), self.count, 6))
        for found, *loads in zip(out, p, qx):
            self._put(found, np.stack(loads))
        return out

    def _put(self, out, loads):
        """Write the stresses (nx+1, depths, 6) Pa of the loads p, q_x (2, nx+1) Pa of one entry to `out`."""
        pressed, sheared = half(loads, self.size, -1, DOUBLE)
        spectra = self.answers[0] * pressed + self.answers[1] * sheared
        found = half_back(spectra, self.size, -1, DOUBLE)[..., : self.n]
        for n, component in enumerate(IN_PLANE):
            np.divide(found[:, n].T, self.size, out=out[..., component])
        out[..., 1] = self.nu * (out[..., 0] + out[..., 2])

    def _answers(self, strip):
        """Stresses by unit pressure and unit q_x on one strip: (2, parts in the plane, waves)."""
        signs = [along(load)[IN_PLANE] for load in (0, 1)]
        return np.stack([half(wrapped(np.transpose(parts), self.size, signs[load]).T, self.size, -1, DOUBLE)
                         for load, parts in enumerate(strip)])
