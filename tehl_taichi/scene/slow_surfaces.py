"""Surfaces of point contacts whose temperature rise is known to some percent only: they are slow, and the ellipse is wide."""

from tehl_taichi.scene.scales import Scales, peclet
from tehl_taichi.values.coded_warning import with_data

SLOW = 10.0  # Peclet number; faster surfaces are right within 3 %
# b/a up to which an error holds; circles and ellipses along the motion are right within 5 % (docs/decisions/03)
ERRORS = (2.0, 0.06), (4.0, 0.07), (float("inf"), 0.08)


def warnings(scene):
    """Warning about each slow surface of an ellipse that is wider than long, with temperatures."""
    s = Scales.of(scene)
    if scene.isothermal or s.line or s.b <= s.a:
        return
    error = next(error for most, error in ERRORS if s.b / s.a <= most)
    for surface in scene.surfaces:
        if (pe := peclet(surface.body, surface.speed, s)) < SLOW:
            text = (f"surface {surface.name} is slow (Péclet number {pe:.2g}): in this ellipse (b/a = {s.b / s.a:.2g}) its "
                    f"temperature rise is right within {error:.0%}")
            yield with_data(text, surface=surface.name, peclet=pe, error=error)
