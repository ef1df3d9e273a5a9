"""Rolling bearings: load of every element, contacts with both rings, one run per ring.

`rolling_bearing` is the input, `designations` holds published dimensions, `bearing_source` finds a bearing by its name.
Equations: `ring_contacts`, `stiffness`, `load_distribution`, `kinematics`, `ellipse_slip`, `dry_contact`, `static_safety`.
`ring_scenes` makes the scenes, `bearing_run` runs them, `stored_bearing` is the folder, with table and figure.
"""

from tehl_taichi.runs.bearing.bearing_run import bearing
from tehl_taichi.runs.bearing.stored_bearing import Bearing

__all__ = ["Bearing", "bearing"]
