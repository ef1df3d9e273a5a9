"""Figures of a stored run, and of a fatigue result (matplotlib, the `plot` extra)."""

from functools import partial

from tehl_taichi.errors import SceneError
from tehl_taichi.fatigue.judged_surfaces import by_surface
from tehl_taichi.fatigue.search_result import SearchResult
from tehl_taichi.view.figures import (
    across_figure,
    fatigue_figures,
    field_maps,
    interference_figure,
    line_figures,
    run_in_figure,
    search_data,
    surface_figure,
    zoom_maps,
)
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.moments import Moments
from tehl_taichi.view.figures.notebook_figures import Figures


def write_all(store, folder, page=None, at=None, depth=None, light=None):
    """Write every figure of the store into `folder`; returns the paths.

    page: a :class:`FigureStyle`; at: position of the feature to show, a (default: several); depth: µm, of the second fatigue
    map (default: the worst); light: a :class:`tehl_taichi.view.figures.interference.Light` for a figure of interference
    colours. Raises SceneError for a moment or a depth that the store does not have, StoreError.
    """
    page = page or FigureStyle()
    return page.write(folder, _all_of(store, page, at, depth, light))


def draw_all(store, page=None, at=None, depth=None, light=None):
    """{name: matplotlib Figure} of these figures. Raises SceneError, StoreError."""
    page = page or FigureStyle()
    return Figures({name: page.drawn(draw) for name, draw in _all_of(store, page, at, depth, light).items()}, page.dpi)


def _all_of(store, page, at, depth, light):
    """{name: function that draws the figure}."""
    figures = {name: partial(draw, page, Moments(store, at)) for name, draw in _of_the_film(store).items()}
    if light is not None:
        figures["interference"] = partial(_interference(store), page, Moments(store, at), light)
    if store.map("worst_stress") is not None:
        return figures | fatigue_figures.all_figures(page, _fatigue(store, depth))
    if depth is not None:
        raise SceneError(f"depth = {search_data.in_micrometres(depth):g} µm needs a fatigue search, and {store.path} has none")
    return figures


def _of_the_film(store):
    """{name: function} of the figures for which the store has data."""
    wide, warm = store.y.size > 1, not store.scene.isothermal
    has = {"surface": (surface_figure.surface, store.scene.transient),
           "centreline": (line_figures.centreline, True), "centreline_y": (across_figure.centreline_y, wide),
           "maps": (field_maps.maps, wide),
           "zoom": (zoom_maps.zoom, wide and store.map("zoom_entry") is not None),
           "temperature": (line_figures.temperature, warm), "temperature_maps": (field_maps.temperature_maps, warm and wide),
           "profiles": (line_figures.profiles, "temperature" in store.stored),
           "run_in": (run_in_figure.run_in, bool(store.scene.runs_in and store.finished and store.run_in.bodies))}
    return {name: draw for name, (draw, there) in has.items() if there}


def _interference(store):
    """Function that draws interference colours. Raises SceneError for a store without a map."""
    if store.y.size == 1:
        raise SceneError(f"interference colours need a map over x and y, and {store.path} has only a line along x")
    return interference_figure.interference


def _fatigue(store, depth):
    return search_data.DrawnSearch.of(store.scene, SearchResult.from_arrays(by_surface(store.summary), store.map), depth)


def write_fatigue(result, scene, folder, page):
    """Write the figures of a SearchResult of a scene into `folder`; returns the paths. Raises SceneError, StoreError."""
    return page.write(folder, fatigue_figures.all_figures(page, search_data.DrawnSearch.of(scene, result, None)))
