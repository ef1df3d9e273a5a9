"""Stresses in a body under pressure and shear on its surface, at the surface or at one depth (coefficients and signs:
:mod:`tehl_taichi.fatigue.stress.rectangle`).
"""

import numpy as np

from tehl_taichi.engine.fftw import DOUBLE, even_fast_length, half, real_of, transform
from tehl_taichi.fatigue.stress import rectangle
from tehl_taichi.fatigue.stress.unit_loads import ACROSS, HELD, SIGNS, along, unit_load, wrapped
from tehl_taichi.fatigue.stress.waves import Waves

COMPONENTS = ("sxx", "syy", "szz", "sxy", "sxz", "syz")
ODD = (False, False, False, True, False, True)  # components with the other sign in the mirror image about y = 0
PHASES = (1, 1, 1, 1, 1j, 1j)  # of the components, beside those of the loads p, i q_x, i q_y: answers are real then


class HalfSpaceStress:
    """Operator from loads on a uniform grid to the six stresses at one depth.

    x (nx+1,), y (ny+1,) in m, y[0] = 0; a single row means plane strain. nu: Poisson's ratio. line=True: the part
    :func:`endless` of p and q_x continues to infinity; it is plane strain (analytic strips), the difference from it a
    convolution over the rectangles around the nodes. line=False: nothing acts outside the domain. mirrored=True: the domain is
    the half y >= 0 (p, q_x even in y, q_y odd); mirrored=False: it is the whole. depth: m below the surface. rows: slice of the
    rows to compute (default: all). kind: precision of the transforms; the error of single precision is 3e-7 of the largest
    stress.
    Raises ValueError for a grid that is not uniform, or a single row without line=True.
    """

    def __init__(self, x, y, nu, line=True, mirrored=True, depth=0.0, rows=None, kind=DOUBLE):
        self.x, self.y, self.nu, self.line = np.asarray(x, float), np.asarray(y, float), float(nu), line
        if self.y.size == 1 and not line:
            raise ValueError("one row in y is a line contact; set line=True")
        self.depth, self.rows, self.mirrored, dx = depth, rows or slice(None), mirrored, spacing(self.x)
        self.size = even_fast_length(2 * self.x.size - 1)
        self.strips = self._strips(rectangle.strip(np.arange(self.x.size) * dx, depth, dx / 2))
        if self.y.size > 1:
            self.convolution = _Convolution(self.x, self.y, self.nu, mirrored, depth, self.rows, kind)

    def __call__(self, p, qx, qy):
        """{component: (nx+1, rows) Pa} for p, qx, qy (nx+1, ny+1) Pa: sxx, syy, szz, sxy, sxz, syz."""
        p, qx, qy = (np.asarray(v, float) for v in (p, qx, qy))
        out, far_p, far_q = np.zeros((6, *p[:, self.rows].shape)), 0.0, 0.0
        if self.line:
            far_p, far_q = (endless(load, self.mirrored)[:, None] for load in (p, qx))
            out += np.stack(self._plane_strain(far_p[:, 0], far_q[:, 0]))[:, :, None]
        if self.y.size > 1:
            for n, rest in self.convolution(p - far_p, qx - far_q, qy):
                out[n] += rest
        if self.depth == 0:
            out[2], out[4], out[5] = (-load[:, self.rows] for load in (p, qx, qy))
        return dict(zip(COMPONENTS, out))

    def _strips(self, parts):
        """Transforms of the stresses sxx, szz, sxz of a strip under unit pressure and unit q_x."""
        return [[np.fft.rfft(wrapped(part, self.size, sign)) for part, sign in zip(found, along(load)[[0, 2, 4]])]
                for load, found in enumerate(parts)]

    def _plane_strain(self, p, q):
        """Six components (nx+1,) of loads that do not vary along y."""
        loads = np.fft.rfft([p, q], self.size)
        sxx, szz, sxz = (np.fft.irfft(loads[0] * by_p + loads[1] * by_q, self.size)[: p.size]
                         for by_p, by_q in zip(*self.strips))
        none = np.zeros(p.size)
        return sxx, self.nu * (sxx + szz), szz, none, sxz, none


class _Convolution:
    """Convolution: zero-padded transforms of the loads times those of the stresses by unit loads.

    The stress by a unit load is even or odd in x and in y, so its transform is a real number, with i q_x and i q_y in place of
    q_x and q_y, and i times sxz and syz: half the work of complex ones.
    """

    def __init__(self, x, y, nu, mirrored, depth, rows, kind):
        first, end, _ = rows.indices(y.size)
        far = max(end - 1 + mirrored * (y.size - 1), y.size - 1 - first)  # rows from a load, or its image, to a stress
        self.rows, self.found = rows, list(range(6) if depth else HELD)
        self.waves = Waves(x.size, y.size, even_fast_length(2 * x.size - 1), even_fast_length(2 * far + 1), mirrored, kind)
        self.answers = [self._answers(load, x, np.arange(far + 1) * spacing(y), nu, depth) for load in range(3)]

    def _answers(self, load, x, lags_y, nu, depth):
        sides = spacing(x) / 2, lags_y[1] / 2, nu
        components = unit_load(load, np.arange(x.size)[:, None] * spacing(x), lags_y, depth, sides)
        return [self._answer(load, n, components[n]) for n in self.found]

    def _answer(self, load, component, values):
        """Each number twice, for the real and the imaginary part of a wave."""
        w = self.waves
        along_x = half(wrapped(values, w.nx, along(load)[component]), w.nx, 0, DOUBLE)
        whole = transform(wrapped(along_x.T, w.ny, ACROSS[component] * SIGNS[load]).T, w.ny, DOUBLE)[:, : w.modes]
        real = (whole / PHASES[component] / (1j if load else 1)).real
        return np.repeat(real, 2, axis=1).astype(real_of(w.kind))

    def __call__(self, p, qx, qy):
        """Generator of (number of the component, its values (nx+1, rows)) for the components to compute."""
        w = self.waves
        loads = [w.spectrum(p), w.spectrum(qx, factor=1j), w.spectrum(qy, odd=True, factor=1j)]
        loads = [load.view(load.real.dtype) for load in loads]
        for component, answers in zip(self.found, zip(*self.answers)):
            spectrum = loads[0] * answers[0]
            for load, answer in zip(loads[1:], answers[1:]):
                spectrum += load * answer
            yield component, w.values(spectrum.view(w.kind), ACROSS[component] < 0, PHASES[component], self.rows)


def endless(load, mirrored):
    """Part (..., nx) of a line load (..., nx, rows) that continues along y: its last row, of a whole domain the mean of both
    outermost rows, as of the deflection."""
    return load[..., -1] if mirrored else 0.5 * (load[..., 0] + load[..., -1])


def spacing(v):
    steps = np.diff(v)
    if v.size < 2 or not np.allclose(steps, steps.mean(), rtol=1e-6):
        raise ValueError("surface stresses need a uniform grid with at least two nodes")
    return float(steps.mean())
