"""Estimate of the time of a passage, from the steady start of its scene."""

import itertools
import math
import time

from tehl_taichi.errors import Error
from tehl_taichi.march.passage import march
from tehl_taichi.runs.pace import about
from tehl_taichi.scene import domain_warnings
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.timeline import total_steps, whole_passage
from tehl_taichi.store.store import Store
from tehl_taichi.values.digits import number_of

TRIED, COUNTED = 5, 3  # first steps that are tried, and those that count: kernels are compiled in the ones before
# Mean time of the steps of whole passages over that of their first ones. Scans: 1.5 to 2.3 (slopes of 1 to 6 deg, 128 to 512
# columns), 8 to 12 and 18 (4 and 10 deg, 128 columns, under 1.3 GPa with a film of 220 deg C); asperities: 1.3 to 2.5
SCAN, OTHER = 20, 3
MORE = 7  # passages of run-in more than those that are counted, at most: rounds of the first one
LONG = 300.0  # s, from which on something faster is named
SIDE = 1.2  # b, to the sides of a domain for the middle of a scan that is as wide as the contact


def lines(run, coarse):
    """Sentences about the time of the whole passage of a :class:`tehl_taichi.Run` that holds its steady start; a few trial
    steps are computed and not stored. [] for a steady scene. coarse: (nx, ny) of the grid to propose for a long run.
    """
    scene = whole_passage(run.scene)
    total, pace = total_steps(scene), _pace(run.path, scene) if run.scene.transient else None
    if not run.scene.transient or pace is None:
        return []
    most = _most(scene) * total * pace
    line = (f"the whole passage: {number_of(total, 'step')}, {about(total * pace)} at the speed of the first steps "
            f"({pace:.2g} s each); with {'a rough surface' if _scans(scene) else 'features'} in the contact steps take up to "
            f"{_most(scene)} times as long: up to {about(most)}; stresses and error bars "
            f"follow{', which take as long again for a wide scan' if _scans(scene) else ''}"
            f"{_repeated(scene)}")
    return [line, *(_faster(scene, coarse, most) if most > LONG else ())]


def _repeated(scene):
    """Text about the passages of run-in."""
    return f"; run-in repeats the passage up to {scene.time.run_in + MORE} times" if scene.runs_in else ""


def _pace(path, scene):
    """Seconds of one step after the steady start in the store; None if it does not converge."""
    with Store.write(path) as saved:
        state, ends = saved.go_back(), []
    try:
        for _ in itertools.islice(march(scene, state), TRIED):
            ends.append(time.perf_counter())
    except Error:
        return None
    counted = ends[-COUNTED - 1:]
    return (counted[-1] - counted[0]) / (len(counted) - 1) if len(counted) > 1 else None


def _scans(scene):
    return [n for n, feature in enumerate(scene.features) if feature.kind.measured]


def _most(scene):
    return SCAN if _scans(scene) else OTHER


def _faster(scene, coarse, seconds):
    """One sentence about ways to save time, estimated as nodes times steps."""
    ways = (("--grid {}x{}".format(*coarse), dict(zip(("grid.nx", "grid.ny"), coarse))), _middle(scene))
    faster = [f"{words} up to {about(seconds * share)}" for words, changes in ways
            if changes and (share := _share(scene, changes)) < 0.8]
    if faster:
        yield f"faster: {'; '.join(faster)}"


def _middle(scene):
    """(text, changes) that restrict a scan to its middle, as large as the contact."""
    s, g, changes = Scales.of(scene), scene.grid, {}
    for n in _scans(scene):
        for key, size, half in zip(("extent_x", "extent_y"), scene.features[n].patch, (s.a, s.b)):
            if 2 * half < size < math.inf:
                changes[f"feature.{key}" if len(scene.features) == 1 else f"feature.{n}.{key}"] = float(f"{2 * half:.2g}")
    if changes and g.y_max > SIDE:
        changes |= {"grid.y_max": SIDE, "grid.ny": domain_warnings.cells("ny", g.ny, SIDE / g.y_max)}
    return "the middle of the scan, " + " ".join(f"--set {key}={value:g}" for key, value in changes.items()) + ",", changes


def _share(scene, changes):
    """Nodes times steps of the changed scene over those of the scene; 1 if it is refused."""
    try:
        return _work(whole_passage(scene.replace(**changes))) / _work(scene)
    except Error:
        return 1.0


def _work(scene):
    return (scene.grid.nx + 1) * (scene.rows + 1) * total_steps(scene)
