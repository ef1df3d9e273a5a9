"""Stresses at the surface of an elastic half-space under pressure and shear.

The half-space is z >= 0, z into the body. Loads on its surface: pressure p > 0 and shear q_x, q_y (force per area on
this body), so sigma_zz = -p, tau_xz = -q_x, tau_yz = -q_y at z = 0. Coefficients of uniform rectangles follow from the
potentials of Boussinesq and Cerruti (Johnson, Contact Mechanics, sections 3.2 and 3.6; Love 1929; Liu & Wang 2002).
"""

import copy

import numpy as np
import pyfftw

COMPONENTS = ("sxx", "syy", "szz", "sxy", "sxz", "syz")


def _corners(F, x, y, a, b):
    """F summed over the corners of the rectangle |x| <= a, |y| <= b with alternating signs."""
    return F(x + a, y + b) - F(x + a, y - b) - F(x - a, y + b) + F(x - a, y - b)


def pressure_coefficients(x, y, a, b, nu):
    """(sxx, syy, sxy) at (x, y, 0) from unit pressure on |x| <= a, |y| <= b; no point may lie on an edge line."""
    inside = (np.abs(x) < a) & (np.abs(y) < b)
    c = (1 - 2 * nu) / (2 * np.pi)
    sxx = -2 * nu * inside - c * _corners(lambda X, Y: np.arctan(Y / X), x, y, a, b)
    syy = -2 * nu * inside - c * _corners(lambda X, Y: np.arctan(X / Y), x, y, a, b)
    return sxx, syy, -c / 2 * _corners(lambda X, Y: np.log(X * X + Y * Y), x, y, a, b)


def shear_x_coefficients(x, y, a, b, nu):
    """(sxx, syy, sxy) at (x, y, 0) from unit q_x on |x| <= a, |y| <= b; no point may lie on an edge line."""
    sxx = _corners(lambda X, Y: np.arcsinh(Y / np.abs(X)) + nu * Y / np.hypot(X, Y), x, y, a, b) / np.pi
    syy = _corners(lambda X, Y: np.arcsinh(Y / np.abs(X)) - Y / np.hypot(X, Y), x, y, a, b) * nu / np.pi
    sxy = _corners(lambda X, Y: np.arcsinh(X / np.abs(Y)) - 2 * nu * X / np.hypot(X, Y), x, y, a, b) / (2 * np.pi)
    return sxx, syy, sxy


def shear_y_coefficients(x, y, a, b, nu):
    """(sxx, syy, sxy) at (x, y, 0) from unit q_y: the q_x case with x and y exchanged."""
    syy, sxx, sxy = shear_x_coefficients(y, x, b, a, nu)
    return sxx, syy, sxy


def strip_coefficient(x, a):
    """sxx at x from unit q_x on the endless strip |x| <= a (plane strain; pressure adds -p where it acts)."""
    return -2 / np.pi * np.log(np.abs((x + a) / (x - a)))


class SurfaceStress:
    """Surface stresses on a uniform half domain, y >= 0 mirrored (p, q_x even in y; q_y odd), or on a whole one.

    x (nx+1,), y (ny+1,) in m, y[0] = 0; one row of y means plane strain. nu: Poisson's ratio. mirrored=False: nothing acts
    at y < 0.
    line=True: p and q_x of the last y row go on to infinity; that part is plane strain (analytic strip), the deviation
    from it a convolution over the rectangles around the nodes. line=False: nothing acts outside the domain.
    Raises ValueError for a grid that is not uniform, or a single row without line=True.
    """

    def __init__(self, x, y, nu, line=True, mirrored=True):
        self.x, self.y, self.nu, self.line = np.asarray(x, float), np.asarray(y, float), float(nu), line
        if self.y.size == 1 and not line:
            raise ValueError("one row of y describes a line contact only (line=True)")
        dx = _spacing(self.x)
        lags = np.arange(-self.x.size + 1, self.x.size) * dx
        self.strip = strip_coefficient(lags, dx / 2)
        if self.y.size > 1:
            self.convolution = _Convolution(self.x.size, self.y.size, dx, _spacing(self.y), self.nu, mirrored)

    def __call__(self, p, qx, qy):
        """{component: (nx+1, ny+1) Pa} for p, qx, qy (nx+1, ny+1) Pa: sxx, syy, szz, sxy, sxz, syz."""
        p, qx, qy = (np.asarray(v, float) for v in (p, qx, qy))
        sxx, syy, sxy = np.zeros((3, *p.shape))
        far_p, far_q = np.zeros((2, p.shape[0]))
        if self.line:
            far_p, far_q = p[:, -1], qx[:, -1]
            sxx, syy = (np.repeat(s[:, None], p.shape[1], axis=1) for s in self._plane_strain(far_p, far_q))
        if self.y.size > 1:
            rest = self.convolution(p - far_p[:, None], qx - far_q[:, None], qy)
            sxx, syy, sxy = sxx + rest[0], syy + rest[1], rest[2]
        return dict(zip(COMPONENTS, (sxx, syy, -p, sxy, -qx, -qy)))

    def twin(self):
        """A second operator with the same coefficients and buffers of its own, for another thread."""
        other = copy.copy(self)
        if self.y.size > 1:
            other.convolution = copy.copy(self.convolution)
            other.convolution._plan()
        return other

    def _plane_strain(self, p, q):
        sxx = np.convolve(q, self.strip)[q.size - 1: 2 * q.size - 1] - p
        return sxx, self.nu * (sxx - p)


class _Convolution:
    """Zero-padded real transforms of the loads on 2 ny + 1 mirrored rows (or as they are); results on the rows y >= 0."""

    def __init__(self, nx, ny, dx, dy, nu, mirrored=True):
        self.nx, self.ny, self.mirrored = nx, ny, mirrored
        self.shape = _even_fast(2 * nx - 1), _even_fast(3 * ny - 2)
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
        loads = (pressure_coefficients, shear_x_coefficients, shear_y_coefficients)
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
        """(sxx, syy, sxy), each (nx, ny), from loads of that shape."""
        qy = qy * _no_axis(qy) if self.mirrored else qy
        loads = [self._mirrored(p, 1), self._mirrored(qx, 1), self._mirrored(qy, -1)]
        return [self._back(sum(load * row[n] for load, row in zip(loads, self.spectra))) for n in range(3)]

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


def _even_fast(n):
    n = pyfftw.next_fast_len(n)
    while n % 2:
        n = pyfftw.next_fast_len(n + 1)
    return n


def _spacing(v):
    steps = np.diff(v)
    if v.size < 2 or not np.allclose(steps, steps.mean(), rtol=1e-6):
        raise ValueError("surface stresses need a uniform grid of at least two nodes")
    return float(steps.mean())
