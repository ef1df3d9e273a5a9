"""The way of the first feature through the contact: how far a time step goes, how many there are, where a cut one ends."""

import math

from tehl_taichi.scene.scales import Scales

OIL_CELLS = 1.5  # a step of a passage moves the faster surface by at most so many cells
LATEST = 1.1  # a, from X = 0 to the features where they are outside the contact
ALL = -1  # as time.steps


def step_cells(scene):
    """Cells that the first feature moves in a time step: the fastest one moves time.courant; with temperatures a whole fraction
    of it where the other surface is much faster."""
    cells = scene.time.courant / max((s.pace for s in scene.surfaces if s.features), default=1.0)
    if scene.isothermal:
        return cells
    other = next(s for s in scene.surfaces if s.name != scene.reference.name)
    return cells / max(1, math.ceil(cells * other.pace / OIL_CELLS - 1e-9))


def step_length(scene):
    """Way of the first feature in a time step, a."""
    return step_cells(scene) * (scene.grid.x_max - scene.grid.x_min) / scene.grid.nx


def total_steps(scene):
    """Number of time steps after the steady start (0 for a steady scene)."""
    if not scene.transient:
        return 0
    start, end = scene.path
    steps = math.ceil((end - start) / step_length(scene) - 1e-9)
    return steps if scene.time.steps == ALL else min(steps, scene.time.steps)


def moments(scene):
    """(how many stored moments fatigue.from_x and to_x leave, position in a of the first step and of the last)."""
    (start, _), steps, every = scene.path, total_steps(scene), scene.output.every
    end, apart = start + steps * step_length(scene), every * step_length(scene)
    first = max(0, math.ceil((max(scene.fatigue.from_x, start) - start) / apart - 1e-9))
    last = math.floor((min(scene.fatigue.to_x, end) - start) / apart + 1e-9)
    beside = steps % every > 0 and scene.fatigue.from_x <= end <= scene.fatigue.to_x  # the last step is stored in any case
    return max(0, last - first + 1) + beside, start, end


def cut_at(scene):
    """Position (a) at which the passage ends although its features still are in the contact, else None."""
    if not scene.transient:
        return None
    end = scene.path[0] + total_steps(scene) * step_length(scene)
    return end if end < clear(scene) - 1e-9 else None


def clear(scene):
    """Position of the first feature (a) from which on all of them are behind the contact."""
    a = Scales.of(scene).a
    return max((LATEST + (f.reach - f.x) / a) / s.pace for s, f in scene.passing)


def uncut(scene):
    """The scene with its whole passage: every step, until the features are behind the contact."""
    end = {"time.x_end": math.inf} if scene.transient and scene.path[1] < clear(scene) else {}
    return scene.replace(**{"time.steps": ALL, **end})


def most_steps(scene):
    """Time steps that a run of this scene may ever have, also when a cut passage continues to its end."""
    return total_steps(uncut(scene))


def continued(scene, done, more=None):
    """The scene of a run of `done` steps with the rest of its passage, or with `more` steps of it; None where none is left."""
    whole = uncut(scene)
    if total_steps(whole) <= done:
        return None
    return whole if more is None or done + more >= total_steps(whole) else whole.replace(**{"time.steps": done + more})
