"""FFTW for all modules: `from tehl_taichi.engine.fftw import pyfftw`.

The package also offers its transforms to dask and scipy and imports both if they are installed: 0.9 s of every start, for
functions that are not used here.
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

__all__ = ["DOUBLE", "SINGLE", "even_fast_length", "half", "half_back", "pyfftw", "real_of", "transform", "transform_back",
           "transformed"]
KEPT, KEPT_BYTES = 32, 2_000_000  # kinds of arrays whose plans are kept, and their largest size
SINGLE, DOUBLE = np.dtype(np.complex64), np.dtype(np.complex128)  # kinds of spectra


def even_fast_length(n):
    """Smallest even length >= n with a fast FFTW transform (odd ones are slow)."""
    length = pyfftw.next_fast_len(n)
    while length % 2:
        length = pyfftw.next_fast_len(length + 1)
    return length


def transform(values, length, kind=SINGLE):
    """Transform (..., length) of values (..., n), padded with zeros.

    numpy's transform is far slower in single precision than in double (1024 of 330 numbers to 480: 8.3 and 3.3 ms, this one
    1.6).
    """
    return transformed(_padded(values, length, -1, kind))


def transform_back(spectra):
    """Inverse of :func:`transform`, in single precision."""
    out = transformed(_padded(spectra, spectra.shape[-1], -1, SINGLE), "FFTW_BACKWARD")
    out /= spectra.shape[-1]
    return out


def transformed(numbers, direction="FFTW_FORWARD"):
    """Transform of complex numbers in an aligned buffer, in place; the backward one is `length` times as large."""
    _run(numbers, numbers, -1, direction)
    return numbers


def half(values, length, axis, kind=SINGLE):
    """First half of the transform of `length` real numbers along `axis`, padded with zeros."""
    given = _padded(values, length, axis, real_of(kind))
    out = pyfftw.empty_aligned(_with(given.shape, axis, length // 2 + 1), kind)
    _run(given, out, axis)
    return out


def half_back(spectra, length, axis, kind=SINGLE):
    """`length` real numbers along `axis` from the first half of their spectra, `length` times as large."""
    out = pyfftw.empty_aligned(_with(spectra.shape, axis, length), real_of(kind))
    _run(_padded(spectra, spectra.shape[axis], axis, kind), out, axis, "FFTW_BACKWARD")
    return out


def _padded(values, length, axis, kind):
    """Buffer for FFTW with these values, padded with zeros to the given length along `axis`."""
    out, before = pyfftw.empty_aligned(_with(values.shape, axis, length), kind), (slice(None),) * (axis % values.ndim)
    out[(*before, slice(values.shape[axis]))] = values
    out[(*before, slice(values.shape[axis], None))] = 0
    return out


def real_of(kind):
    """Type of the real numbers for a kind of spectra."""
    return np.float32 if kind == SINGLE else np.float64


def _with(shape, axis, length):
    shape = list(shape)
    shape[axis] = length
    return tuple(shape)


_idle: dict[tuple, list] = {}  # plans that no thread uses, by the kind of their arrays


def _run(given, target, axis, direction="FFTW_FORWARD"):
    """Run on one thread with an estimated plan for aligned numbers: equal plans, and so equal bits, in every run."""
    key = given.shape, given.strides, given.dtype, target.shape, target.strides, target.dtype, axis, direction, given is target
    try:
        plan = _idle[key].pop()
        plan.update_arrays(given, target)
    except (KeyError, IndexError, ValueError):  # ValueError: arrays of another alignment
        plan = pyfftw.FFTW(given, target, axes=(axis,), direction=direction, flags=("FFTW_ESTIMATE",), threads=1)
    plan.execute()
    if given.nbytes + target.nbytes <= KEPT_BYTES:
        _keep(key, plan)


def _keep(key, plan):
    """Keep a plan, with the arrays that it holds, for transforms of equal arrays: a new one takes 50 us."""
    if len(_idle) >= KEPT and key not in _idle:
        _idle.clear()
    _idle.setdefault(key, []).append(plan)
