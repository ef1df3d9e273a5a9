"""Films too thick for lubrication theory, by the film formula."""

from tehl_taichi.scene.film_formula import heated_film
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_warning import with_data

# Of the reduced radius: where the gap is eight such films, the parabola of this model lies 4 % below a circle. The thickest of
# 2472 scenes (built-in ones, batteries of coverage and stability) is 0.002
THICKEST = 0.01


def warnings(scene):
    """Warning about a film whose gap is no parabola."""
    film, R = heated_film(scene), Scales.of(scene).R
    if film > THICKEST * R:
        yield with_data(f"the film formula has {film:.2g} m at the centre, {film / R:.3g} times the reduced radius "
                        f"({R:.3g} m); lubrication theory needs less than {THICKEST:g} of it: use more load, less speed or a "
                        "thinner oil",
                        film_m=film, reduced_radius_m=R)
