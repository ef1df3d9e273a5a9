"""The choice of the body that has the crack."""

from tehl_taichi.crack.crack_options import WORSE
from tehl_taichi.errors import SceneError
from tehl_taichi.fatigue import assessment
from tehl_taichi.fatigue.judged_surfaces import by_surface, resting
from tehl_taichi.fatigue.pressure_alone import why_none


def cracked_surface(scene, reader, name):
    """Return the :class:`tehl_taichi.scene.moving_surfaces.MovingSurface` with this name, or the worse surface. Raises
    SceneError, also for a run without a verdict, whose shear no crack can follow.
    """
    for found in by_surface(getattr(reader, "summary", {})).values():
        if why := why_none(found):
            raise SceneError(f"no crack follows from this run: {why}")
    name = _worse_surface(scene, reader) if name == WORSE else name
    if name in (s.name for s, rests in zip(scene.surfaces, scene.at_rest) if rests):
        raise resting(name)
    return next(s for s in scene.surfaces if s.name == name)


def _worse_surface(scene, reader):
    """Name of the surface that decides the verdict of a finished run; without a verdict, the one that would."""
    if found := getattr(reader, "summary", {}).get("fatigue"):
        return found.get("surface", "a")  # runs before 0.9 searched only body a
    if len(scene.judged) < 2:
        return next((s.name for s in scene.judged), scene.reference.name)
    return assessment.run(scene.replace(**{"fatigue.depths": []}), reader).summary["surface"]
