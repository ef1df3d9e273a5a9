"""Unit and distances of a feature and of its file: missing ones are filled in, given ones must agree."""

import math
import os

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface.maps import height_map
from tehl_taichi.scene.surface.maps.length_units import UNITS
from tehl_taichi.scene.surface.maps.measured import FARTHEST, NEAREST
from tehl_taichi.scene.surface.maps.refusals import KeyMissing

SAME = 0.02  # relative difference of distances that are one: of rounded coordinates, and numbers in headers
KEYS = {"x": "pixel", "y": "pixel_y"}


def fill_in(f):
    """Fill in missing keys from the file. Raises SceneError if the file contradicts given keys or states impossible values."""
    facts = height_map.facts(f)
    _unit(f, facts.stated.unit)
    for axis in "xy" if f.heights.shape[0] > 1 else "x":
        _distance(f, KEYS[axis], getattr(facts.stated, axis))
    for key, step, found in zip(KEYS.values(), f.file_steps, facts.spacing):
        if found is not None and f.pixel:
            _check_spacing(f, key if getattr(f, key) else "pixel", step, found)


def _unit(f, unit):
    if f.unit and unit and f.unit != unit:
        raise SceneError(f"feature.unit = {f.unit!r} contradicts feature.file = {f.file!r}, which says {unit!r}; remove "
                         "feature.unit, or correct the file")
    if unit and not f.unit:
        object.__setattr__(f, "unit", unit)


def likely_distance(distances):
    """Most likely of these distances (m) with six digits, 0 without a possible one."""
    return float(f"{distances[0]:.6g}") if distances and NEAREST <= distances[0] <= FARTHEST else 0.0


def _distance(f, key, distances):
    """Fill in or check a distance. distances: stated in the file, m, the most likely first."""
    if not distances:
        return
    value, possible = getattr(f, key), likely_distance(distances)
    missing = not value and (key == "pixel" or not _like(f.pixel, distances))
    if missing and possible:
        object.__setattr__(f, key, possible)
    elif not value and key == "pixel":
        raise KeyMissing(f"feature.file = {os.path.basename(f.file)!r} says that its points are {distances[0]:.4g} m apart; "
                         f"allowed: {NEAREST:g} to {FARTHEST:g} m. Set feature.{key} to the true distance")
    elif value and possible and not _like(value, distances):
        raise SceneError(f"feature.{key} = {value:g} m contradicts feature.file = {f.file!r}, which says {distances[0]:.4g} m; "
                         f"remove feature.{key}, or correct the file")


def _like(value, distances):
    return any(math.isclose(value, one, rel_tol=SAME) for one in distances)


def _check_spacing(f, key, step, found):
    """Refuse a pixel size that contradicts the coordinates in the file in every unit."""
    if not any(math.isclose(found * unit, step, rel_tol=SAME) for unit in UNITS.values()):
        raise SceneError(f"feature.{key} = {step:g} m does not match the coordinates in feature.file = {f.file!r}, which are "
                         f"{found:g} apart: {in_units(found) or 'too near or too far in every unit'}")


def pixel_hint(f):
    """End of a sentence: distances of the file's coordinates in all units that make sense."""
    found = height_map.facts(f).spacing[0]
    each = in_units(found)
    return f"; its coordinates are {found:g} apart: {each}" if each else ""


def in_units(found):
    """Text of the possible distances in m of coordinates that are `found` apart, "" if none is possible."""
    return ", ".join(f"{found * size:.4g} m if they are in {unit}" for unit, size in UNITS.items()
                     if found and NEAREST <= found * size <= FARTHEST)


def words(f):
    """Texts (for the unit, for the distances) if the file states the value of the feature, else ""."""
    stated, same = height_map.facts(f).stated, " (as the file says)"
    return same * (stated.unit == f.unit), same * bool(stated.x and _like(f.pixel, stated.x))
