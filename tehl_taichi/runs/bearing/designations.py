"""Bearings with published inner dimensions, and the sources.

Catalogues give bore, outside diameter and ratings, but not balls and grooves. `estimated` names unpublished keys; their values
are those behind the ratings of ISO 76 and ISO 281.
"""

import re
from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.values.checks import nearest

INCH = 25.4e-3
CASE = "Case Western Reserve University, Bearing Data Center, bearing information (SKF, inches)"
HARRIS = "Harris & Kotzalas, Rolling Bearing Analysis, 5th ed. 2006, examples"
SUFFIX = re.compile(r"[-/ ]")
GROOVES = ("osculation_inner", "osculation_outer")


@dataclass(frozen=True)
class Designation:
    """Entry of a bearing. says: description; keys: of its :class:`RollingBearing`; source; estimated: keys that the source does
    not give.
    """

    says: str
    keys: dict
    source: str
    estimated: tuple = GROOVES


DESIGNATIONS = {
    "6203": Designation("deep groove ball bearing, 17 x 40 x 12 mm",
                        dict(diameter=0.2656 * INCH, count=8, pitch_diameter=1.122 * INCH), f"{CASE}, 6203-2RS JEM"),
    "6205": Designation("deep groove ball bearing, 25 x 52 x 15 mm",
                        dict(diameter=0.3126 * INCH, count=9, pitch_diameter=1.537 * INCH), f"{CASE}, 6205-2RS JEM"),
    "6206": Designation("deep groove ball bearing, 30 x 62 x 16 mm",
                        dict(diameter=9.525e-3, count=9, pitch_diameter=46e-3),
                        "SKF product page, bearing frequencies (9 balls of 9.53 mm on 46 mm; 3/8 inch balls); with the static "
                        "factor of ISO 76 they give the catalogue's static rating of 11.2 kN"),
    "uer204": Designation("insert ball bearing of the XJTU-SY life tests",
                          dict(diameter=7.92e-3, count=8, pitch_diameter=34.55e-3),
                          "Wang, Lei, Li & Li, IEEE Trans. Reliability 69 (2020) 401, table 1 (LDK UER204)"),
    "209": Designation("deep groove ball bearing, 45 x 85 x 19 mm",
                       dict(diameter=12.7e-3, count=9, pitch_diameter=65e-3, osculation_inner=0.52, osculation_outer=0.52,
                            clearance=15e-6), HARRIS, ()),
    "218": Designation("angular-contact ball bearing, 90 x 160 x 30 mm, 40 deg",
                       dict(diameter=22.23e-3, count=16, pitch_diameter=125.3e-3, osculation_inner=0.5232,
                            osculation_outer=0.5232, contact_angle=40.0), HARRIS, ()),
    "209-roller": Designation("cylindrical roller bearing, 45 x 85 x 19 mm",
                              dict(element="roller", diameter=10e-3, count=14, pitch_diameter=65e-3, length=9.6e-3,
                                   clearance=41e-6), HARRIS, ()),
}
MEANT = "give its elements by --ball-diameter, --balls and --pitch-diameter (rollers: tehl roller), or a TOML file"


def key_of(name):
    """Key of a designation in the table, without suffixes for seals, cage and clearance (6206-2RS1, 6206 C3); "" if it is not
    in the table.
    """
    words = name.lower().replace("skf", "").strip()
    return next((key for key in (words, *SUFFIX.split(words, maxsplit=1)[:1]) if key in DESIGNATIONS), "")


def designation(name):
    """The :class:`Designation` with this name. Raises SceneError."""
    if not (key := key_of(name)):
        raise SceneError(f"the inner dimensions of bearing {name!r} are not in the table of this program"
                         f"{nearest(name.lower(), DESIGNATIONS)}; known: {', '.join(DESIGNATIONS)}; or {MEANT}")
    return DESIGNATIONS[key]
