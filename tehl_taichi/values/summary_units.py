"""Units of numbers by the ends of their names, as summaries have them."""

UNITS = {"m": "m", "Pa": "Pa", "C": "degC", "K": "K", "s": "s", "deg": "degree", "J": "J", "W": "W", "N": "N", "kg": "kg"}


def unit_of(name):
    """Unit of a number: h_min_m is in m, load_error in nothing ("")."""
    return UNITS.get(name.rpartition("_")[2], "") if "_" in name else ""
