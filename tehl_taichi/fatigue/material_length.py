"""Second index, of stresses averaged over fatigue.length.

A jump of the surface shear, as at the front of a rolling asperity, has no largest stress: the pointwise stress grows with every
finer grid, the averaged one converges (docs/decisions/10-material-length.md).
"""

import numpy as np

from tehl_taichi.fatigue import depth_search, every_moment, local_strength
from tehl_taichi.fatigue.averaged_candidates import Candidates
from tehl_taichi.fatigue.layer import layer
from tehl_taichi.fatigue.pass_progress import PassProgress
from tehl_taichi.fatigue.sought import Sought
from tehl_taichi.fatigue.stress.averaging import averaged_reader
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.worst_point import worst_of
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.scene import material_length


def counts(scene, x):
    """Whether there is such an index on nodes x (m)."""
    return not material_length.why_not(scene, (x[-1] - x[0]) / (len(x) - 1))


def part(scene, surface, reader, centres, progress, found=None, box=None, sought=Sought.ALL):
    """Part "averaged" of the summary of one body; centres: of the first feature, m; found: SearchResult of its stresses at
    points, which bound the averaged ones (None: search all points); box, sought: of this search; other arguments as in
    :func:`tehl_taichi.fatigue.assessment.run`.
    """
    averages, centres = averaged_reader(reader, scene.fatigue.length), np.asarray(centres)
    passage = _passage(scene, surface, averages, centres, box)
    progress = PassProgress.of(progress, scene, passage)
    top, some = _surface(scene, passage, averages, centres, progress, found, sought.brief)
    layers = [top, *(layer(scene, passage, depth, progress, None) for depth in scene.fatigue.listed)]
    deep = depth_search.search(scene, passage, layers, None, progress) if scene.fatigue.depths else depth_search.DepthResult()
    progress.end()
    layers, deep = every_moment.followed(scene, some, layers, deep)
    below = worst_of([found.worst for found in layers[1:]] + deep.worst)
    deepest = {"depth_m": below.depth, **below.summary(), **local_strength.of_point(passage, below)} if below else {}
    return {"length_m": scene.fatigue.length, **layers[0].worst.summary(), **({"below": deepest} if below else {})}


def _surface(scene, passage, averages, centres, progress, found, low=False):
    """(Layer of the surface, StressHistories of its points): of the points that may be the worst; of all points without a
    search `found` or if the criterion is not convex. low: whether `found` may have values of first planes."""
    if found is None or not CRITERIA[scene.fatigue.criterion].convex:
        return layer(scene, passage, 0.0, progress, None), passage
    candidates = Candidates(found, averages, low)
    box = candidates.first()
    while True:
        some = _passage(scene, passage.surface, averages, centres, box)
        top = layer(scene, some, 0.0, progress, None)
        box = candidates.wider(box, top.worst.f / top.worst.local.endurance)
        if not box:
            return top, some


def _passage(scene, surface, averages, centres, box=None):
    """StressHistories of averaged stresses, whose worst point is searched; box: Box of its points, or None."""
    out = StressHistories(scene, averages, centres, surface=surface, box=box, sought=Sought.WORST)
    out.steel = False
    return out


def leading(found):
    """Parts of a search's summary at and below the surface: [(part, length (m) over which its stresses are averaged, or 0)];
    the averaged part if only its error is known.
    """
    wide = found.get("averaged", {})
    pairs = [(found, wide), (found.get("below"), wide.get("below"))]
    return [(own, 0.0) if not _alone_known(own, other) else (other, wide["length_m"]) for own, other in pairs if own]


def _alone_known(own, other):
    """Whether the error of the averaged index is known and that of the pointwise one is not."""
    errors = [(part or {}).get("error", {}).get("Fi_max") for part in (own, other)]
    return errors[0] is None and errors[1] is not None
