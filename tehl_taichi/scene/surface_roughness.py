"""Roughness of the two surfaces of a scene, before and after its filters, and combined."""

import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.surface.roughness import Roughness

MOST = 1024  # points along y, and its square in all, of surfaces that are sampled


@dataclass(frozen=True)
class SurfaceRoughness:
    """used: Roughness of the passing heights before fading; before: without the filter, None if there is no filter."""

    used: Roughness
    before: Roughness | None = None

    def to_dict(self):
        more = {"before_filters": self.before.to_dict()} if self.before else {}
        return {**self.used.to_dict(), **more}


def by_surface(scene):
    """{"a", "b": SurfaceRoughness} of the surfaces with rough features; {} if nothing passes."""
    if not scene.transient:
        return {}
    edge = scene.grid.y_max * Scales.of(scene).b
    found = {s.name: _of([f for f in s.features if f.kind.rough], edge) for s in scene.surfaces}
    return {name: one for name, one in found.items() if one}


def combined(found):
    """(Sq in m, rms slope, skewness) of the sum of independent surfaces {name: SurfaceRoughness}: squares add."""
    each = [one.used for one in found.values()]
    Sq = math.sqrt(sum(one.Sq**2 for one in each))
    cubes = sum(one.skewness * one.Sq**3 for one in each)
    return Sq, math.sqrt(sum(one.slope**2 for one in each)), cubes / Sq**3 if Sq > 0 else 0.0


def to_dict(scene):
    """Part `roughness` of a summary; {} without rough surfaces."""
    found = by_surface(scene)
    out = {name: one.to_dict() for name, one in found.items()}
    if len(found) > 1:
        out["combined"] = dict(zip(("Sq_m", "Rq_slope", "skewness"), combined(found)))
    return out


def rms_of(numbers):
    """Combined rms height (m) from the part `roughness` of a summary; None if it is missing."""
    if not numbers:
        return None
    both = numbers.get("combined") or next(iter(numbers.values()))
    return both.get("Sq_m", both.get("Rq_m"))


def _of(features, edge):
    """Roughness of the features of one surface, up to the edge (m) of the domain along y; None without features or overlap."""
    if len(features) == 1 and features[0].kind.measured:
        f = features[0]
        before = Roughness.of(f.filtered(0.0), f.steps) if f.cutoff else None
        return SurfaceRoughness(Roughness.of(f.whole_heights, f.steps), before)
    sampled = _sampled(features, edge) if features else None
    return SurfaceRoughness(Roughness.of(*sampled)) if sampled else None


def _sampled(features, edge):
    """(sum of the heights (points along y, along x) where no feature is faded out, steps); None if there is no such place."""
    y, step_y = _places(features, 1, edge, MOST)
    x, step_x = _places(features, 0, math.inf, MOST * MOST // max(y.size, 1))
    if min(x.size, y.size) < 1 or max(x.size, y.size) < 4:
        return None
    return sum(f.height_at(x - f.x, y[:, None] - f.y) for f in features) + 0 * (x + y[:, None]), (step_x, step_y)


def _places(features, axis, edge, most):
    """(at most `most` points along an axis within the patches of all features, at most `edge` (m) from 0; their step); one
    point if nothing varies along it.
    """
    name = "xy"[axis]
    inside = [(getattr(f, name), f.kind.patch(f)[axis] / 2 - f.taper) for f in features]
    low, high = max(at - half for at, half in inside), min(at + half for at, half in inside)
    finest = min((f.kind.finest(f)[axis] for f in features), default=math.inf)
    if not math.isfinite(finest):
        return np.zeros(int(low <= high)) + 0.5 * (max(low, -1.0) + min(high, 1.0)), 1.0
    low, high = (max(low, -edge), min(high, edge)) if math.isinf(high - low) else (low, high)
    if high < low:
        return np.zeros(0), 1.0
    count = min(max(int((high - low) / finest), 0), most - 1) + 1
    return np.linspace(low, high, count), (high - low) / max(count - 1, 1)
