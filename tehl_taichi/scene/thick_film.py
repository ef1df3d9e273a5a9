"""Films too thick for lubrication theory, by the film formula."""

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.film_formula import heated_film
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_warning import with_data

# Of the reduced radius: where the gap is eight such films, the parabola of this model lies 4 % below a circle. The thickest of
# 2472 scenes (built-in ones, batteries of coverage and stability) is 0.002
THICKEST = 0.01
# Where the gap is eight such films, even two equal cylinders end, the longest bodies of this reduced radius R': at 2 R'
NO_BODIES = 0.25
REMEDY = "use more load, less speed or a thinner oil"


def check(scene):
    """Refuse a flooded film that builds its pressure beyond the bodies. Raises SceneError."""
    film, R = heated_film(scene), Scales.of(scene).R
    if film > NO_BODIES * R and scene.grid.inlet != "starved":
        raise SceneError(f"{_film_words(film, R)}: its oil would build pressure beyond the bodies; allowed: at most "
                         f"{NO_BODIES:g} of it; {REMEDY}")


def warnings(scene):
    """Warning about a film whose gap is no parabola."""
    film, R = heated_film(scene), Scales.of(scene).R
    if film > THICKEST * R:
        yield with_data(f"{_film_words(film, R)}; lubrication theory needs less than {THICKEST:g} of it: {REMEDY}",
                        film_m=film, reduced_radius_m=R)


def _film_words(film, R):
    return f"the film formula has {film:.2g} m at the centre, {film / R:.3g} times the reduced radius ({R:.3g} m)"
