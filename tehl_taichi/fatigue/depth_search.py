"""Search of the critical depth below the surface.

First below some rows. On a surface that is not symmetric also below rows with a large rough measure at any depth
(:mod:`tehl_taichi.fatigue.candidate_rows`), and at all points of the depth found there. The row of the worst subsurface point
is not always that of the surface: of a scanned bump between two rows of 128x32 cells one row had Fi 1.04, the other 1.85.
"""

from dataclasses import dataclass, field

from tehl_taichi.fatigue import candidate_rows, depth_profile, exact_depths, index_statistics
from tehl_taichi.fatigue.layer import EarlyLayer, Layer, early_layer, layer
from tehl_taichi.fatigue.stress.averaging import has_window
from tehl_taichi.fatigue.worst_point import worst_of
from tehl_taichi.values.arrays import nearest_index

# rows of a window are alike if they lie within this share of a feature's half width and their largest stresses at the surface
# within EXCESS. Below eight such rows (asperity of the gear, SRR +0.12 and -0.12, 256x64 cells) the largest stress is 0.03 to
# 2.1 % less than below the axis (docs/decisions/16-search-time.md)
ALIKE, EXCESS = 0.1, 0.02


@dataclass(frozen=True)
class DepthResult:
    """Results of a search: profiles below rows (:class:`tehl_taichi.fatigue.depth_profile.DepthProfile`), those of the early
    moments if requested, the plane that was searched at all points, and that of the early moments at their own worst depth (or
    None).
    """

    profiles: list = field(default_factory=list)
    before: list = field(default_factory=list)
    plane: Layer | None = None
    early_plane: EarlyLayer | None = None

    @property
    def worst(self):
        """Worst points of the whole passage."""
        return _points(self.profiles) + ([self.plane.worst] if self.plane else [])

    @property
    def mises(self):
        """Largest von Mises stress of every searched part."""
        return [profile.mises for profile in self.profiles] + ([self.plane.mises] if self.plane else [])

    @property
    def early(self):
        """Worst points of the early moments."""
        planes = [self.plane.early, self.early_plane] if self.early_plane else []
        return _points(self.before) + [plane.worst for plane in planes]


def search(scene, passage, layers, early, progress):
    """The DepthResult below the rows of the features and of the worst points of `layers` (Layer), or below chosen rows.

    On a whole domain also at all points of the worst depth, and below the rows of its worst points; early moments have their
    own worst depth.
    """
    rows = _rows(passage, passage.chosen_y) if passage.chosen_y else _worst_rows(scene, passage, layers)
    if passes(passage):
        rows = list(dict.fromkeys(rows + candidate_rows.rows(passage, depth_profile.ladder(passage), _moment_sets(early),
                                                             progress)))
    profiles, before = _under(passage, rows, early, progress)
    if not passes(passage):
        return DepthResult(profiles, before)
    plane, sooner = _planes(scene, passage, profiles, before, early, progress)
    places = [one.worst.y for one in (plane, plane.early, sooner) if one]
    more = [row for row in _rows(passage, places) if row not in rows]
    others, earlier = _under(passage, more, early, progress) if more else ([], [])
    return DepthResult(profiles + others, before + earlier, plane, sooner)


def _worst_rows(scene, passage, layers):
    """Rows of the features and of the worst points of `layers`; rows of a window, which are close, without those that are
    alike."""
    rows = _rows(passage, [f.centre_y for f in scene.features])
    near = ALIKE * min(max(f.reach, f.reach_y) for f in scene.features) if has_window(passage.reader) else 0.0
    for one in (found for both in layers for found in (both, both.early) if found):
        row, = _rows(passage, [one.worst.y])
        if row not in rows and not any(_alike(passage, one, row, other, near) for other in rows):
            rows.append(row)
    return rows


def _alike(passage, found, row, other, near):
    """Whether a row is closer than `near` (m) to another one, and its largest value in a Layer or EarlyLayer is hardly
    larger."""
    y, numbers = passage.reader.y, [one - passage.rows.start for one in (row, other)]
    if not abs(y[row] - y[other]) < near or not all(0 <= one < passage.y.size for one in numbers):
        return False
    most, least = found.f[:, numbers].max(axis=0)
    return most <= (1 + EXCESS) * least


def _planes(scene, passage, profiles, before, early, progress):
    """(Layer at the worst depth of all moments, EarlyLayer at that of the early ones or None)."""
    plane = layer(scene, passage, _depth(profiles), progress, early)
    if early is None:
        return plane, None
    depth = _depth(before)
    return plane, plane.early if depth == plane.depth else early_layer(scene, passage, depth, progress, early)


def _depth(profiles):
    """Depth (m) of the worst point of profiles."""
    return worst_of(_points(profiles)).depth


def passes(passage, early=None):
    """Number of passes of stresses and search after the first rows: 0 on a half domain, whose worst row is that of the
    feature.
    """
    each = 2 if early is None else 3  # the stresses of a second plane
    return each * len(passage.row_blocks()) + 3 if passage.reader.y[0] < 0 else 0


def _rows(passage, places):
    """Rows nearest to these positions y, each once."""
    return list(dict.fromkeys(nearest_index(passage.reader.y, at) for at in places))


def _under(passage, rows, early, progress):
    """([profiles of the whole passage], [of its early moments])."""
    moment_sets = _moment_sets(early)
    between = depth_profile.profiles(passage, rows, moment_sets, progress, index_statistics.points_below(passage))
    found = exact_depths.computed(passage, rows, between, moment_sets)
    return found[:: len(moment_sets)], found[1::2] if len(moment_sets) > 1 else []


def _moment_sets(early):
    """Groups of moments that are searched separately: all, and the early ones if requested."""
    return [slice(None)] + [early] * (early is not None)


def _points(profiles):
    """Worst points of profiles."""
    return [profile.worst for profile in profiles]
