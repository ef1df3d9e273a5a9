"""In which units numbers are read, how many digits of them are told, and an error leaves."""

import math

# of SI units: (up to below this size, factor, unit that people read)
SCALES = {"m": ((1e-3, 1e6, "µm"), (1.0, 1e3, "mm")), "Pa": ((1e9, 1e-6, "MPa"), (math.inf, 1e-9, "GPa")),
          "m2/s": ((math.inf, 1e6, "mm²/s"),), "1/Pa": ((math.inf, 1e9, "1/GPa"),)}


def fitting(unit, size):
    """(factor, unit) for numbers of about `size` in the SI unit `unit`: 2e9 Pa are read in GPa."""
    known = ((factor, shown) for below, factor, shown in SCALES.get(unit, ()) if abs(size) < below)
    return next(known, (1.0, unit))


def micrometres(length):
    """A length (m) in micrometres: whole ones, below ten two digits."""
    return f"{length * 1e6:.0f}" if length >= 9.95e-6 else f"{length * 1e6:.2g}"


def decimals(error):
    """Decimals with which two digits of an error (more than 0) are told; may be negative."""
    return 1 - math.floor(math.log10(error))
