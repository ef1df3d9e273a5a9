"""Bearings with published inner dimensions, and the sources.

Catalogues give bore, outside diameter and ratings, but not balls and grooves. `estimated` names unpublished keys; their values
are those behind the ratings of ISO 76 and ISO 281.
"""

import re
from dataclasses import dataclass, replace

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.bearing.rolling_bearing import BALL
from tehl_taichi.values.checks import missing_file, nearest

INCH = 25.4e-3
CASE = "Case Western Reserve University, Bearing Data Center, bearing information (SKF, inches)"
HARRIS = "Harris & Kotzalas, Rolling Bearing Analysis, 5th ed. 2006, examples"
SEPARATOR = re.compile(r"[-/_\s]+")
WORD = re.compile(r"[a-z]{5,}")  # roller, tapered, needle: another bearing; codes of seals, cage and clearance are shorter
GROOVES = ("osculation_inner", "osculation_outer")


@dataclass(frozen=True)
class Designation:
    """Entry of a bearing. says: description; keys: of its :class:`RollingBearing`; source; estimated: keys that the source does
    not give; rating: text about a rating that agrees with the keys; note: further text.
    """

    says: str
    keys: dict
    source: str
    estimated: tuple = GROOVES
    rating: str = ""
    note: str = ""


DESIGNATIONS = {
    "6203": Designation("deep groove ball bearing, 17 x 40 x 12 mm",
                        dict(diameter=0.2656 * INCH, count=8, pitch_diameter=1.122 * INCH), f"{CASE}, 6203-2RS JEM"),
    "6205": Designation("deep groove ball bearing, 25 x 52 x 15 mm",
                        dict(diameter=0.3126 * INCH, count=9, pitch_diameter=1.537 * INCH), f"{CASE}, 6205-2RS JEM"),
    "6206": Designation("deep groove ball bearing, 30 x 62 x 16 mm",
                        dict(diameter=9.525e-3, count=9, pitch_diameter=46e-3),
                        "SKF product page, bearing frequencies (9 balls of 9.53 mm on 46 mm; 3/8 inch balls)",
                        rating="with the static factor of ISO 76 they give the catalogue's static rating of 11.2 kN"),
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
MEANT = "give its elements by --ball-diameter, --balls and --pitch-diameter (rollers: `tehl roller`), or a TOML file"


def key_of(name):
    """Key of a designation in the table, also with a suffix for seals, cage and clearance (6206-2RS1, 6206 C3); "" if it is not
    in the table.
    """
    key, suffix = _parts(name)
    return "" if WORD.search(suffix) else key


def _parts(name):
    """(key, suffix) of a designation; key "" if it is not in the table."""
    words = SEPARATOR.sub("-", name.lower().replace("skf", " ")).strip("-")
    key = max((key for key in DESIGNATIONS if f"{words}-".startswith(f"{key}-")), key=len, default="")
    return key, words[len(key) + 1:] if key else ""


def designation(name):
    """The :class:`Designation` with this name; its note says which suffix is ignored. Raises SceneError."""
    key, suffix = _parts(name)
    if not key:
        missing_file(name)
        raise SceneError(f"the inner dimensions of bearing {name!r} are not in the table of this program"
                         f"{nearest(name.lower(), DESIGNATIONS)}; known: {', '.join(DESIGNATIONS)}; or {MEANT}")
    if WORD.search(suffix):
        raise SceneError(f"bearing {name!r}: {suffix!r} is no suffix of seals, cage or clearance, and {key} is a "
                         f"{DESIGNATIONS[key].says}; known: {', '.join(DESIGNATIONS)}; or {MEANT}")
    return replace(DESIGNATIONS[key], note=f"the suffix {suffix.upper()} is ignored" if suffix else "")


def of_element(element):
    """Designations of the bearings with these elements."""
    return [key for key, one in DESIGNATIONS.items() if one.keys.get("element", BALL) == element]
