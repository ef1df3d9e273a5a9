"""Likely meaning of a number out of its range: the same digits in another usual unit."""

import math

# {unit: [(power of ten, its name)]}
WRITTEN = {"m": ((-3, "mm"), (-6, "um"), (-9, "nm")), "Pa": ((6, "MPa"), (9, "GPa")), "N/m": ((3, "N/mm"),), "N": ((3, "kN"),),
           "m/s": ((-3, "mm/s"),), "kg/m3": ((3, "kg/l"),), "m2/s": ((-6, "mm2/s"),), "1/Pa": ((-9, "1/GPa"), (-6, "1/MPa")),
           "Pa s": ((-3, "mPa s"),), "1/K": ((-6, "um/mK"),), "J/kgK": ((3, "kJ/kgK"),), "N m": ((3, "kN m"),),
           "Pa sqrt(m)": ((6, "MPa sqrt(m)"),), "mm": ((3, "m"), (-3, "um")), "N/mm": ((-3, "N/m"), (3, "kN/mm")),
           "µm": ((6, "m"), (3, "mm"))}
KELVIN = 273.15  # of 0 deg C


def hint(value, unit, fits, usual=0.0):
    """Text '; did you mean 400e6 Pa (400 MPa)?', or '' if no usual unit makes the value valid.

    fits: function of a value in `unit`, whether it is allowed; usual: a value of the usual order (0: unknown), the nearest
    candidate is named.

    >>> hint(206, "Pa", lambda value: value > 1e6, usual=2e11)
    '; did you mean 206e9 Pa (206 GPa)?'
    """
    if unit == "deg C" and fits(value - KELVIN):
        return f"; did you mean {value - KELVIN:g} deg C ({value:g} K)?"
    found = [(power, name) for power, name in WRITTEN.get(unit, ()) if value and fits(value * 10.0**power)]
    if not found:
        return ""
    power, name = min(found, key=lambda one: _apart(value * 10.0**one[0], usual))
    digits = f"{value:g}"
    scaled = f"{value * 10.0**power:g}" if "e" in digits else f"{digits}e{power}"
    return f"; did you mean {scaled} {unit} ({digits} {name})?"


def _apart(value, usual):
    """Powers of ten between the two; 0 without a usual value, so the order of `WRITTEN` decides."""
    return abs(math.log10(abs(value / usual))) if usual else 0.0
