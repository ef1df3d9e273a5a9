"""Choice of a cutoff for a measured map that is suitable for the grid, the film equation and the steel."""

import bisect
import math

from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.surface.maps import flattening_pressure, gaussian_filter
from tehl_taichi.scene.surface.maps.height_map import Measures, error_on_grid
from tehl_taichi.scene.yield_stress import YIELDS

STEEP = 10.0  # degrees: the film equation takes slopes for small (tan 10 deg = 0.18)
SHARE = 0.1  # of the rms that a grid, or the map's own points, may miss: a wave of six cells
JUDGED = 1024  # points along each side, from the middle, that are judged
SURELY = 1.1  # times what steel carries: such an estimate is no better
FINER = 1.05  # one cutoff that is tried over the next: two digits


def middle(heights):
    """Middle part of a large map."""
    cut = [max(0, (n - JUDGED) // 2) for n in heights.shape]
    return heights[cut[0]:heights.shape[0] - cut[0], cut[1]:heights.shape[1] - cut[1]]


def points_in_a_cell(f, scene):
    """Map points per cell [along x, along y], not necessarily whole; an axis of one point takes the number of the other."""
    found = [size / step for size, step in zip(Scales.of(scene).cell(scene.grid), f.steps)]
    return [found[axis if count > 1 else 1 - axis] for axis, count in enumerate(f.points)]


def contact_pressure(heights, f, scene):
    """Highest pressure (Pa) of a contact that presses these heights flat: that of the dry contact plus that of the heights.

    Comparison with a ground flank under 1.3 GPa before it reached the outlet: 4.9 GPa computed, 4.8 estimated (cutoff 25 um);
    4.2 and 4.0 (45 um). At the outlet, peaks of 6.4 and 6.7 GPa were not resolved by the grid.
    """
    scales = Scales.of(scene)
    return scales.p_H + flattening_pressure.highest(heights, f.steps, scales.E)


def yields(heights, f, scene, margin=1.0):
    """Whether this pressure exceeds `margin` times the limit of steel because of the heights; without them it must not."""
    return Scales.of(scene).p_H < YIELDS < contact_pressure(heights, f, scene) / margin


def suitable_cutoff(f, scene):
    """Smallest cutoff (m) with which the grid resolves the map, its slopes are small and steel carries it; 0 if there is
    none.
    """
    key = Scales.of(scene), scene.grid
    if key not in f.cutoffs:
        f.cutoffs[key] = _searched(f, scene)
    return f.cutoffs[key]


def _searched(f, scene):
    least, most = gaussian_filter.limits(f)
    least = max(least, f.cutoff)
    count = math.floor(math.log(most / least) / math.log(FINER)) + 1
    tried = sorted({cutoff for n in range(1, count) if least < (cutoff := float(f"{least * FINER**n:.1e}")) < most})
    found = bisect.bisect_left(tried, True, key=lambda cutoff: _is_suitable(f, scene, cutoff))
    return tried[found] if found < len(tried) else 0.0


def _is_suitable(f, scene, cutoff):
    """Whether the map with this cutoff (m) is resolved, has small slopes and is carried by steel."""
    measured = middle(f.filtered(cutoff))
    return (Measures.of(measured, f.steps).slope <= STEEP and not yields(heights := middle(f.passing(cutoff)), f, scene)
            and error_on_grid(heights, *points_in_a_cell(f, scene)) <= SHARE)
