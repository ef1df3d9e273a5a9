"""Second index, of stresses averaged over fatigue.length.

A jump of the surface shear, as at the front of a rolling asperity, has no largest stress: the pointwise stress grows with every
finer grid, the averaged one converges (docs/decisions/10-material-length.md).
"""

import numpy as np

from tehl_taichi.fatigue import every_moment, local_strength
from tehl_taichi.fatigue.pass_progress import PassProgress
from tehl_taichi.fatigue.sought import Sought
from tehl_taichi.fatigue.stress.averaging import averaged_reader
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.worst_point import worst_of
from tehl_taichi.scene import material_length


def counts(scene, x):
    """Whether there is such an index on nodes x (m)."""
    return not material_length.why_not(scene, (x[-1] - x[0]) / (len(x) - 1))


def part(points, top, centres, box, progress):
    """Part "averaged" of the summary of one body.

    points: StressHistories of its search at points. top: :class:`tehl_taichi.fatigue.layer.Layer` of the averaged stresses at
    the surface. centres: of the first feature, m. box: points that are searched below, or None for all. progress: called with
    (done, total).
    """
    scene, averages = points.scene, averaged_reader(points.reader, points.scene.fatigue.length)
    passage = StressHistories(scene, averages, np.asarray(centres), surface=points.surface, box=box, sought=Sought.WORST)
    passage.steel = False
    progress = PassProgress.of(progress, scene, passage)
    layers, deep = every_moment.searched(scene, passage, top, None, progress)
    below = worst_of([found.worst for found in layers[1:]] + deep.worst)
    return {"length_m": scene.fatigue.length, **layers[0].worst.summary(),
            **({"below": local_strength.summary(passage, below)} if below else {})}
