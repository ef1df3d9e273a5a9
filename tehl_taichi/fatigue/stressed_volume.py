"""Stressed volume and surface: Fi^m summed over the material around a feature, relative to the smooth track (weakest link,
Weibull).

The probability of a crack grows with the stressed volume: twice the volume at one index, twice the risk; 1.1 times the index,
1.1^m times. Assumptions: docs/strength.md.
"""

import numpy as np

from tehl_taichi.fatigue import depth_profile
from tehl_taichi.fatigue.stress.averaging import is_mirrored

ROWS = 13  # of the searched part, at most, under which the index is found at all depths
AT_ONCE = 3  # rows whose histories are held together
FINE = 400  # depths between which the index is taken as linear


def part(passage, surface_f, alone):
    """Part "stressed" of a search's summary.

    surface_f: Findley stress (x', searched rows) Pa; alone: the :class:`tehl_taichi.fatigue.contact_alone.ContactAlone`.
    Effective sizes: material with index 1 and the same risk. "per_metre": the searched part is one row, of a scene without
    variation along y, and all sizes are per metre across.
    """
    m, depths = passage.scene.fatigue.weibull, np.append(0.0, depth_profile.ladder(passage))
    rows, limits = _rows(passage), np.array(passage.strength.limits(depths))[:, None]
    f = np.stack(_under(passage, surface_f, rows), axis=-1)
    y, weight = passage.y[rows], 2.0 if is_mirrored(passage.reader) else 1.0
    each = over_depth(f / limits[..., None], depths, m), np.maximum(f[0] / limits[0], 0.0) ** m
    volume, surface = (weight * over_area(values, passage.dx, y) for values in each)
    smooth = float(over_depth(alone.f[:, None] / limits, depths, m)[0]), max(float(alone.f[0] / limits[0, 0]), 0.0) ** m
    area = weight * over_area(np.ones_like(each[0]), passage.dx, y)
    across = {"per_metre": True} if y.size == 1 else {}
    return {"exponent": m, **across, "volume_m3": volume, "area_m2": surface, "track_depth_m": smooth[0],
            "track_share": smooth[1], **_equal("track_equal_m2", volume, smooth[0], area),
            **_equal("track_equal_surface_m2", surface, smooth[1], area)}


def _equal(name, whole, per_area, area):
    """{name: area of the smooth track with the additional risk by the feature}, {} if the track has none."""
    return {name: max(whole / per_area - area, 0.0)} if per_area > 0 else {}


def _rows(passage):
    """Numbers of some searched rows, including the first and the last."""
    return np.unique(np.linspace(0, passage.y.size - 1, min(passage.y.size, ROWS)).round().astype(int))


def _under(passage, surface_f, rows):
    """[Findley stress (depths, x') Pa at and below the surface] under each of these searched rows."""
    out, first = [], int(passage.rows.start)
    for some in np.array_split(rows, -(-rows.size // AT_ONCE)):
        found = depth_profile.profiles(passage, [first + int(row) for row in some])
        out += [np.concatenate([surface_f[:, [row]].T, one.f]) for row, one in zip(some, found)]
    return out


def over_depth(Fi, depths, m):
    """Integral over depth (m) of Fi^m for an index (depths, ...), linear between the depths; negative values count as zero."""
    fine = np.linspace(depths[0], depths[-1], FINE)
    after = np.clip(np.searchsorted(depths, fine), 1, depths.size - 1)
    share = ((fine - depths[after - 1]) / (depths[after] - depths[after - 1])).reshape(-1, *[1] * (Fi.ndim - 1))
    between = (1 - share) * Fi[after - 1] + share * Fi[after]
    return np.trapezoid(np.maximum(between, 0.0) ** m, fine, axis=0)


def over_area(values, dx, y):
    """Integral of values (x', rows) over x' (spacing dx) and the rows at y (m); for one row per metre width."""
    along = dx * (values.sum(axis=0) - 0.5 * (values[0] + values[-1]))
    return float(np.trapezoid(along, y)) if y.size > 1 else float(along[0])


def probabilities(found, volume, area):
    """{"failure_volume", "failure_surface"}: failure probability of the searched part, if a specimen of this size (m3, m2)
    survives the limit in half of the cases; for given sizes only.
    """
    sizes = {"failure_volume": (found["volume_m3"], volume), "failure_surface": (found["area_m2"], area)}
    return {name: float(-np.expm1(-np.log(2.0) * own / size)) for name, (own, size) in sizes.items() if size}
