"""Stresses in a body under pressure and shear on its surface, at the surface or at one depth (half-space, see
:mod:`tehl_taichi.fatigue.rectangle` for the coefficients and the signs)."""

import copy

import numpy as np

from tehl_taichi.engine.fftw import pyfftw
from tehl_taichi.engine.transforms import even_fast_length
from tehl_taichi.fatigue import rectangle

COMPONENTS = ("sxx", "syy", "szz", "sxy", "sxz", "syz")


class Stress:
    """Stresses on a uniform half domain, y >= 0 mirrored (p, q_x even in y; q_y odd), or on a whole one.

    x (nx+1,), y (ny+1,) in m, y[0] = 0; one row of y means plane strain. nu: Poisson's ratio. mirrored=False: nothing acts
    at y < 0. depth: m below the surface.
    line=True: p and q_x of the last y row go on to infinity; that part is plane strain (analytic strips), the deviation
    from it a convolution over the rectangles around the nodes. line=False: nothing acts outside the domain.
    Raises ValueError for a grid that is not uniform, or a single row without line=True.
    """

    def __init__(self, x, y, nu, line=True, mirrored=True, depth=0.0):
        self.x, self.y, self.nu, self.line = np.asarray(x, float), np.asarray(y, float), float(nu), line
        if self.y.size == 1 and not line:
            raise ValueError("one row of y describes a line contact only (line=True)")
        self.depth, dx = depth, spacing(self.x)
        self.strips = rectangle.strip(np.arange(-self.x.size + 1, self.x.size) * dx, depth, dx / 2)
        if self.y.size > 1:
            self.convolution = _Convolution(self.x.size, self.y.size, dx, spacing(self.y), self.nu, mirrored, depth)

    def __call__(self, p, qx, qy):
        """{component: (nx+1, ny+1) Pa} for p, qx, qy (nx+1, ny+1) Pa: sxx, syy, szz, sxy, sxz, syz."""
        p, qx, qy = (np.asarray(v, float) for v in (p, qx, qy))
        out = np.zeros((6, *p.shape))
        far_p, far_q = np.zeros((2, p.shape[0]))
        if self.line:
            far_p, far_q = p[:, -1], qx[:, -1]
            out += np.stack(self._plane_strain(far_p, far_q))[:, :, None]
        if self.y.size > 1:
            rest = self.convolution(p - far_p[:, None], qx - far_q[:, None], qy)
            out[[0, 1, 3] if self.depth == 0 else slice(None)] += rest
        if self.depth == 0:
            out[2], out[4], out[5] = -p, -qx, -qy
        return dict(zip(COMPONENTS, out))

    def twin(self):
        """A second operator with the same coefficients and buffers of its own, for another thread."""
        other = copy.copy(self)
        if self.y.size > 1:
            other.convolution = copy.copy(self.convolution)
            other.convolution._plan()
        return other

    def _plane_strain(self, p, q):
        """Six components (nx+1,) of loads that do not change along y."""
        n = q.size
        sxx, szz, sxz = (np.convolve(p, by_p)[n - 1 : 2 * n - 1] + np.convolve(q, by_q)[n - 1 : 2 * n - 1]
                         for by_p, by_q in zip(*self.strips))
        none = np.zeros(n)
        return sxx, self.nu * (sxx + szz), szz, none, sxz, none


class _Convolution:
    """Zero-padded real transforms of the loads on 2 ny + 1 mirrored rows (or as they are); results on the rows y >= 0."""

    def __init__(self, nx, ny, dx, dy, nu, mirrored, depth):
        self.nx, self.ny, self.mirrored, self.depth = nx, ny, mirrored, depth
        self.shape = even_fast_length(2 * nx - 1), even_fast_length(3 * ny - 2)
        self._plan()
        self.spectra = self._spectra(dx, dy, nu)

    def _plan(self):
        spectrum = self.shape[0], self.shape[1] // 2 + 1
        self.real, self.complex = pyfftw.zeros_aligned(self.shape), pyfftw.zeros_aligned(spectrum, "complex128")
        # estimated plans on one thread: the same plan, so the same bits, in every run
        options = {"axes": (0, 1), "flags": ("FFTW_ESTIMATE",), "threads": 1}
        self.forward = pyfftw.FFTW(self.real, self.complex, **options)
        self.backward = pyfftw.FFTW(self.complex, self.real, direction="FFTW_BACKWARD", **options)

    def _spectra(self, dx, dy, nu):
        x, y = np.meshgrid(_lags(self.shape[0]) * dx, _lags(self.shape[1], self.ny) * dy, indexing="ij")
        if self.depth:
            loads = (rectangle.pressure_at_depth, rectangle.shear_x_at_depth, rectangle.shear_y_at_depth)
            return [[self._transform(k) for k in load(x, y, self.depth, dx / 2, dy / 2, nu)] for load in loads]
        loads = (rectangle.pressure_coefficients, rectangle.shear_x_coefficients, rectangle.shear_y_coefficients)
        return [[self._transform(k) for k in load(x, y, dx / 2, dy / 2, nu)] for load in loads]

    def _transform(self, values):
        self.real[:] = 0
        self.real[: values.shape[0], : values.shape[1]] = values
        return self.forward().copy()

    def _mirrored(self, values, sign):
        """Row of y = 0 first, then y > 0, then (wrapped) y < 0."""
        self.real[:] = 0
        self.real[: self.nx, : self.ny] = values
        if self.mirrored:
            self.real[: self.nx, self.shape[1] - self.ny + 1:] = sign * values[:, :0:-1]
        return self.forward().copy()

    def __call__(self, p, qx, qy):
        """(sxx, syy, sxy), in depth all six components, each (nx, ny), from loads of that shape."""
        qy = qy * _no_axis(qy) if self.mirrored else qy
        loads = [self._mirrored(p, 1), self._mirrored(qx, 1), self._mirrored(qy, -1)]
        return [self._back(sum(load * row[n] for load, row in zip(loads, self.spectra))) for n in range(len(self.spectra[0]))]

    def _back(self, spectrum):
        self.complex[:] = spectrum
        return self.backward()[: self.nx, : self.ny].copy()


def _no_axis(q):
    """An odd load vanishes on the axis y = 0."""
    keep = np.ones_like(q)
    keep[:, 0] = 0
    return keep


def _lags(n, negative=None):
    """Lags in cells in wrapped order, -negative+1 ... n-negative (default: half of them negative)."""
    k = np.arange(n)
    return np.where(k <= n - (negative or n // 2), k, k - n)


def spacing(v):
    steps = np.diff(v)
    if v.size < 2 or not np.allclose(steps, steps.mean(), rtol=1e-6):
        raise ValueError("surface stresses need a uniform grid of at least two nodes")
    return float(steps.mean())
