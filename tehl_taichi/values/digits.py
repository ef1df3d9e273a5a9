"""How many digits of a number are told, and its error leaves."""

import math


def micrometres(length):
    """A length (m) in micrometres: whole ones, below ten two digits."""
    return f"{length * 1e6:.0f}" if length >= 9.95e-6 else f"{length * 1e6:.2g}"


def decimals(error):
    """Decimals with which two digits of an error (more than 0) are told; may be negative."""
    return 1 - math.floor(math.log10(error))
