"""Short scene file for a scan, with only the keys that a user has to set."""

import os
import tomllib
from pathlib import Path

from tehl_taichi.disk import user_files
from tehl_taichi.errors import SceneError
from tehl_taichi.scene import scene, scene_file
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.scene_file import toml_value
from tehl_taichi.scene.sections import Body
from tehl_taichi.scene.surface.maps import height_map, stated_keys
from tehl_taichi.scene.surface.maps.refusals import HeightsRefused, KeyMissing
from tehl_taichi.scene.surface.shapes.profile import LAYS
from tehl_taichi.values.checks import build

LINES, LETTERS = 20, 100  # of the header of a file, shown
TAPER, SHARE = 40e-6, 8  # m, and of the shorter side
LINE = "N/m: of a line of contact, 280 N/mm are 280e3"
ROWS = " in a row of the file; rows run along x, the rolling direction"
PIXEL_Y = "pixel_y = {:<13}  # m: distance between rows\n"
NO_PIXEL_Y = "# pixel_y = 2e-6         # m: distance between rows, if it differs from pixel\n"
KINDS = {False: "heights on a grid", True: "heights along a line"}
MIRROR = "# mirror_{:<16}  # if the first {} enters the contact first\n"
LAY = "lay = {:<17}  # direction of the marks; {}\n"

HEAD = """\
# A scan passes through a contact. Replace the numbers of the built-in scene {base} by yours; SI units,
# temperatures in deg C. Other values are those of {base}; `tehl new all.toml` writes every key with unit and range.
base = "{base}"

[contact]
radius_x = {radius:<12}  # m: reduced radius 1/(1/R_a + 1/R_b), 7.5e-3 of 12 and 20 mm
{radius_y}\
load = {load:<16}  # {load_about}

[operation]
u_a = {u_a:<17}  # m/s: speed of the scanned surface, relative to the contact
u_b = {u_b:<17}  # m/s: speed of the other surface (or give u_m, the mean, and srr = (u_a - u_b)/u_m)
temperature = {temperature:<9}  # deg C: of oil and bodies at the inlet

[bodies]                   # by name (`tehl steels`), or your own E, nu, k, rho, c, alpha
{body_a}a.material = "100Cr6"      # the scanned body
{body_b}b.material = "100Cr6"      # the other body

# [oil]                    # your oil by its data sheet; without: {oil}
# name = "our gear oil"
# nu_40 = 220e-6           # m2/s: at 40 deg C
# nu_100 = 19e-6           # m2/s: at 100 deg C
# rho_15 = 890             # kg/m3: at 15 deg C
# source = "data sheet"

[fatigue]
kappa = {kappa:<15}  # of your steel, as the next value
torsion_limit = {limit:<7}  # Pa: fatigue limit in reversed torsion (or bending_limit, or both, which also give kappa)
source = "example values, set your own"

[[feature]]
shape = {shape:<15}  # {shape_about}
file = {file}
{header}\
unit = {unit:<16}  # unit of the heights: nm, um, mm or m
pixel = {pixel:<15}  # m: distance between points{rows}
{direction}\
level = "form"           # removes plane and curvature of the body ("plane": only the plane)
taper = {taper:<15}  # m: width over which the heights fade out at the rim
# cutoff = 25e-6         # m: Gaussian low-pass for roughness that the grid does not resolve
"""


def new(path, base, scan, unit="", pixel=0.0, pixel_y=0.0, lay=""):
    """Write a scene file for the heights in the file `scan` on the contact of the built-in scene `base`.

    Values that are not given are taken from the file. Returns (description of the scan, keys that are still to be filled in,
    reason why the scene is refused for now or ""). Raises SceneError if nothing can be written, or if the file contradicts
    given values.
    """
    path, scan = Path(path), Path(scan)
    scene_file.check_new(path)
    table = height_map.table_of(scan)
    _check_options(scan, height_map.is_profile(table.values), pixel_y, lay)
    unit, pixel = unit or table.stated.unit, pixel or stated_keys.likely_distance(table.stated.x)
    text = _text(path, scene(base), base, scan, table, unit, pixel, pixel_y, lay or "transverse")
    refused = _refusal(path, text)
    user_files.text(path, text)
    return _read(table), [key for key, value in (("unit", unit), ("pixel", pixel)) if not value], refused


def scan_keys(scan, unit="", pixel=0.0):
    """Keys of a feature with the heights in the file `scan`: form removed, faded out at the rim.

    Values that are not given are taken from the file. Raises SceneError.
    """
    table = height_map.table_of(Path(scan))
    pixel = pixel or stated_keys.likely_distance(table.stated.x)
    return dict(shape="profile" if height_map.is_profile(table.values) else "map", file=str(scan), pixel=pixel, level="form",
                unit=unit or table.stated.unit, taper=_taper(table, pixel))


def _refusal(path, text):
    """Reason why the scene cannot run, for keys that may be right in another context; "" if it can, or if a key is still
    missing. Raises SceneError for keys that are surely wrong.
    """
    data = scene_file.with_folder(tomllib.loads(text), path.absolute().parent)
    try:
        build(Feature, data["feature"][0], "feature", "feature")
    except KeyMissing:
        return ""
    except HeightsRefused as error:
        return str(error)
    try:
        scene_file.from_data(data, path.stem)
    except SceneError as error:  # in the contact of the base, which is another one than the user's
        return str(error)
    return ""


def _read(table):
    """Description of the heights that were read."""
    rows, columns = table.values.shape
    found = f"{rows} rows of {columns} points" if rows > 1 else f"a line profile of {columns} points"
    steps = [f"{step * 1e6:.4g} um" for step in map(stated_keys.likely_distance, (table.stated.x, table.stated.y)) if step]
    unit = [f"heights in {table.stated.unit}"] if table.stated.unit else []
    stated = unit + ([f"points {' x '.join(dict.fromkeys(steps))} apart"] if steps else [])
    return ", ".join([found, *filter(None, [table.skipped]), *([f"{', '.join(stated)} as the file says"] if stated else []),
                      *([] if steps else _coordinates(table.spacing[0]))])


def _coordinates(spacing):
    """Lines about coordinates in a file that does not state their unit."""
    return [f"coordinates {spacing:g} apart: {stated_keys.in_units(spacing)}"] if spacing else []


def _check_options(scan, profile, pixel_y, lay):
    """Refuse options for another kind of file; lay is checked with the scene."""
    if pixel_y and profile:
        raise SceneError(f"--pixel-y {pixel_y:g} has no effect: {scan} is a line profile")
    if lay and not profile:
        raise SceneError(f"--lay {lay} has no effect: {scan} is a map; feature.transpose turns it")
    if lay and lay not in LAYS:
        raise SceneError(f"--lay {lay!r} is not known; allowed: {', '.join(LAYS)}")


def _direction(profile, pixel_y, lay):
    """Lines with the distance of rows and the orientation of the heights."""
    if not profile:
        spacing = PIXEL_Y.format(toml_value(pixel_y)) if pixel_y else NO_PIXEL_Y
        return spacing + MIRROR.format("x = true", "column")
    mirror = MIRROR.format("x = true", "point") if lay == "transverse" else ""
    return LAY.format(toml_value(lay), "; ".join(map(": ".join, LAYS.items()))) + mirror


def _text(path, f, base, scan, table, unit, pixel, pixel_y, lay):
    profile, place = height_map.is_profile(table.values), Path(os.path.relpath(scan, path.absolute().parent)).as_posix()
    numbers = dict(radius=f.contact.radius_x, load=float(f"{f.load:.4g}"), u_a=round(f.operation.u_a, 6),
                   u_b=round(f.operation.u_b, 6), temperature=f.operation.temperature, kappa=f.fatigue.kappa, file=place,
                   shape="profile" if profile else "map", unit=unit, pixel=pixel,
                   taper=_taper(table, pixel, pixel_y))
    return HEAD.format(base=base, oil=f.oil.name, limit="380e6", header=_header(table), radius_y=_radius_y(f.contact),
                       body_a=_unless_steel(f.body_a), body_b=_unless_steel(f.body_b),
                       load_about=LINE if f.contact.kind == "line" else "N",
                       rows="" if profile else ROWS, shape_about=KINDS[profile], direction=_direction(profile, pixel_y, lay),
                       **{key: toml_value(value) for key, value in numbers.items()})


def _unless_steel(body):
    """Start of the line of a body: '# ' (a comment) if the base has another body than steel, such as a glass disc."""
    return "" if body == Body() else "# "


def _radius_y(contact):
    if contact.kind == "line":
        return ""
    return f"radius_y = {toml_value(contact.radius_y):<12}  # m: reduced radius across\n"


def _taper(table, pixel, pixel_y=0.0):
    """Taper in m: whole micrometres, at most an eighth of the shorter side. pixel, pixel_y: distances in m; pixel_y = 0: as the
    file says, or equal to pixel.
    """
    steps = pixel, pixel_y or stated_keys.likely_distance(table.stated.y) or pixel
    side = min((count - 1) * step for count, step in zip(table.values.shape[::-1], steps) if count > 1)
    return round(max(int(min(TAPER, side / SHARE) * 1e6), 1) * 1e-6, 9) if side else TAPER


def _header(table):
    """Lines before the first row, as comments: instruments write unit and distances there."""
    return "".join(f"#   its header: {_plain(line.strip())}\n" for line in table.header_lines[:LINES])


def _plain(line):
    """Text without letters that are not allowed in TOML comments."""
    return "".join(letter if letter.isprintable() else " " for letter in line)[:LETTERS]
