"""Units of numbers by the ends of their names, as in summaries."""

UNITS = {"m": "m", "m2": "m2", "m3": "m3", "Pa": "Pa", "C": "degC", "K": "K", "s": "s", "deg": "degree", "J": "J", "W": "W",
         "N": "N", "kg": "kg"}


def unit_of(name):
    """Unit of a number: h_min_m is in m, load_error has none ("")."""
    return UNITS.get(name.rpartition("_")[2], "") if "_" in name else ""


def without_unit(name):
    """A name without the unit at its end: h_min for h_min_m."""
    head = name.rpartition("_")[0]
    return head if head and unit_of(name) else name


# sizes below which a number is nearly nothing, so that a change in per cent of it says nothing: a film of a few molecules of
# oil, a pressure that moves nothing in a contact of steel, a thousandth of a coefficient, share or index
NOTHING = {"m": 5e-9, "Pa": 1e6, "": 1e-3}


def nothing_of(name):
    """Size (SI) below which a number with this name counts as zero; 0: none."""
    return NOTHING.get(unit_of(name), 0.0)
