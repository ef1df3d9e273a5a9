"""The undeformed gap (Hertz units) and the heights of surface features (m; x and y from the feature's centre); arrays."""

import numpy as np

MODES = 12  # per direction of a rough patch


def undeformed(X, Y, curvature):
    """X^2/2 + curvature Y^2/2: curvature 0 for a line, R_x/R_y for a point contact."""
    return 0.5 * X**2 + 0.5 * curvature * Y**2


def cosine(f, x, y):
    """Bump of one cosine cycle, (height/2)(1 + cos(2 pi r/width)) for r < width/2 (Everitt 2018, Fig 6); elliptic with a
    length."""
    r = np.hypot(x, y * (f.width / f.length if f.length else 1.0))
    return np.where(r < f.width / 2, 0.5 * f.height * (1 + np.cos(2 * np.pi * r / f.width)), 0.0)


def ridge(f, x, y):
    """Transverse ridge, height 10^(-10 xi^2) cos(2 pi xi), xi = x/width (Venner & Lubrecht)."""
    xi = x / f.width
    return f.height * 10.0 ** (-10 * xi * xi) * np.cos(2 * np.pi * xi) + 0 * y


def waviness(f, x, y):
    """height cos(2 pi x/width) cos(2 pi y/length) within its patch."""
    across = np.cos(2 * np.pi * y / f.length) if f.length else 1.0
    return f.height * np.cos(2 * np.pi * x / f.width) * across * _window(f, x, y)


def rough(f, x, y):
    """Sum of cosines of equal power per octave with random phases in x, even in y; rms = height in the patch."""
    rng = np.random.default_rng(f.seed)
    longest = max(f.extent_x, 2 * f.width)
    k = 2 * np.pi / np.geomspace(longest, f.width, MODES)
    phase, size = rng.uniform(0, 2 * np.pi, (MODES, MODES)), rng.standard_normal((MODES, MODES))
    size *= 2 * f.height / np.sqrt((size**2).sum())
    along = [sum(size[p, q] * np.cos(k[p] * x + phase[p, q]) for p in range(MODES)) for q in range(MODES)]
    return sum(along[q] * np.cos(k[q] * y) for q in range(MODES)) * _window(f, x, y)


def measured(f, x, y):
    """The measured map, levelled, linear between its points, within its patch."""
    values = f.surface
    rows, columns = values.shape
    i = np.clip(x / f.pixel + (columns - 1) / 2, 0, columns - 1) + 0 * y
    j = np.clip(y / f.pixel + (rows - 1) / 2, 0, rows - 1) + 0 * x
    i0, j0 = np.minimum(i.astype(int), columns - 2), np.minimum(j.astype(int), rows - 2)
    u, v = i - i0, j - j0
    low = (1 - u) * values[j0, i0] + u * values[j0, i0 + 1]
    high = (1 - u) * values[j0 + 1, i0] + u * values[j0 + 1, i0 + 1]
    return ((1 - v) * low + v * high) * _window(f, x, y)


def _window(f, x, y):
    """1 inside the patch, fading to 0 at its rim (half a cosine over `taper`)."""
    return _fade(np.abs(x), f.patch[0] / 2, f.taper) * _fade(np.abs(y), f.patch[1] / 2, f.taper)


def _fade(distance, rim, taper):
    if taper <= 0:
        return (distance <= rim).astype(float)
    return 0.5 * (1 - np.cos(np.pi * np.clip((rim - distance) / taper, 0.0, 1.0)))


SHAPES = {"cosine": cosine, "ridge": ridge, "furrow": ridge, "waviness": waviness, "rough": rough, "map": measured}


def feature_height(feature, x, y):
    """Height of `feature` (positive = out of the surface; a furrow or dent has a negative height)."""
    return SHAPES[feature.shape](feature, x, y)
