"""Passage of the first feature through the contact: length and number of time steps, end of a cut passage."""

import math

from tehl_taichi.scene.scales import Scales

OIL_CELLS = 1.5  # a step of a passage moves the faster surface by at most so many cells
# and, without temperatures, by at most this part of a if its stresses are searched: a body that moved 2.4 a between two moments
# had an index of 0.39 in place of 0.45, less than that of the smooth contact
STEEL_STEP = 1 / 4
LATEST = 1.1  # a, from X = 0 to the features where they are outside the contact
ALL = -1  # as time.steps


def step_cells(scene):
    """Cells that the first feature moves in a time step.

    The fastest feature moves time.courant; a whole fraction of that if the other surface is much faster and its temperatures or
    its stresses are computed.
    """
    cells = scene.time.courant / max((s.pace for s, _ in scene.passing), default=1.0)
    other = next(s for s in scene.surfaces if s.name != scene.reference.name)
    return cells / max(1, math.ceil(cells * other.pace / _most_cells(scene, other) - 1e-9))


def _most_cells(scene, other):
    """Cells that the other surface may move in a step."""
    if not scene.isothermal:
        return OIL_CELLS
    if not (scene.has_fatigue and other.name in (surface.name for surface in scene.judged)):
        return math.inf
    return max(OIL_CELLS, STEEL_STEP * scene.grid.nx / (scene.grid.x_max - scene.grid.x_min))


def step_length(scene):
    """Distance (a) that the first feature moves in a time step."""
    return step_cells(scene) * (scene.grid.x_max - scene.grid.x_min) / scene.grid.nx


def total_steps(scene):
    """Number of time steps after the steady start (0 for a steady scene)."""
    if not scene.transient:
        return 0
    start, end = scene.path
    steps = math.ceil((end - start) / step_length(scene) - 1e-9)
    return steps if scene.time.steps == ALL else min(steps, scene.time.steps)


def entries(scene):
    """Number of stored moments, with the steady start: every output.every steps, and the last one."""
    return 1 + math.ceil(total_steps(scene) / scene.output.every)


def moments(scene):
    """(number of stored moments between fatigue.from_x and to_x, position in a of the first step and of the last)."""
    (start, _), steps, every = scene.path, total_steps(scene), scene.output.every
    end, apart = start + steps * step_length(scene), every * step_length(scene)
    first = max(0, math.ceil((max(scene.fatigue.from_x, start) - start) / apart - 1e-9))
    last = math.floor((min(scene.fatigue.to_x, end) - start) / apart + 1e-9)
    beside = steps % every > 0 and scene.fatigue.from_x <= end <= scene.fatigue.to_x  # the last step is stored in any case
    return max(0, last - first + 1) + beside, start, end


def cut_at(scene):
    """Position (a) at which the passage ends while its features are still in the contact, else None."""
    if not scene.transient:
        return None
    end = scene.path[0] + total_steps(scene) * step_length(scene)
    return end if end < clear_position(scene) - 1e-9 else None


def clear_position(scene):
    """Position (a) of the first feature from which on all features have left the contact."""
    a = Scales.of(scene).a
    return max((LATEST + (f.reach - f.x) / a) / s.pace for s, f in scene.passing)


def whole_passage(scene):
    """Scene with the whole passage: every step, until the features have left the contact."""
    end = {"time.x_end": math.inf} if scene.transient and scene.path[1] < clear_position(scene) else {}
    return scene.replace(**{"time.steps": ALL, **end})


def most_steps(scene):
    """Largest number of time steps of a run of this scene, also if a cut passage is extended to its end."""
    return total_steps(whole_passage(scene)) if scene.transient else 0


def remaining_scene(scene, done, more=None):
    """Scene of a run after `done` steps with the rest of its passage, or with `more` steps; None at its end."""
    whole = whole_passage(scene)
    if total_steps(whole) <= done:
        return None
    return whole if more is None or done + more >= total_steps(whole) else whole.replace(**{"time.steps": done + more})
