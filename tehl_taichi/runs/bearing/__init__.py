"""Rolling bearings: load of every element, contacts with both rings, a run of each.

`rolling_bearing` is the input, `designations` published dimensions, `bearing_source` reads what names a bearing. Equations:
`ring_contacts`, `stiffness`, `load_distribution`, `kinematics`, `ellipse_slip`, `dry_contact`, `static_safety`. `ring_scenes`
makes the scenes, `bearing_run` is the whole, `stored_bearing` its folder, with table and figure.
"""

from tehl_taichi.runs.bearing.bearing_run import bearing
from tehl_taichi.runs.bearing.stored_bearing import Bearing

__all__ = ["Bearing", "bearing"]
