"""Ends of the domain of a scene: far enough that the gap there is several times the film thickness.

The error of a border with the oil pressure beyond it (:mod:`tehl_taichi.pressure.inlet`) falls with that ratio; the error of a
border without pressure is about (ratio/1.4)^(-3/2) of the film.
"""

import math
from dataclasses import replace

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import hertz, thick_film
from tehl_taichi.scene.film_formula import central_film, heated_film
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.automatic import AutomaticValue
from tehl_taichi.values.coded_text import Option, grid_option
from tehl_taichi.values.coded_warning import with_data
from tehl_taichi.values.quantity import AUTO

LINE_SIDE = 1.0  # b, where nothing depends on it
# Inlets (a) that auto takes: with the usual outlet, and columns in multiples of 64, X = 0 is a node of every grid of a start
# but the last one's
INLETS = 2.5, 4.5, 6.5, 10.5, 14.5, 20.0
SIDES = 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 11.0, 15.0, 20.0  # b
OUTLETS = 1.5, 2.0, 2.5, 3.5, 5.0, 7.0, 10.0, 14.0  # a
# Gap over the film of the formula at the outlet, at least: lines of M 0.3 to 4, L 5 to 25 rupture where it is 1.12 to
# 1.18, circles of M 0.5 to 3 where it is 1.02 to 1.08, beside the axis, too
RUPTURED = {"line": 1.2, "point": 1.1}
# Of the heated film, that hot thick films may be thicker: 25 lines are 0.86 to 3.26 times it, at most 0.9 of the isothermal one
THICKER = 3.3
# Gap over film at both, at least. With temperatures the oil that flows back heats what comes in beyond the border (smooth line
# at 0.5 GPa, 20 m/s, 60 deg C, SRR -0.5: the film is 12 % too thick with 2.5, 2.7 % with 8, 0.8 % with 18)
GAPS, HEATED = 8.0, 20.0
# Part of the error of a border without pressure that remains with the pressure of the oil beyond it; with temperatures HOT/gap
# more, HOTTEST at most: oil that flows in at the border is taken to be cold (lines, circles and ellipses from -2.5 to -8.5 a
# against 12.5 to 20 a, docs/decisions/02-inlet.md). An automatic inlet leaves at most NOTED by the formulas
STIFF, HOT, HOTTEST, NOTED = 0.015, 3.5, 0.25, 0.006
# What an end costs the film: a part of (gap there/so many films)^(-3/2), and of a passage's numbers
INLET, SIDE, LEFT, PASSAGE = 1.4, 0.7, {"line": 0.06, "point": 0.3}, 3.0
LITTLE = 2e-3
# Gap over film up to which an end is the likely cause of a failed start: of 15 starts of lines from -1.2, -1.5 and -2.5 a with
# at most 1.3 eight failed (0.1 to 0.6 GPa, 5 and 20 m/s, 64 columns), with the inlets of auto none of six
SHORT = 2.0
ENDS = "x_min", "x_max", "y_max"


def with_chosen_ends(scene):
    """Grid of a scene with a number in place of every "auto"."""
    grid = scene.grid
    automatic = [key for key in ENDS if _auto(getattr(grid, key))]
    if not automatic:
        return grid
    found = {"x_min": lambda s, film: -_inlet(scene, s, film),
             "x_max": lambda s, film: outlet(scene),
             "y_max": lambda s, film: LINE_SIDE if s.line else _side(s, film)}
    s, film = _scales_and_film(scene)
    return replace(grid, **{key: AutomaticValue(found[key](s, film)) for key in automatic})


def _scales_and_film(scene):
    """(Scales, film by formula in a^2/R')."""
    s = Scales.of(scene)
    return s, heated_film(scene) / s.h


def with_auto(values):
    """Values of a grid with "auto" where the program chose the number."""
    return {key: AUTO if isinstance(value, AutomaticValue) else value for key, value in values.items()}


def _auto(value):
    return value == AUTO or isinstance(value, AutomaticValue)


def _inlet(scene, s, film):
    """First inlet (a) with a gap of enough films and little error by the formulas: pressure at the border is that of cold oil,
    however much the heat reduces the film.
    """
    gaps = {end: inlet_gap(s, end) for end in INLETS}
    cold, thick = central_film(scene) / s.h, _thickest(scene) / s.h
    return next((end for end, gap in gaps.items() if 1 + gap / film >= _least(scene)
                 and left(scene, 1 + gap / thick) * ((1 + gap / cold) / INLET) ** -1.5 <= NOTED), INLETS[-1])


def _side(s, film, least=GAPS):
    """First side (b) of a point contact where the gap is `least` times the film."""
    return _first(SIDES, lambda Y: side_gap(s, Y) / film, least)


def _thickest(scene):
    """Thickest film (m) that the formulas leave possible."""
    return min(central_film(scene), THICKER * heated_film(scene))


def left(scene, gap):
    """Part of the error of a border without pressure that remains with a border with pressure; gap: there, in films."""
    return STIFF + (0.0 if scene.isothermal else min(HOT / gap, HOTTEST))


def _least(scene):
    return GAPS if scene.isothermal else HEATED


def _first(ends, ratio, least):
    """Nearest of these ends where the gap is `least` times the film, or the last one."""
    return next((end for end in ends if 1 + ratio(end) >= least), ends[-1])


def inlet_gap(s, X):
    """Gap beside the dry contact, |X| a before its centre, in a^2/R'."""
    return (hertz.line_gap if s.line else hertz.point_gap)(abs(X))


def side_gap(s, Y):
    """Gap at distance Y b beside the centre of a point contact: exact for a circle and far from an ellipse."""
    return s.curvature * (s.b / s.a) ** 2 * hertz.point_gap(Y)


def within(scene, share):
    """Scene on a domain whose error is at most this share, by the film formula.

    Raises SceneError if the user's own ends are nearer, or if no end is far enough.
    """
    if scene.grid.inlet == "starved":  # the domain is as long as the oil
        return scene
    s, film = _scales_and_film(scene)
    power = (LEFT[s.kind] * (PASSAGE if scene.transient else 1.0) / share) ** (2 / 3)
    needed = {"x_min": -_needed("x_min", INLETS, lambda X: inlet_gap(s, X) / film, max(_least(scene), INLET * power), share)}
    if not s.line:
        needed["y_max"] = _needed("y_max", SIDES, lambda Y: side_gap(s, Y) / film, max(GAPS, SIDE * power), share)
    nearer = {key: end for key, end in needed.items() if abs(end) > abs(getattr(scene.grid, key))}
    for key, end in nearer.items():
        if not isinstance(own := getattr(scene.grid, key), AutomaticValue):
            raise SceneError(f'grid.{key} = {own:g} leaves more than {share:.2g} of the film to the end of the domain; '
                             f'allowed: a magnitude of at least {abs(end):g}, or "{AUTO}"')
    return scene.replace(**{f"grid.{key}": end for key, end in nearer.items()})


def _needed(key, ends, ratio, least, share):
    found = _first(ends, ratio, least)
    if 1 + ratio(found) < least:
        raise SceneError(f"a share of {share:.2g} needs a domain beyond grid.{key} = {found:g}, the largest possible for such "
                         "a thick film")
    return found


def remedy(scene, film):
    """Ends {"x_min", "y_max"} (a, b), none nearer than those of auto, with an error of the film (a^2/R') of at most LITTLE."""
    s, usual = _scales_and_film(scene)
    power = (LEFT[s.kind] / LITTLE) ** (2 / 3)
    far = _first(INLETS, lambda X: inlet_gap(s, X) / film, max(_least(scene), INLET * power))
    inlet = {"x_min": -max(far, _inlet(scene, s, usual))}
    return inlet if s.line else {**inlet, "y_max": max(_side(s, film, max(GAPS, SIDE * power)), _side(s, usual))}


def outlet(scene):
    """End of the domain (a) behind the rupture of the thickest film that the formulas leave possible."""
    s, film = Scales.of(scene), _thickest(scene)
    return _first(OUTLETS, lambda X: inlet_gap(s, X) * s.h / film, RUPTURED[s.kind])


def farther(scene, film):
    """Option, for the end of a sentence, of a domain that is large enough for the film (a^2/R'), with cells of equal size; ""
    if the present one is.
    """
    found = remedy(scene, film).items()
    return with_ends(scene, {key: end for key, end in found if abs(end) > abs(getattr(scene.grid, key)) * (1 + 1e-9)})


def with_ends(scene, ends):
    """Option, for the end of a sentence, of a domain with these ends and cells of the present size; "" for none."""
    if not ends:
        return ""
    sets, grid = [f"grid.{key}={end:g}" for key, end in ends.items()], same_cells(scene, **ends)
    return Option(f"; {' '.join(f'--set {one}' for one in sets)} {grid} (same cells)",
                  f"; {' and '.join([*sets, grid.words])} (same cells)")


def too_short(scene):
    """Sentence about a fixed end of the domain that is too near for the film by formula, with a remedy; "" otherwise, and for
    a film that is too thick on any domain.
    """
    g, (s, film) = scene.grid, _scales_and_film(scene)
    gaps = {"x_min": inlet_gap(s, g.x_min), **({} if s.line else {"y_max": side_gap(s, g.y_max)})}
    gap, key = min((gaps[key], key) for key in gaps)
    if g.inlet == "starved" or isinstance(getattr(g, key), AutomaticValue) or 1 + gap / film > SHORT:
        return ""
    if any(thick_film.warnings(scene)):
        return ""
    option = farther(scene, film)
    return with_data(f"the gap at grid.{key} = {getattr(g, key):g} is only {1 + gap / film:.2f} times the film of the formula "
                     f"({film * s.h:.2g} m), so the domain is probably too short{option}", option, gap=1 + gap / film)


def moved(scene):
    """Sentence about ends along x that "auto" moved away from their usual places; "" otherwise."""
    g = scene.grid
    near, far = (usual if isinstance(end, AutomaticValue) else float(end)
                 for end, usual in ((g.x_min, -INLETS[0]), (g.x_max, OUTLETS[0])))
    if near <= g.x_min and far >= g.x_max:
        return ""
    per_a = g.nx / (g.x_max - g.x_min)
    as_fine = math.ceil(g.nx * (g.x_max - g.x_min) / (far - near) / 16 - 1e-9) * 16
    grid = grid_option(scene, as_fine, g.ny)
    return with_data(f"thick film: the domain reaches from {g.x_min:g} to {g.x_max:g} a (\"auto\"), its {g.nx} columns give "
                     f"{per_a:.3g} per half-width; {grid} makes them as fine as from {near:g} to {far:g} a", grid,
                     x_min_a=float(g.x_min), x_max_a=float(g.x_max))


def same_cells(scene, **ends):
    """Grid Option that keeps the size of the cells on a domain with other ends."""
    g = scene.grid
    x_min, x_max, y_max = (ends.get(key, getattr(g, key)) for key in ENDS)
    nx = math.ceil(g.nx * (x_max - x_min) / (g.x_max - g.x_min) / 16 - 1e-9) * 16
    ny = math.ceil(g.ny * y_max / g.y_max / 4 - 1e-9) * 4
    return grid_option(scene, nx, ny)
