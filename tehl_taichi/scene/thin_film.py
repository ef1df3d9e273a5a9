"""Resolution of thin films by the grid, with the film formula."""

from tehl_taichi.scene import hertz, refinement
from tehl_taichi.scene.film_formula import heated_film, thinnest_film
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_text import Option, grid_option
from tehl_taichi.values.coded_warning import with_data

# Of the gap of the dry contact one cell before its edge, that a film must have: what flows in is found between these two
# nodes. 61 random thermal lines on 64 columns: with 0.45 and more of it all films lie above their floor, with 0.30 one touches
# at a node, with less than 0.2 all touch over the whole contact; finer grids lift them. Of 46 random thermal points whose side
# lobes have 0.4 and more of it one does not start, of 11 with 0.15 to 0.4 six do not
CARRIED = 0.4
FINEST = 2048  # columns, that are worth naming
SMOOTHEST = 10e-9  # m, rms height of polished balls and discs: under thinner films surfaces touch that no grid has


def resolved_ratio(scene):
    """Film by formula over the thinnest film that the grid resolves; below 1 the surfaces touch by mistake."""
    g, s = scene.grid, Scales.of(scene)
    gap = hertz.line_gap if s.line else hertz.point_gap
    return thinnest_film(scene) / (CARRIED * gap(1 + (g.x_max - g.x_min) / g.nx) * s.h)


def sufficient_grid(scene, most=FINEST):
    """(nx, ny) of the first grid with 2, 4, ... times the cells that resolves the film, None beyond `most` columns."""
    return refinement.first_grid(scene, lambda one: resolved_ratio(one) >= 1, most)


def warnings(scene):
    """Warning about a film too thin for the grid, or for any surface."""
    film, thinnest, part = heated_film(scene), thinnest_film(scene), resolved_ratio(scene)
    if film < SMOOTHEST:
        yield (f"the film formula has {film * 1e9:.2g} nm at the centre, less than the roughness of polished steel "
               f"({SMOOTHEST * 1e9:g} nm); real surfaces touch there, but this model is smooth")
    elif part < 1:
        where = "at the centre" if thinnest == film else "in the side lobes"
        text = (f"the film formula has {thinnest:.2g} m {where}, {part:.2g} of the film that {scene.grid.nx} columns resolve; "
                f"the surfaces may touch on this grid and the start may not converge; {remedy(scene)}")
        yield with_data(text, remedy(scene), film_m=thinnest, carried=part)


def remedy(scene):
    """Option of the grid that resolves the film."""
    size = sufficient_grid(scene)
    if size:
        grid = grid_option(scene, *size)
        return Option(f"use {grid}", f"use {grid.words}")
    return f"no grid up to {FINEST} columns resolves it"
