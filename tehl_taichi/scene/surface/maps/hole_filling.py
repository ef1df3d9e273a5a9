"""Filling of unmeasured points of a height map, smoothly from their neighbours, if the holes are few and small."""

import numpy as np

MOST, DEEPEST = 0.05, 8  # share of the points; points from the rim of a hole to its middle: beyond, heights would be invented
SWEEPS = 20  # per point of depth: what is left of a hole's heights then is under 1e-6 of its rim's range


def unmeasured(values):
    """Mask of the unmeasured points (nan or infinite)."""
    return ~np.isfinite(values)


def hole_depth(holes):
    """Number of points from the rim of the largest hole to its middle; the edge of the map is a rim only if nothing is
    measured.
    """
    inside, layers = holes, 0
    while inside.any():
        if inside.all():
            return (max(holes.shape) + 1) // 2
        inside, layers = inside & ~_beside(~inside), layers + 1
    return layers


def fill(values):
    """`values` with filled holes: every filled point is the mean of its neighbours (Laplace's equation)."""
    holes = unmeasured(values)
    if not holes.any():
        return values
    out, known = np.where(holes, 0.0, values), ~holes
    while not known.all():  # a first guess, from the rim inwards
        rim = _beside(known) & ~known
        out[rim], known = (_sum(np.where(known, out, 0.0)) / np.maximum(_sum(known * 1.0), 1.0))[rim], known | rim
    framed, real = np.pad(out, 1), np.pad(np.ones(out.shape), 1).ravel()  # the holes alone are gone through: maps are large
    flat, at, row = framed.ravel(), np.flatnonzero(np.pad(holes, 1)), framed.shape[1]
    beside = at + np.array([[-row], [row], [-1], [1]])
    neighbours = real[beside].sum(axis=0)
    for _ in range(SWEEPS * hole_depth(holes) ** 2):
        flat[at] = flat[beside].sum(axis=0) / neighbours
    return framed[1:-1, 1:-1]


def _sum(values):
    """Sum of the values at the four neighbours; zero beyond the edge."""
    out = np.zeros(values.shape)
    out[1:] += values[:-1]
    out[:-1] += values[1:]
    out[:, 1:] += values[:, :-1]
    out[:, :-1] += values[:, 1:]
    return out


def _beside(points):
    """Mask of points with a neighbour among `points`."""
    return _sum(points * 1.0) > 0
