"""Computation of a cycle of a cam: its angles, their runs, the record of both."""

import dataclasses
from os import PathLike

from tehl_taichi.errors import SceneError, for_reader
from tehl_taichi.runs.bearing.ring_scenes import base_of, smooth
from tehl_taichi.runs.cam import cam_columns, cam_table, stored_cam
from tehl_taichi.runs.cam.stored_cam import Cam
from tehl_taichi.runs.flank import further_columns
from tehl_taichi.runs.flank.flank_run import all_changes, first_free_folder
from tehl_taichi.runs.flank.line_contacts import scene_at, scene_with_grid_at
from tehl_taichi.runs.flank.outcomes import computed
from tehl_taichi.runs.progress import Progress, progress_of
from tehl_taichi.scene import Scene, grid_for_features, idle_keys
from tehl_taichi.scene.feature import USED_BY, Feature
from tehl_taichi.scene.scales import Scales
from tehl_taichi.store.json_values import plain
from tehl_taichi.store.load_scene import find
from tehl_taichi.values.path_arguments import path_of

ASSUMPTION = ("each angle is a separate contact with constant load and speeds: squeezing of the film over the cycle is not "
              "computed")
WAITING = "it has not run yet; repeat the tehl cam command with --out to resume"


def cam(table: str | PathLike, *, feature: Feature | None = None, scene: Scene | str | PathLike | None = None,
        changes: dict | None = None, steady: bool = False, folder: str | PathLike | None = None, workers: int | None = None,
        threads: int | None = None, progress: Progress | None = None) -> Cam:
    """Compute a cam: see :func:`tehl_taichi.cam`."""
    path = path_of("table", table)
    places = cam_table.load(path)
    further_columns.check(path, places, stored_cam.KEYS, cam_columns.COLUMNS)
    start = find(scene) if scene is not None else smooth(find())
    base = base_of(start, feature)
    changes = all_changes(changes or {}, steady)
    steady = not base.features or changes.get("time.steady_only", False)
    passes = {"time.steady_only": steady}
    own, choose = base if base.features and not steady else smooth(base), grid_for_features.is_grid_open(start, changes)
    chosen = scene_with_grid_at if choose and feature is not None and not steady else _with_own_grid
    found = {n: chosen(_as_it_moves(own, at), {**changes, **passes}, path.stem, n + 1, at) for n, at in enumerate(places)
             if not at.without_film}
    scenes = {n: one for n, (one, _) in found.items()}
    if not scenes:
        raise SceneError(f"table {path}: no angle has a film; the first one: {places[0].without_film}")
    target = path_of("folder", folder) if folder else first_free_folder(path.stem)
    made = Cam(target, cam_record(path, target, places, scenes))
    Cam.check_writable(target, made)
    for grid in (grid for _, grid in found.values() if grid):
        progress_of(progress).say(for_reader(grid))
    numbers, films = list(scenes), list(scenes.values())
    return computed(made, lambda one, n, outcome: one.with_position(numbers[n], outcome), films, workers, threads, progress)


def _as_it_moves(base, at):
    """The base scene, with mirrored features for a position whose contact moves backwards."""
    if at.u_a + at.u_b >= 0:
        return base
    features = tuple(_mirrored(f) for f in base.features)
    return dataclasses.replace(base, features=features).with_user_keys(idle_keys.user_keys(base), base.replaced)


def _mirrored(f):
    """Mirror image of a feature along x; shapes without `mirror_x` are even."""
    turned = {"mirror_x": not f.mirror_x} if f.shape in USED_BY["mirror_x"] else {}
    return dataclasses.replace(f, x=0.0 - f.x, offset_x=0.0 - f.offset_x, **turned)


def _with_own_grid(*position):
    """(scene of a position on the grid of its base scene, no text); arguments: :func:`scene_at`."""
    return scene_at(*position), ""


def cam_record(path, folder, places, scenes):
    """JSON object of `tehl cam --json` before the runs."""
    one = next(iter(scenes.values()))
    return plain({"name": path.stem, "folder": str(folder), "source": str(path), "assumption": ASSUMPTION, "oil": one.oil.name,
                  "temperature_C": one.operation.temperature,
                  "positions": [_position(at, folder, scenes.get(n)) for n, at in enumerate(places)]})


def _position(at, folder, scene):
    return {"angle_deg": at.angle, "R_m": at.R, "load_N_m": at.load, "u_a_m_s": at.u_a, "u_b_m_s": at.u_b, "u_m_m_s": at.u_m,
            "srr": at.srr, "p_Hertz_Pa": Scales.of(scene).p_H if scene else None, **at.more,
            "store": str(folder / f"{scene.name}.zarr") if scene else None, "converged": False,
            "reason": WAITING if scene else at.without_film, "summary": None}
