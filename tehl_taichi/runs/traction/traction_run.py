"""Traction curves as a sweep of a steady, smooth contact: slip fastest, then speed, then inlet temperature."""

import dataclasses
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.sweep import axis_syntax, sweeping
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.runs.traction.traction_rows import LOAD, PRESSURE, SPEED, SRR, TEMPERATURE, Traction
from tehl_taichi.scene import Scene, idle_keys
from tehl_taichi.scene.aliases import check_swept, full_name
from tehl_taichi.store.load_scene import find
from tehl_taichi.values.checks import CHANGES, table

SRRS = "0:0.5:11"  # of the usual curve
KEYS = {TEMPERATURE: "operation.temperature", LOAD: "contact.load", PRESSURE: "contact.hertz_pressure", SPEED: "operation.u_m",
        SRR: "operation.srr"}


def traction(scene: Scene | str | PathLike, srr: Any = SRRS, temperature: Any = None, speed: Any = None, *,
             load: Any = None, hertz_pressure: Any = None, changes: dict | None = None, path: str | PathLike | None = None,
             workers: int | None = None, threads_per_worker: int | None = None, progress: Callable | None = None,
             work: Any = None) -> Traction:
    """Compute traction curves: see :func:`tehl_taichi.traction`; work: as for :func:`tehl_taichi.runs.sweep.sweeping.run`."""
    return computed(traction_plan(find(scene), srr, temperature, speed, changes, load, hertz_pressure), path, workers=workers,
                    threads_per_worker=threads_per_worker, progress=progress, work=work)


def computed(found, path=None, **options):
    """The Traction of a :func:`traction_plan`; path, options: as for :func:`traction`."""
    return Traction(sweeping.run(found, default_path(found) if path is None else path, keep="summary", **options))


def traction_plan(scene, srr=SRRS, temperature=None, speed=None, changes=None, load=None, hertz_pressure=None):
    """The :class:`tehl_taichi.runs.sweep.plan.Plan` of the curves. Raises SceneError.

    Temperatures are computed in all cases unless switched off, also in pure rolling, so that one curve compares like with like.
    """
    table("changes", changes or {}, CHANGES)
    if srr is None:
        raise SceneError(f"srr = None is no list; allowed: numbers, or text, as {SRRS!r}")
    changes = {full_name(key): value for key, value in (changes or {}).items()}
    given = {TEMPERATURE: temperature, LOAD: load, PRESSURE: hertz_pressure, SPEED: speed, SRR: srr}
    swept = {key: axis_syntax.column(values) for key, values in given.items() if values is not None}
    for key in swept:
        if KEYS[key] in changes:
            raise SceneError(f"{key} is swept and {KEYS[key]} = {changes[KEYS[key]]!r} sets it: give one of them")
    changes |= {KEYS[key]: swept.pop(key)[0] for key in (LOAD, PRESSURE) if key in swept and _is_one(swept[key])}
    check_swept(changes, swept)
    smooth = _smooth(scene)
    heat = {"thermal.on": True} if smooth.thermal.on == "auto" else {}
    return plan(smooth.replace(**{**heat, **changes}), swept)


def _smooth(scene):
    """The scene without its features; keys of a passage, which it no longer has, do not count as given by the user."""
    smooth = dataclasses.replace(scene, features=())
    own = idle_keys.user_keys(scene) - (idle_keys.idle(smooth).keys() - idle_keys.idle(scene).keys())
    return smooth.with_user_keys(own, scene.replaced)


def _is_one(values):
    """Whether it is a list of one value, which then holds for all curves."""
    return isinstance(values, list) and len(values) == 1


def default_path(found):
    """Default path, equal for equal curves, so that a repeated command resumes them."""
    return Path("runs") / f"{found.name.replace('-sweep-', '-traction-')}.zarr"
