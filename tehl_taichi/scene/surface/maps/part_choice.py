"""Check that the used part of a scan was measured; proposal of another part."""

import numpy as np

from tehl_taichi.scene.surface.maps import hole_filling
from tehl_taichi.scene.surface.maps.height_map import named
from tehl_taichi.scene.surface.maps.refusals import HeightsRefused


def check(f):
    """Refuse a part that lacks too many heights. Raises HeightsRefused, which proposes another part."""
    holes = f.holes
    if _enough(holes):
        return
    across = 2 * hole_filling.hole_depth(holes)
    raise HeightsRefused(f"{named(f)} lacks {holes.sum()} of its {holes.size} heights ({holes.mean() * 100:.3g} %), in holes "
                         f"of up to {across} points across; allowed: {hole_filling.MOST * 100:g} %, holes of "
                         f"{2 * hole_filling.DEEPEST} (they are filled from their neighbours); {_remedy(f)}")


def _enough(holes):
    return holes.mean() <= hole_filling.MOST and hole_filling.hole_depth(holes) <= hole_filling.DEEPEST


def _remedy(f):
    holes = hole_filling.unmeasured(f.orientation.turned(f.heights))
    low_y, high_y, low_x, high_x = ends = _on_points(*measured_part(holes), *holes.shape)
    if not _large(ends) or not _enough(holes[low_y:high_y, low_x:high_x]):
        return "use a part with fewer holes (feature.offset_x, extent_x ...), or fill them in the measuring software"
    keys = [f"feature.{name}_{axis} = {value:.4g}" for axis, low, high, count, step in
            zip("xy", (low_x, low_y), (high_x, high_y), f.points, f.steps) if high - low < count
            for name, value in (("extent", (high - 1 - low) * step), ("offset", (low + high - count) / 2 * step))]
    return f"this part has fewer: {', '.join(keys)}"


def _on_points(low_y, high_y, low_x, high_x, rows, columns):
    """These ends, one point fewer along an axis where the centre of the part would lie half a point off the points of a part:
    parts lose whole points on both sides.
    """
    return *_even(low_y, high_y, rows), *_even(low_x, high_x, columns)


def _even(low, high, count):
    """Ends of a part that leaves out an even number of points more on one side than on the other; one point more is left out
    where more of them are.
    """
    if (low + high - count) % 2 == 0:
        return low, high
    return (low + 1, high) if low > count - high else (low, high - 1)


def _large(ends):
    low_y, high_y, low_x, high_x = ends
    return high_y - low_y >= 4 and high_x - low_x >= 4 or min(high_y - low_y, high_x - low_x) == 1


def measured_part(holes):
    """Largest measured part: (first, after last row, first, after last column).

    The edge that lacks the largest share of points is cut off until no edge lacks more than hole_filling.MOST.
    """
    total = np.pad(np.cumsum(np.cumsum(holes, axis=0, dtype=int), axis=1), ((1, 0), (1, 0)))
    ends = [0, holes.shape[0], 0, holes.shape[1]]

    def lacking(a, b, c, d):
        """Share of unmeasured points in these rows and columns."""
        return (total[b, d] - total[a, d] - total[b, c] + total[a, c]) / max((b - a) * (d - c), 1)

    while ends[1] - ends[0] > 1 or ends[3] - ends[2] > 1:
        a, b, c, d = ends
        edges = [lacking(a, a + 1, c, d), lacking(b - 1, b, c, d), lacking(a, b, c, c + 1), lacking(a, b, d - 1, d)]
        edges = [share if ends[n // 2 * 2 + 1] - ends[n // 2 * 2] > 1 else -1.0 for n, share in enumerate(edges)]
        worst = int(np.argmax(edges))
        if edges[worst] <= hole_filling.MOST:
            break
        ends[worst] += 1 if worst in (0, 2) else -1
    return tuple(ends)
