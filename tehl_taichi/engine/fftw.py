"""FFTW, as every module takes it: `from tehl_taichi.engine.fftw import pyfftw`.

Its package offers transforms to dask and to scipy, too, and imports both where they are installed: 0.9 s of every start, for
what nobody here calls.
"""

import contextlib
import sys

import numpy as np

OFFERED_TO = ("dask.array.fft", "scipy.fftpack")


@contextlib.contextmanager
def _as_if_not_installed(names):
    hidden = [name for name in names if name not in sys.modules]
    sys.modules.update(dict.fromkeys(hidden))  # None there: its import fails at once
    try:
        yield
    finally:
        for name in hidden:
            del sys.modules[name]


with _as_if_not_installed(OFFERED_TO):
    import pyfftw

__all__ = ["pyfftw", "single", "single_back", "single_real"]


def single(values, length):
    """Transform (..., length) in single precision of values (..., n), zeros behind them: numpy's takes far longer than in
    double precision (1024 of 330 numbers to 480: 8.3 and 3.3 ms, this 1.6)."""
    out = pyfftw.zeros_aligned((*values.shape[:-1], length), np.complex64)
    out[..., : values.shape[-1]] = values
    _run(out, out, -1)
    return out


def single_back(spectra):
    """The way back of :func:`single`."""
    out = pyfftw.empty_aligned(spectra.shape, np.complex64)
    out[...] = spectra
    _run(out, out, -1, "FFTW_BACKWARD")
    out /= spectra.shape[-1]
    return out


def single_real(spectra, length, axis):
    """`length` real numbers along `axis` from the first half of their spectra, in single precision."""
    given, out = pyfftw.empty_aligned(spectra.shape, np.complex64), list(spectra.shape)
    given[...], out[axis] = spectra, length
    out = pyfftw.empty_aligned(out, np.float32)
    _run(given, out, axis, "FFTW_BACKWARD")
    out /= length
    return out


def _run(given, wanted, axis, direction="FFTW_FORWARD"):
    """On one thread by an estimated plan for aligned numbers: the same plan, so the same bits, in every run."""
    pyfftw.FFTW(given, wanted, axes=(axis,), direction=direction, flags=("FFTW_ESTIMATE",), threads=1).execute()
