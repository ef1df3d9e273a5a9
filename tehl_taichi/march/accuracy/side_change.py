"""Change of the film at the sides of a line contact by the features that pass: small if the sides are far enough away.

Behind its sides the domain continues as a mirror image, with mirror images of the features. What a feature changes at the side
shows how far its effect reaches, and so how strongly its mirror images change its own film and pressure.
"""

import numpy as np

from tehl_taichi.scene.scales import Scales

INSIDE = 0.8  # a: at the ends of the contact the film changes much with little effect
MOMENTS = 16  # entries looked at: the change at a side is smooth in time (of 16 and of all 192 of the default run 0.726 %)


def side_change(scene, reader):
    """Largest relative change of the film at the sides of the domain, against the steady start; 0 where the domain has no sides
    that matter: without a passage, in a point contact, for features of which one reaches the sides or does not vary along y.

    reader: has x (m), y (m), len and fields(n, names) (SI), with the steady start first.
    """
    if len(reader) < 2 or not (Scales.of(scene).line and _ends_inside(scene)):
        return 0.0
    sides = [-1] if scene.symmetric else [0, -1]
    inside = np.abs(np.asarray(reader.x)) < INSIDE * Scales.of(scene).a
    films = (np.asarray(reader.fields(int(n), ("film",))["film"], float)[inside][:, sides] for n in _moments(len(reader)))
    first = next(films)
    return max(float(np.abs(film / first - 1).max()) for film in films)


def _moments(entries):
    """The steady start, and numbers of MOMENTS other entries, evenly spread."""
    return np.unique(np.append(0, np.linspace(1, entries - 1, MOMENTS).round().astype(int)))


def _ends_inside(scene):
    """Whether there are features, and all of them end inside the domain."""
    side = scene.grid.y_max * Scales.of(scene).b
    return bool(scene.features) and all(not f.transverse and abs(f.y) + f.reach_y < side for f in scene.features)
