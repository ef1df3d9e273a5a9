"""Result of `tehl crack`, kept beside the store of its run for the report: STORE with .crack.json."""

import json
import os

import numpy as np

from tehl_taichi.disk import files, user_files
from tehl_taichi.errors import StoreError
from tehl_taichi.store.json_values import plain

DEPTHS = 60  # of the section that is kept


def path_of(store):
    """Path of the crack result of a store."""
    path = store.absolute()
    return path.with_name(f"{path.stem if path.suffix == '.zarr' else path.name}.crack.json")


def check(store):
    """Check that the crack result of a store can be written. Raises StoreError."""
    user_files.check(path_of(store), force=True)


def save(result, store):
    """Write a :class:`tehl_taichi.crack.analysis.CrackResult` beside its store; replaces an earlier one. Returns the path.
    Raises StoreError.
    """
    path = path_of(store.path)
    content = {"run": store.attrs.get("date"), "summary": result.summary, "drawn": _drawn(result)}
    user_files.text(path, json.dumps({"program": user_files.PROGRAM, **plain(content)}), force=True)
    return path


def load(store):
    """{"summary", "drawn"} of the stored crack result of a run, or None. Raises StoreError if it is damaged."""
    path = path_of(store.path)
    if not os.path.isfile(path):
        return None
    try:
        content = files.json_of(path)
        return content if content["run"] == store.attrs.get("date") else None  # else of a run that was here before
    except (ValueError, KeyError, TypeError, RecursionError, OSError) as error:
        raise StoreError(f"{path} is damaged ({error}); remove it, or write it again with `tehl crack --keep`") from None


def _drawn(result):
    """Data of the figures (m, Pa): tension of the section at even depths, every line as rows (x', depth)."""
    plane, lines = result.plane, [line for side in result.sides.values() for line in (side.trajectory, side.path.points)]
    even = np.linspace(0.0, min(1.3 * max([40e-6, *(line.imag.max() for line in lines)]), plane.depths[-1]), DEPTHS)
    wide = max([plane.reach, *(np.abs(side.path.points.real).max() for side in result.sides.values())])
    near = np.abs(plane.x) <= 1.3 * wide  # trajectories may lead out of it
    tension = [np.interp(even, plane.depths, row) for row in np.maximum(plane.sigma1()[near], 0.0)]
    sides = {name: _side(side) for name, side in result.sides.items()}
    return {"x": plane.x[near], "depth": even, "tension": np.round(tension, -4), "position": plane.centres[:-1] / plane.a,
            "sides": sides}


def _side(side):
    path = side.path
    cracks = [] if path.last is None else [path.last] if path.first is path.last else [path.first, path.last]
    K = [{"length": crack.faces.a, "K_I": crack.K[0, :-1], "K_II": crack.K[1, :-1], "oil": crack.pressure[:-1]}
         for crack in cracks]
    return {"trajectory": _rows(side.trajectory), "path": _rows(path.points), "K": K}


def _rows(points):
    return np.stack([points.real, points.imag], axis=1)
