"""A store of made-up fields and a made-up fatigue search, their figures, and what stands in these."""

import dataclasses
import re

import numpy as np

from tehl_taichi.fatigue.search_result import SearchResult
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.moments import Moments
from tehl_taichi.view.figures.search_data import DrawnSearch


class Made:
    """A store of made-up smooth fields, thermal: a steady start, and the feature at three places if the scene has one; on the
    whole domain the pressure is largest at y = -a/2, where the feature is at 0."""

    def __init__(self, description, whole=False):
        scales = Scales.of(description)
        a, b = self.a, self.b = scales.a, scales.b
        self.scene, self.stored, self.path = description, {}, "made.zarr"
        self.x = np.linspace(description.grid.x_min, description.grid.x_max, 33) * a
        side = description.grid.y_max * (a if np.isinf(b) else b)
        self.y = np.linspace(-whole, 1, 13) * side if description.rows else np.zeros(1)
        self.at = np.array([-1.6, -0.8, 0.0, 0.8] if description.transient else [np.nan]) * a
        self.steps = len(self.at)

    def __len__(self):
        return self.steps

    def scalar(self, name):
        if name == "p_max_Pa":
            return np.array([self.fields(n, ["pressure"])["pressure"].max() for n in range(self.steps)])
        return self.at if name == "feature_x" else np.full(self.steps, 0.4e-6)

    def fields(self, n, names):
        X, Y = np.meshgrid(self.x / self.x[-1], self.y / (self.y[-1] or 1), indexing="ij")
        size = {"pressure": 1e9, "film": 0.2e-6}
        values = n + 2 + X**2 + Y**2
        if self.y[0] < 0:
            values = values + 9 * (n == 2) * np.exp(-100 * (self.x[:, None] ** 2 + (self.y + self.a / 2) ** 2) / self.a**2)
        return {name: values * size.get(name, 40.0 + len(name)) for name in names}

    def map(self, name):
        return None


def made(name="gear"):
    return Made(scene(name).replace(**{"thermal.on": True}))


def searched(one_row=False, y_worst=0.0, arrays=lambda found: {}, **more):
    """What a search of the surface and of two depths found: a hill of Fi at each, highest at 60 um; arrays: others, made from
    the SearchResult."""
    x, y = np.linspace(-1e-4, 1e-4, 21), np.zeros(1) if one_row else np.linspace(-1e-4, 1e-4, 11)
    hill = np.exp(-((x[:, None] - 2e-5) ** 2 + y**2) / 1e-9) * 4e8
    layers = np.stack([hill, 0.5 * hill, 1.5 * hill])
    numbers = {"x_m": 2e-5, "y_m": y_worst, "surface_angle_deg": 50.0}
    summary = {**numbers, "Fi_max": 1.0, "sigma_eF_Pa": 4e8, "kappa_F": 0.3, "criterion": "findley",
               "below": {**numbers, "Fi_max": 1.5, "depth_m": 6e-5}}
    turn = np.linspace(0, 2 * np.pi, 30)
    history = {"x_a": np.linspace(-5e-4, 5e-4, 30), "normal": np.array([0.6, 0.0, 0.8]), "circle": (0.0, 0.0, 1e8),
               "stress": np.outer(np.sin(turn), [1e8, 0, 2e8, 0, 5e7, 0])}
    stress = {"findley_stress_under_row": layers[:, :, 0]} if one_row else {"findley_stress_at_depth": layers}
    found = SearchResult(summary, x, y, Fi=hill / 4e8, fatigue_depth=np.array([0.0, 2e-5, 6e-5]), worst=history,
                         worst_below=history, **stress)
    return DrawnSearch("made up", dataclasses.replace(found, **arrays(found)), 3.6e-4, "x (µm)", **more)


def drawn(name, store, page=None, at=None):
    """One of the figures of a run."""
    from tehl_taichi.view.figures import across_figure, field_maps, line_figures, surface_figure

    rooms = (across_figure, field_maps, line_figures, surface_figure)
    draw = next(getattr(room, name) for room in rooms if hasattr(room, name))
    return draw(page or FigureStyle(), Moments(store, at))


def title(figure):
    """That of the whole, in one line, without the half-width."""
    return re.sub(r" \(a = [\d.]+ mm\)", "", " ".join(figure.get_suptitle().split()))


def titles(figure):
    return [figure.get_suptitle()] + [ax.get_title() for ax in figure.axes]


def legend(figure):
    """{label: line} of all legends."""
    found = figure.legends + [ax.get_legend() for ax in figure.axes if ax.get_legend()]
    return {line.get_label(): line for one in found for line in one.get_lines()}
