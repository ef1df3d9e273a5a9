"""FFTW, as every module takes it: `from tehl_taichi.engine.fftw import pyfftw`.

Its package offers transforms to dask and to scipy, too, and imports both where they are installed: 0.9 s of every start, for
what nobody here calls.
"""

import contextlib
import sys

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

__all__ = ["pyfftw"]
