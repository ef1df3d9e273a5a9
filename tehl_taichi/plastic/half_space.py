"""Residual stress and surface displacement of plastic strain in layers of an elastic half-space.

Fourier waves along x and y, one linear element per layer in depth. Each wave is a system of three displacements at the
interfaces of the layers; with i u_x and i u_y as unknowns its matrix is real. Components: xx, yy, zz, xy, xz, yz (tensor), z
into the body.
"""

import numpy as np

FASTEST = (3, 5, 7)  # factors of the lengths of transforms, which are odd: no wave is its own mirror image
PAD = 2.0            # lengths of the region after which it repeats


def odd_length(n):
    """Smallest odd length >= n with a fast transform; 1 for a single row."""
    n = n | 1
    while n > 1 and _rest(n) > 1:
        n += 2
    return n


def _rest(n):
    for factor in FASTEST:
        while n % factor == 0:
            n //= factor
    return n


class LayeredHalfSpace:
    """Half-space of `body` below a region of `shape` cells with sides dx, dy (m); layers: a
    :class:`tehl_taichi.plastic.layers.Layers`.
    """

    def __init__(self, body, shape, sides, layers, pad=PAD):
        self.shape, self.h, self.count = shape, layers.thickness, layers.count
        self.G = body.E / 2 / (1 + body.nu)
        self.lame = 2 * self.G * body.nu / (1 - 2 * body.nu)
        self.size = tuple(odd_length(int(np.ceil(pad * n))) if n > 1 else 1 for n in shape)
        kx = 2 * np.pi * np.fft.fftfreq(self.size[0], sides[0])
        ky = 2 * np.pi * np.fft.rfftfreq(self.size[1], sides[1])
        self.kx, self.ky = (k.ravel() for k in np.meshgrid(kx, ky, indexing="ij"))
        self._factorise()

    def _factorise(self):
        """Eliminate the interfaces from the fixed bottom up; stores inverse diagonal blocks and the blocks towards the
        interface below.
        """
        blocks = [self._blocks(h) for h in self.h]
        self.inverse, self.below = [], [block[:3, 3:] for block in blocks]
        above = 0.0
        for n in range(len(self.h) - 1, -1, -1):
            whole = blocks[n][:3, :3] + (blocks[n - 1][3:, 3:] if n else 0.0) - above
            self.inverse.insert(0, np.linalg.inv(whole.transpose(2, 0, 1)).transpose(1, 2, 0))
            if n:
                towards = self.below[n - 1]
                above = np.einsum("ijk,jlk,mlk->imk", towards, self.inverse[0], towards)

    def _blocks(self, h):
        """Stiffness (6, 6, waves) of a layer: forces at its two interfaces by their displacements."""
        out = np.empty((6, 6, self.kx.size))
        for n in range(6):
            u = np.zeros((6, self.kx.size))
            u[n] = 1.0
            out[:, n] = self._forces(self.stress(self._strain(u, h)), h)
        return out

    def _strain(self, u, h):
        """Strain (6, waves) in a layer by the displacements (6, waves) at its two interfaces."""
        (x, y, z), (dx, dy, dz) = 0.5 * (u[:3] + u[3:]), (u[3:] - u[:3]) / h
        kx, ky = self.kx, self.ky
        return np.stack([-kx * x, -ky * y, dz, -0.5 * (ky * x + kx * y), 0.5 * (dx + kx * z), 0.5 * (dy + ky * z)])

    def _forces(self, s, h):
        """Forces (6, waves) at the two interfaces of a layer that balance a stress (6, waves) in it."""
        kx, ky = self.kx, self.ky
        mean = 0.5 * h * np.stack([-kx * s[0] - ky * s[3], -ky * s[1] - kx * s[3], kx * s[4] + ky * s[5]])
        down = np.stack([s[4], s[5], s[2]])
        return np.concatenate([mean - down, mean + down])

    def stress(self, strain):
        """Elastic stress (6, ...) of a strain (6, ...)."""
        out = 2 * self.G * strain
        out[:3] += self.lame * strain[:3].sum(axis=0)
        return out

    def answer(self, strain):
        """Response to plastic strain (layers, 6, x, y): (residual stress, displacement of the surface into the body, m, (x,
        y)).

        The strain may have fewer layers than the half-space; the layers below are elastic.
        """
        waves = self._waves(strain)
        u = self._solve(self._loads(waves))
        found = np.stack([self.stress(self._strain(np.concatenate([u[n], u[n + 1]]), self.h[n]) - wave)
                          for n, wave in enumerate(waves)])
        found[:, 4:] *= 1j
        return self._fields(found), self._fields(u[0, 2])

    def pressed(self, p):
        """Stress (layers, 6, x, y) under a pressure p (x, y) on the surface."""
        loads = np.zeros((self.count + 1, 3, self.kx.size), complex)
        loads[0, 2] = np.fft.rfft2(p, self.size).ravel()
        u = self._solve(loads)
        found = np.stack([self.stress(self._strain(np.concatenate([u[n], u[n + 1]]), self.h[n])) for n in range(self.count)])
        found[:, 4:] *= 1j
        return self._fields(found)

    def _waves(self, strain):
        """Fourier transform (layers, 6, waves) of a strain; xz and yz have the phase of the displacement unknowns."""
        waves = np.fft.rfft2(strain, self.size).reshape(*strain.shape[:2], -1)
        waves[:, 4:] /= 1j
        return waves

    def _fields(self, waves):
        """Inverse transform: values (..., x, y) of the region."""
        shape = (*waves.shape[:-1], self.size[0], self.size[1] // 2 + 1)
        nx, ny = self.shape
        return np.fft.irfft2(waves.reshape(shape), self.size)[..., :nx, :ny]

    def _loads(self, waves):
        """Forces (interfaces, 3, waves) that balance plastic strain, down to its deepest layer."""
        out = np.zeros((len(waves) + 1, 3, self.kx.size), complex)
        for n, wave in enumerate(waves):
            forces = self._forces(self.stress(wave), self.h[n])
            out[n] += forces[:3]
            out[n + 1] += forces[3:]
        return out

    def _solve(self, f):
        """Displacements (interfaces, 3, waves) under forces (overwritten); no forces act below their last interface."""
        for n in range(len(f) - 1, 0, -1):
            f[n - 1] -= _times(self.below[n - 1], _times(self.inverse[n], f[n]))
        u = np.empty_like(f)
        u[0] = _times(self.inverse[0], f[0])
        for n in range(1, len(f)):
            u[n] = _times(self.inverse[n], f[n] - _times(self.below[n - 1].transpose(1, 0, 2), u[n - 1]))
        return u


def _times(matrix, vector):
    """Products of matrices (3, 3, waves) with vectors (3, waves)."""
    return np.einsum("ijk,jk->ik", matrix, vector)
