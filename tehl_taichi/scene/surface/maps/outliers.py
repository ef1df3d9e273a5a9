"""Spikes of a measurement: few points far above or below their neighbours, an artefact of optical instruments."""

import math

import numpy as np

STEEP = math.tan(math.radians(20.0))  # between neighbours, at least: a feature as narrow as a spike and flatter is left
FAR = 8.0  # standard deviations of what points differ from their neighbours
FEW = 0.05  # of the points may have a steep side: of a rough surface, or in a wrong unit, more have
LARGEST = 16  # points of a spike: larger and longer ones are scratches, steps or dirt
INSIDE = 2  # points from the rim of a spike to its middle, at most
MOST, MOST_NORMAL = 0.99, 2.576  # of the differences; that many standard deviations of normal ones
SAMPLE = 20000  # points that give the standard deviation, about
NORMAL = 1.4826  # standard deviation over the median of the sizes
NEAR = np.array([(j, i) for j in (-1, 0, 1) for i in (-1, 0, 1) if (j, i) != (0, 0)])


def spikes(heights, steps):
    """Mask of the spikes of `heights` (points along y, along x; m, nan if not measured); steps: distances (m, along x, along
    y).
    """
    steep, none = _steep_points(heights, steps), np.zeros(heights.shape, bool)
    if not steep.any() or steep.mean() > FEW:
        return none
    reach = (3, 3) if min(heights.shape) > 1 else _along(heights.shape)
    padded = np.pad(heights, [(r, r) for r in reach], constant_values=np.nan)
    for _ in range(INSIDE):
        steep = _wider(steep)
    at = np.argwhere(steep)
    limit = max(FAR * _usual_deviation(padded, heights.shape, reach), STEEP * _least(heights.shape, steps))
    found = at[np.abs(_differences(padded, at, reach)) > limit]
    return _small_groups(found, none)


def _along(shape):
    return (4, 0) if shape[1] == 1 else (0, 4)


def _least(shape, steps):
    """Smallest distance of neighbouring points."""
    return min(step for step, count in zip(steps, shape[::-1]) if count > 1)


def _steep_points(heights, steps):
    """Mask of points with a steep side."""
    out = np.zeros(heights.shape, bool)
    for axis, step in zip((1, 0), steps):
        over = np.abs(np.diff(heights, axis=axis)) > STEEP * step  # not beside what was not measured
        first, second = ((slice(None),) * axis + (part,) for part in (slice(None, -1), slice(1, None)))
        out[first] |= over
        out[second] |= over
    return out


def _wider(points):
    """Mask of these points and their eight neighbours."""
    for axis in (0, 1):
        out, first, second = points.copy(), np.moveaxis(points, axis, 0)[:-1], np.moveaxis(points, axis, 0)[1:]
        moved = np.moveaxis(out, axis, 0)
        moved[1:] |= first
        moved[:-1] |= second
        points = out
    return points


def _usual_deviation(padded, shape, reach):
    """Usual standard deviation of the differences to neighbours: from their median and from their 99 % quantile.

    The median alone is too small for plateaus with valleys.
    """
    at = _sample(shape)
    found = np.abs(_differences(padded, at, reach))
    middle, most = np.quantile(found[np.isfinite(found)], (0.5, MOST))
    return max(NORMAL * float(middle), float(most) / MOST_NORMAL)


def _sample(shape):
    """Points (rows, columns) of a map of this shape: all, or some at random with their mirror images, so that marks at even
    distances are not met at one side only, and a mirrored map has the same ones.
    """
    if math.prod(shape) < 2 * SAMPLE:
        return np.argwhere(np.ones(shape, bool))
    some = np.random.default_rng(0).integers(shape, size=(SAMPLE // 4, 2))
    return np.concatenate([np.abs(some - (np.array(shape) - 1) * sides) for sides in ((0, 0), (0, 1), (1, 0), (1, 1))])


def _differences(padded, at, reach):
    """Heights at the points minus the median of their surroundings; nan without neighbours."""
    around = [(j, i) for j in range(-reach[0], reach[0] + 1) for i in range(-reach[1], reach[1] + 1) if (j, i) != (0, 0)]
    places = at + np.array(reach)
    values = np.stack([padded[places[:, 0] + j, places[:, 1] + i] for j, i in around])
    values.sort(axis=0)  # nan last
    count = np.isfinite(values).sum(axis=0)
    low, high = (np.take_along_axis(values, np.maximum(index, 0)[None], axis=0)[0] for index in ((count - 1) // 2, count // 2))
    return padded[places[:, 0], places[:, 1]] - 0.5 * (low + high)


def _small_groups(found, out):
    """Mask of the points in groups of at most LARGEST."""
    left = set(map(tuple, found.tolist()))
    while left:
        group, new = [], [left.pop()]
        while new:
            j, i = new.pop()
            group.append((j, i))
            for beside in ((j + dj, i + di) for dj, di in NEAR.tolist()):
                if beside in left:
                    left.remove(beside)
                    new.append(beside)
        if len(group) <= LARGEST:
            out[tuple(zip(*group))] = True
    return out
