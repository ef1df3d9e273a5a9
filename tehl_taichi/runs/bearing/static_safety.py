"""Static safety: ratio of the load at the Hertz pressure limit of ISO 76 to the present load.

At this limit the permanent deformation of element and raceway is about 0.0001 of the diameter of the element.
"""

LIMITS = {"ball": 4.2e9, "roller": 4.0e9}  # Pa, ISO 76:2006, 3.2 (self-aligning ball bearings: 4.6e9)
POINT, LINE = 3, 2  # the load grows with this power of the pressure


def limit(bearing):
    """Hertz pressure (Pa) of the static load rating."""
    return LIMITS[bearing.element]


def safety(bearing, p_H, line=False):
    """Load at the limiting pressure over the load at the Hertz pressure p_H (Pa); line: for a line contact."""
    return (limit(bearing) / p_H) ** (LINE if line else POINT)
