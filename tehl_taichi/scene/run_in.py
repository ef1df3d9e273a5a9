"""Run-in of a scene: the bodies whose steel may yield, and a check for scenes without a solution."""

from tehl_taichi.errors import SceneError
from tehl_taichi.laws.hardening import HARDENINGS
from tehl_taichi.scene import scales
from tehl_taichi.scene.strength.strength import Strength
from tehl_taichi.scene.strength.table import YIELD
from tehl_taichi.scene.timeline import cut_at

LINE, POINT = 0.56, 0.62  # largest von Mises stress under a smooth contact over p_H, without friction (Johnson 1985)
DEEP = 0.7, 0.48  # a: where it is


def yielding_surfaces(scene):
    """Surfaces whose steel may yield during run-in: those that move and whose body has its own yield stress."""
    return tuple(s for s, rests in zip(scene.surfaces, scene.at_rest) if not rests and has_yield_stress(scene, s))


def has_yield_stress(scene, surface):
    """Whether the body has its own yield stress, constant or over its depth."""
    table = Strength(scene.fatigue, surface).table
    return surface.body.yield_stress > 0 or table is not None and table.has(YIELD)


def elastic_bodies(scene):
    """{name: reason} of bodies that stay elastic in a scene with run-in."""
    if not scene.runs_in:
        return {}
    flow = {surface.name for surface in yielding_surfaces(scene)}
    return {s.name: "at rest" if rests else "it has no yield stress" for s, rests in zip(scene.surfaces, scene.at_rest)
            if s.name not in flow}


def check(scene):
    """Refuse a run-in that has no solution. Raises SceneError."""
    count = scene.time.run_in
    if not count or not scene.transient:
        return
    if not yielding_surfaces(scene):
        keys = " or ".join(f"bodies.{s.name}.yield_stress" for s, rests in zip(scene.surfaces, scene.at_rest) if not rests)
        raise SceneError(f"time.run_in = {count} needs the yield stress of a body that moves: set {keys}, in Pa (2.2e9 is that "
                         "of hardened bearing steel)")
    if cut_at(scene) is not None and scene.time.steps:  # 0: the steady start alone, `tehl resume` does the rest
        raise SceneError(f"time.run_in = {count} needs whole passages: omit time.steps and time.x_end")
    for surface in yielding_surfaces(scene):
        _check_track(scene, surface)


def _check_track(scene, surface):
    """Refuse steel that yields below the smooth contact, all along its track."""
    s = scales.Scales.of(scene)
    share, deep = (LINE, DEEP[0]) if s.line else (POINT, DEEP[1])
    limit = Strength(scene.fatigue, surface).yield_stress(deep * s.a)
    first, stress = float(HARDENINGS[surface.body.hardening].flow_stress(limit, 0.0)), share * s.p_H
    if stress > first:
        raise SceneError(f"time.run_in = {scene.time.run_in}: steel of body {surface.name} first flows at {first / 1e9:.3g} "
                         f"GPa, less than the von Mises stress {stress / 1e9:.3g} GPa of the smooth contact, so its whole "
                         "track would flow; allowed: a higher yield stress, or less load")
