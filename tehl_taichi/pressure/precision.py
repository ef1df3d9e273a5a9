"""Precision of the linear solves of a scene."""

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.film_formula import central_film
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.sections import AUTO

# Central film (in a^2/R') from which on they are done in single precision. The deflection of a trial pressure is known to
# 1e-7 of its largest value then, too little for thin films on coarse grids: of 200 random scenes 7 converge in double only,
# all of them thinner than 0.003; the gear has 0.03. Asking for it is refused below: an answer that depends on luck is none.
THICK = 0.01


def of(scene):
    """"f32" or "f64": the user's choice, or the suitable one. Raises SceneError for f32 and a film too thin for it.

    A scene without variation along y takes as long in double precision; so the cases of a study share one set of kernels.
    """
    requested = scene.numerics.precision
    if requested == "f32" and suited(scene) != "f32":
        h = central_film(scene)
        raise SceneError(f"numerics.precision = 'f32': a film of about {h:.2g} m ({h / Scales.of(scene).h:.2g} a^2/R') is too "
                         f"thin for linear solves in single precision, which need at least {THICK:g} a^2/R'; allowed: auto, "
                         "f64")
    if requested == AUTO:
        return "f64" if scene.one_dimensional else suited(scene)
    return requested


def suited(scene):
    """"f32" for thick films, else "f64"; the state and its residual are always in double precision."""
    return "f32" if central_film(scene) > THICK * Scales.of(scene).h else "f64"
