"""Errors of the temperature rise of slow surfaces in point contacts, and warnings about those in wide ellipses."""

from tehl_taichi.scene.scales import Scales, peclet
from tehl_taichi.values.coded_warning import with_data

SLOW = 10.0  # Peclet number; the error of faster surfaces is at most 3 %
# (largest b/a, error) of the largest and the mean temperature rise per flux, by the widths of tehl_taichi.heat.conduction_modes
# at any speed: exact steady temperatures of moving half-spaces under Hertzian fluxes, b/a from 0.25 to 8 (docs/decisions/03)
ERRORS = (1.0, 0.05), (2.0, 0.06), (4.0, 0.07), (float("inf"), 0.08)


def warnings(scene):
    """Generator of a warning for each slow surface in an ellipse wider than long (b > a); none without temperatures."""
    s = Scales.of(scene)
    if scene.isothermal or s.line or s.b <= s.a:
        return
    error = next(error for most, error in ERRORS if s.b / s.a <= most)
    for surface in scene.surfaces:
        if (pe := peclet(surface.body, surface.speed, s)) < SLOW:
            text = (f"surface {surface.name} is slow (Péclet number {pe:.2g}): in this ellipse (b/a = {s.b / s.a:.2g}) its "
                    f"temperature rise is right within {error:.0%}")
            yield with_data(text, surface=surface.name, peclet=pe, error=error)
