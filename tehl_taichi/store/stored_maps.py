"""Height maps of a scene inside its store: it can be shown, resumed and run again without the map files."""

import os
from typing import Any

import numpy as np

from tehl_taichi.errors import StoreError, brief
from tehl_taichi.scene import Scene
from tehl_taichi.scene.feature import SHAPES
from tehl_taichi.scene.surface.maps import height_map
from tehl_taichi.store import array_file, layout


def write(folder, scene):
    """Store the heights of the scene's maps as they were read, each once, under the hash that its feature names. Returns the
    metadata of their arrays, {name: metadata}."""
    made: dict[str, Any] = {}
    for feature in scene.features:
        if feature.kind.measured and not os.path.exists(folder / (name := _name(feature.sha256))):
            made |= layout.whole(folder, name, np.asarray(feature.heights, float), [f"{name}_row", f"{name}_column"],
                                 feature.unit, "heights as in the file, neither turned nor levelled", sha256=feature.sha256,
                                 pixel_m=list(feature.file_steps), file=feature.file)
    return made


def scene_of(path, data):
    """Scene (nested dictionary) of the store at `path`, with its maps from the store, even if their files have changed.

    Raises StoreError if stored heights do not match their hash. A store of version 0.1.0 has only the name of the file.
    """
    maps = [feature for feature in data["feature"] if SHAPES[feature["shape"]].measured]
    held = [_heights(path, feature["sha256"]) for feature in maps if "sha256" in feature]  # known until the scene has them
    for feature in data["feature"]:
        if "unit" not in feature:
            _upgrade(feature)
    scene = Scene.from_dict(data)
    del held
    return scene


def _upgrade(feature):
    """Convert a feature of version 0.1.0 in place: `height` was m per unit of a map's file, and every feature had a pixel."""
    if SHAPES[feature["shape"]].measured:
        feature.update(unit="m", scale=feature.pop("height"))
    else:
        feature.pop("pixel", None)


def _heights(path, sha256):
    try:
        found, values = height_map.keep(array_file.read_whole(path / _name(sha256)))
    except Exception as error:
        raise StoreError(f"{path / _name(sha256)}: the stored height map cannot be read: {brief(error)}") from None
    if found != sha256:
        raise StoreError(f"{path / _name(sha256)}: the stored height map is damaged (its sha256 begins with {found[:12]}, not "
                         f"{sha256[:12]})")
    return values


def _name(sha256):
    return f"map_{sha256[:16]}"
