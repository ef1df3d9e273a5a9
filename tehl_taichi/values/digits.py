"""How many digits of a number its error leaves."""

import math


def decimals(error):
    """Decimals with which two digits of an error (more than 0) are told; may be negative."""
    return 1 - math.floor(math.log10(error))
