"""Fourier transforms of fields on the surface of a body, and inverse."""

import numpy as np

from tehl_taichi.engine.fftw import SINGLE, half, half_back, pyfftw, transformed


class Waves:
    """Waves of fields on `columns` x `rows` nodes, padded with zeros to a period of nx x ny.

    mirrored: fields are even or odd about their first row, as are their spectra, of which ny//2+1 modes of y are kept. kind:
    precision of spectra and values.
    """

    def __init__(self, columns, rows, nx, ny, mirrored, kind=SINGLE):
        self.columns, self.rows, self.nx, self.ny, self.mirrored, self.kind = columns, rows, nx, ny, mirrored, kind
        self.modes = ny // 2 + 1 if mirrored else ny

    def spectrum(self, values, odd=False, factor=1):
        """Spectrum (nx//2+1, modes) of `factor` times values (columns, rows)."""
        return transformed(self._whole(half(values, self.nx, 0, self.kind), odd, factor))[:, : self.modes]

    def values(self, spectrum, odd=False, factor=1, rows=slice(None)):
        """Values (columns, rows) of `factor` times a spectrum; rows: slice of the rows to compute."""
        whole = self._whole(spectrum, odd, factor / (self.nx * self.ny))
        across = transformed(whole, "FFTW_BACKWARD")[:, : self.rows]
        if self.mirrored and odd:
            across[:, 0] = 0  # to the last digit: planes that are mirror images of each other stay as good as each other
        return half_back(across[:, rows], self.nx, 0, self.kind)[: self.columns]

    def _whole(self, part, odd, factor):
        """Complete (waves, ny) from the first half of rows or modes: zeros after it, its image at the end."""
        out, size = pyfftw.empty_aligned((part.shape[0], self.ny), self.kind), part.shape[1]
        image = min(size - 1, self.ny - size) if self.mirrored else 0
        np.multiply(part, factor, out=out[:, :size])
        out[:, size : self.ny - image] = 0
        if image:
            np.multiply(part[:, image:0:-1], -factor if odd else factor, out=out[:, self.ny - image :])
        if self.mirrored and odd:  # nothing where it is its own image
            out[:, [0, self.ny // 2] if self.ny == 2 * (size - 1) else 0] = 0
        return out
