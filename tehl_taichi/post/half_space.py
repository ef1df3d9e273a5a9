"""Surface stresses of body a from its pressure and shear tractions (Boussinesq, Cerruti), uniform rectangles.

z points into the body: sigma_zz = -p, tau_xz = -q_x, tau_yz = -q_y at z = 0. Closed forms integrated from Johnson,
Contact Mechanics, sections 3.2 and 3.6 (Love 1929 for the pressure). The part of a line contact that does not vary in y
is treated as plane strain in closed form; only the deviation from it is convolved in two dimensions, because a
truncated three-dimensional sum of a line load is wrong by percents.
"""

import numpy as np
import pyfftw


def _even_fast(n):
    length = pyfftw.next_fast_len(n)
    while length % 2:
        length = pyfftw.next_fast_len(length + 1)
    return length


def _corners(F, x, y, dx, dy):
    """F at the four corners of the cell, with alternating signs."""
    a, b = dx / 2, dy / 2
    return F(x + a, y + b) - F(x + a, y - b) - F(x - a, y + b) + F(x - a, y - b)


def pressure_kernels(x, y, dx, dy, nu):
    """(sxx, syy, sxy) at offset (x, y), arrays, from unit pressure on the cell dx x dy at the origin."""
    inside = (np.abs(x) < dx / 2) & (np.abs(y) < dy / 2)
    c = (1 - 2 * nu) / (2 * np.pi)
    sxx = -2 * nu * inside - c * _corners(lambda X, Y: np.arctan(Y / X), x, y, dx, dy)
    syy = -2 * nu * inside - c * _corners(lambda X, Y: np.arctan(X / Y), x, y, dx, dy)
    sxy = -c / 2 * _corners(lambda X, Y: np.log(X * X + Y * Y), x, y, dx, dy)
    return sxx, syy, sxy


def shear_kernels(x, y, dx, dy, nu):
    """(sxx, syy, sxy) at offset (x, y) from unit traction q_x on the cell at the origin."""
    def ahead(X, Y):
        return np.arcsinh(Y / np.abs(X))

    sxx = _corners(lambda X, Y: ahead(X, Y) + nu * Y / np.hypot(X, Y), x, y, dx, dy) / np.pi
    syy = nu / np.pi * _corners(lambda X, Y: ahead(X, Y) - Y / np.hypot(X, Y), x, y, dx, dy)
    sxy = _corners(lambda X, Y: np.arcsinh(X / np.abs(Y)) - 2 * nu * X / np.hypot(X, Y), x, y, dx, dy) / (2 * np.pi)
    return sxx, syy, sxy


def strip_kernel(x, dx):
    """sxx at distance x from unit traction q_x on a strip of width dx, infinite in y: -(2/pi) ln|(x+a)/(x-a)|."""
    return -2 / np.pi * np.log(np.abs((x + dx / 2) / (x - dx / 2)))


class SurfaceStress:
    """Surface stress operator on a grid x (nx+1,), y (ny+1,) m with y >= 0 mirrored (p, q_x even; q_y odd).

    nu: Poisson's ratio; line: the outermost y row continues to infinity. A single y row is plane strain throughout.
    """

    def __init__(self, x, y, nu, line=True):
        self.nu, self.line = nu, line
        self.nx, self.ny, self.dx = x.size - 1, y.size - 1, x[1] - x[0]
        offsets = np.arange(-self.nx, self.nx + 1) * self.dx
        self.strip = strip_kernel(offsets, self.dx)
        if self.ny:
            self._plan(y[1] - y[0])

    def _plan(self, dy):
        self.shape = (_even_fast(2 * self.nx + 1), _even_fast(4 * self.ny + 1))
        x, y = np.arange(-self.nx, self.nx + 1) * self.dx, np.arange(-2 * self.ny, 2 * self.ny + 1) * dy
        X, Y = x[:, None] + 0 * y[None, :], y[None, :] + 0 * x[:, None]
        half = (self.shape[0], self.shape[1] // 2 + 1)
        self.real, self.spectrum = pyfftw.zeros_aligned(self.shape), pyfftw.zeros_aligned(half, dtype="complex128")
        self.forward = pyfftw.FFTW(self.real, self.spectrum, axes=(0, 1), flags=("FFTW_ESTIMATE",), threads=1)
        self.inverse = pyfftw.FFTW(self.spectrum, self.real, axes=(0, 1), direction="FFTW_BACKWARD",
                                   flags=("FFTW_ESTIMATE",), threads=1)
        p, qx = pressure_kernels(X, Y, self.dx, dy, self.nu), shear_kernels(X, Y, self.dx, dy, self.nu)
        swapped = shear_kernels(Y, X, dy, self.dx, self.nu)
        sources = (p, qx, (swapped[1], swapped[0], swapped[2]))
        self.kernels = [[self._transform(self._wrap(k)) for k in kernels] for kernels in sources]

    def _wrap(self, kernel):
        """Offsets -n..n put where a circular convolution wants them."""
        out = np.zeros(self.shape)
        ix = np.arange(-self.nx, self.nx + 1) % self.shape[0]
        iy = np.arange(-2 * self.ny, 2 * self.ny + 1) % self.shape[1]
        out[np.ix_(ix, iy)] = kernel
        return out

    def _transform(self, values):
        self.real[:] = values
        self.forward.execute()
        return self.spectrum.copy()

    def __call__(self, p, qx, qy):
        """(sxx, syy, szz, sxy, sxz, syz), each (nx+1, ny+1) like the inputs p, qx, qy (Pa)."""
        sxx, syy, sxy = np.zeros_like(p, float), np.zeros_like(p, float), np.zeros_like(p, float)
        edge_p, edge_q = p[:, -1:], qx[:, -1:]
        if self.line:
            line = -edge_p + self._strip(edge_q[:, 0])[:, None]
            sxx, syy = sxx + line, syy + self.nu * (line - edge_p)
            p2, qx2 = p - edge_p, qx - edge_q
        else:
            p2, qx2 = p, qx
        if self.ny:
            parts = self._plane(p2, qx2, qy)
            sxx, syy, sxy = sxx + parts[0], syy + parts[1], sxy + parts[2]
        return sxx, syy, -p.astype(float), sxy, -qx.astype(float), -qy.astype(float)

    def _strip(self, q):
        return np.convolve(q, self.strip)[self.nx : 2 * self.nx + 1]

    def _plane(self, p, qx, qy):
        spectra = [self._transform(self._mirror(f, s)) for f, s in ((p, 1), (qx, 1), (qy, -1))]
        out = []
        for component in range(3):
            self.spectrum[:] = sum(s * k[component] for s, k in zip(spectra, self.kernels))
            self.inverse.execute()
            out.append(self.real[: self.nx + 1, : self.ny + 1] / self.real.size)
        return out

    def _mirror(self, field, sign):
        """Field on y >= 0 laid out with its mirror image at negative y (circular)."""
        out = np.zeros(self.shape)
        out[: self.nx + 1, : self.ny + 1] = field
        out[: self.nx + 1, self.shape[1] - self.ny :] = sign * field[:, :0:-1]
        return out
