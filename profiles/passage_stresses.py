"""Results of one stored passage: Findley stresses of both bodies by loads and by part of the passage, and which its grid does
not know."""

import json
from dataclasses import asdict, dataclass

import numpy as np

from tehl_taichi.disk import files
from tehl_taichi.errors import StoreError
from tehl_taichi.fatigue import contact_alone, depth_profile, exact_depths, findley
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.stress.row_histories import at_the_surface
from tehl_taichi.march.accuracy import coarse_runs, readings
from tehl_taichi.runs.single_run import run_or_resume
from tehl_taichi.scene import Scene
from tehl_taichi.scene.scales import Scales
from tehl_taichi.store.store_draft import removed
from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.values.coded_text import Reason, code_of

WINDOWS = {"entry": (-np.inf, -0.5), "inside": (-0.5, 0.5), "exit": (0.5, np.inf), "to 0.5 a": (-np.inf, 0.5),
           "whole": (-np.inf, np.inf)}
# what counts: pressure alone, with the shear tractions, with thermal stress too
LOADS = {"pressure": {"fatigue.shear": False, "fatigue.thermal_stress": False},
         "no thermal stress": {"fatigue.thermal_stress": False}, "all": {}}
# the worst below the surface under the feature's row, up to 0.5 a and over the whole passage, and of the contact without it
DEEP, ALONE = {window: ("below", window) for window in ("to 0.5 a", "whole")}, ("contact alone", "whole")
DEPTHS = {**{key: ("depth", window) for window, key in DEEP.items()}, ALONE: ("depth alone", "whole")}
FRICTION_AT = (-0.5, 0.5)  # a
LARGE = 100_000  # cells of a passage whose store is not kept: of 2048x64 it has 6 GB


@dataclass(frozen=True)
class PassageStresses:
    """values: {body: {(loads, window): largest Findley stress, Pa}}, DEEP and ALONE (Pa) and their DEPTHS (m) among them;
    courses: {window: the pressures' :func:`course`}; friction: :func:`footprint_friction` at FRICTION_AT; doubts: {(loads,
    window): why the grid does not know it}."""

    values: dict
    courses: dict
    friction: tuple
    doubts: dict


def read_passage(description, store):
    """The :class:`PassageStresses` of a scene by its run in the store at this path: as it lies there, resumed, or run now.

    A LARGE one is removed after it was read; its answers, in a file beside it, serve the next time. Raises StoreError where the
    store or the file is of another scene, NotConverged.
    """
    kept = store.with_suffix(".json")
    if not kept.exists():
        found = of(run_or_resume(description, store).store)
        if description.grid.nx * description.grid.ny <= LARGE:
            return found
        content = {**asdict(found), "courses": list(found.courses.items())}
        content["values"] = {body: list(values.items()) for body, values in found.values.items()}
        content["doubts"] = [(key, [why, code_of(why)]) for key, why in found.doubts.items()]
        files.replace(kept, json.dumps({"scene": description.to_dict(), **content}).encode())
    found = _kept(kept, description)
    if store.exists():  # still, where an earlier end of the suite left a part of it
        removed(store)
    return found


def _kept(path, description):
    content = json.loads(path.read_text())
    if Scene.from_dict(content.pop("scene")) != description:
        raise StoreError(f"{path} belongs to another scene; choose another folder or remove it")
    if not isinstance(content["values"], dict):
        raise StoreError(f"{path} is of version 0.8, which judged body a alone; choose another folder or remove it")
    values = {body: {tuple(key): value for key, value in part} for body, part in content["values"].items()}
    doubts = {tuple(key): Reason(*([why] if isinstance(why, str) else why)) for key, why in content["doubts"]}
    courses = {window: tuple(pressures) for window, pressures in content["courses"]}
    return PassageStresses(values, courses, tuple(content["friction"]), doubts)


def of(saved):
    """The :class:`PassageStresses` of a finished store."""
    values = {surface.name: stresses(saved, surface) for surface in saved.scene.surfaces}
    return PassageStresses(values, {window: course(saved, *ends) for window, ends in WINDOWS.items()},
                           tuple(footprint_friction(saved, at) for at in FRICTION_AT), unresolved(saved))


def _largest(saved):
    """Positions of the feature (a) and the largest pressures (Pa), of all entries but the start."""
    return saved.scalar("feature_x")[1:] / Scales.of(saved.scene).a, saved.scalar("p_max_Pa")[1:]


def course(saved, low, high):
    """The :func:`tehl_taichi.march.accuracy.coarse_runs.course` of a stored passage between two positions of its feature
    (a)."""
    at, p = _largest(saved)
    inside = (at >= low) & (at <= high)
    return coarse_runs.course(p[inside], at[inside], saved.scene.path)


def unresolved(saved):
    """{(loads, window): why the grid does not know it}, of windows with a pressure peak that it does not resolve."""
    a, (at, p) = Scales.of(saved.scene).a, _largest(saved)
    entries = {window: 1 + np.flatnonzero((at >= low) & (at <= high)) for window, (low, high) in WINDOWS.items()}
    doubts = {window: readings.pressure_doubt(saved, those, p[those - 1].max(), a) for window, those in entries.items()
              if those.size}
    keys = [(loads, window) for loads in LOADS for window in WINDOWS] + [*DEEP.values()]
    return {key: doubts[key[1]] for key in keys if doubts.get(key[1])}


def stresses(saved, surface):
    """{(loads, window): largest Findley stress of a body, Pa}; windows with every load, others over the whole passage."""
    out = {}
    for loads, changes in LOADS.items():
        passage = _histories(saved, surface, changes)
        history = at_the_surface(passage)(slice(0, passage.y.size))
        for window, (low, high) in WINDOWS.items():
            if loads == "all" or window == "whole":
                inside = _moments(passage, low, high)
                out[loads, window] = float(findley.search(history[:, inside], saved.scene.fatigue.kappa)[0].max())
    return out | deep_stresses(_histories(saved, surface))


def _histories(saved, surface, changes=None):
    scene = saved.scene.replace(**changes) if changes else saved.scene
    return StressHistories(scene, saved, saved.scalar("feature_x"), surface=surface)


def _moments(passage, low, high):
    """Moments of a history with the feature between `low` and `high` (in a), and the one without load."""
    return np.append((passage.positions >= low * passage.a) & (passage.positions <= high * passage.a), True)


def deep_stresses(passage):
    """DEEP, ALONE and their depths."""
    row = nearest_index(passage.reader.y, passage.scene.features[0].y)
    windows = [_moments(passage, *WINDOWS[window]) for window in DEEP]
    deep = exact_depths.computed(passage, [row], depth_profile.profiles(passage, [row], windows), windows)
    alone = contact_alone.search(passage.scene, passage.reader, passage.surface).summary
    found = [(profile.worst.f, profile.worst.depth) for profile in deep]
    return {key: value for stress, pair in zip(DEPTHS, [*found, (alone["findley_stress_max_Pa"], alone["depth_m"])])
            for key, value in zip((stress, DEPTHS[stress]), pair)}


def footprint_friction(saved, at):
    """Friction over load on the feature's footprint when it is at x_a = at (in a)."""
    a = Scales.of(saved.scene).a
    n = nearest_index(saved.scalar("feature_x") / a, at)
    fields = saved.fields(n, ("pressure", "traction_x_a"))
    distance = np.hypot(saved.x[:, None] - saved.feature_x(n), saved.y[None, :])
    under = distance < saved.scene.features[0].reach
    return float(abs(fields["traction_x_a"][under].sum()) / fields["pressure"][under].sum())
