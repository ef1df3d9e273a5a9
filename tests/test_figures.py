"""Figures of a store: what they name, how they are laid out and coloured. The store is made up: nothing is solved."""

import numpy as np
import pytest
from small_stores import store

from tehl_taichi.figures import palette
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

plt = pytest.importorskip("matplotlib.pyplot")


class Made:
    """A store of made-up smooth fields, thermal: a steady start, and the feature at three places if the scene has one."""

    def __init__(self, description):
        a = Scales.of(description).a
        self.scene, self.stored = description, {}
        self.x = np.linspace(description.grid.x_min, description.grid.x_max, 33) * a
        self.y = np.linspace(0, description.grid.y_max, 13) * a
        self.at = np.array([-1.6, -0.8, 0.0, 0.8] if description.transient else [np.nan]) * a
        self.steps = len(self.at)

    def __len__(self):
        return self.steps

    def scalar(self, name):
        return self.at if name == "feature_x" else np.full(self.steps, 0.4e-6)

    def feature_x(self, n):
        return float(self.at[n])

    def fields(self, n, names):
        X, Y = np.meshgrid(self.x / self.x[-1], self.y / self.y[-1], indexing="ij")
        size = {"pressure": 1e9, "film": 0.2e-6}
        return {name: (n + 2 + X**2 + Y**2) * size.get(name, 40.0 + len(name)) for name in names}

    def map(self, name):
        return None


def made(name="gear"):
    return Made(scene(name).replace(**{"thermal.on": True}))


def drawn(name, store):
    from tehl_taichi.figures import run_figures as figures

    return getattr(figures, name)(figures.pyplot(), store)


def texts(figure):
    """Every title, axis label and legend entry."""
    out = [figure.get_suptitle()] + [ax.get_title() for ax in figure.axes]
    return out + [t.get_text() for ax in figure.axes if ax.get_legend() for t in ax.get_legend().get_texts()]


@pytest.mark.parametrize("name", ["maps", "temperature_maps"])
@pytest.mark.parametrize("built_in", ["ball-on-disc", "gear"])
def test_maps_leave_no_part_of_the_page_empty(tmp_path, name, built_in):
    import matplotlib.image

    figure = drawn(name, made(built_in))
    figure.savefig(tmp_path / "map.png", dpi=60)
    plt.close(figure)
    page = matplotlib.image.imread(tmp_path / "map.png")[..., :3].min(axis=2)
    for direction, most in ((0, 0.09), (1, 0.09)):
        used = np.flatnonzero(page.min(axis=direction) < 0.95)
        gaps = np.diff(np.concatenate([[0], used, [page.shape[1 - direction] - 1]]))
        assert gaps.max() <= most * page.shape[1 - direction], (direction, gaps.max(), page.shape)


def test_a_steady_run_is_no_start_and_maps_name_scene_and_moment():
    for name in ("maps", "temperature_maps"):
        assert drawn(name, made("ball-on-disc")).get_suptitle() == "ball-on-disc: steady"
        assert drawn(name, made()).get_suptitle() == "gear: feature at +0.00 a"
    assert "steady" in texts(drawn("centreline", made("ball-on-disc")))
    assert "steady start" in texts(drawn("centreline", made()))
    plt.close("all")


def test_the_film_colours_that_are_cut_end_in_an_arrow():
    images = [ax.collections[0] for ax in drawn("maps", made()).axes if ax.get_title()]
    assert [image.colorbar.extend for image in images] == ["neither", "max"]
    film = images[1]
    assert film.get_clim()[1] == pytest.approx(1.0) and film.get_array().max() > 1.0  # 2.5 times the central film
    temperature = [ax.collections[0] for ax in drawn("temperature_maps", made()).axes if ax.get_title()]
    assert len({image.get_clim() for image in temperature}) == 1 == len({image.cmap.name for image in temperature})
    plt.close("all")


def test_one_moment_has_one_colour_in_every_figure():
    def colour_of(figure):
        lines = figure.axes[0].get_legend().get_lines()
        return {line.get_label(): line.get_color() for line in lines if line.get_color() != "k"}

    first, second = (colour_of(drawn(name, made())) for name in ("centreline", "temperature"))
    assert first == second and len(set(first.values())) == 4 and first["steady start"] == palette.GREY
    plt.close("all")


def test_dots_per_inch_are_as_asked(tmp_path):
    import matplotlib.image

    from tehl_taichi.figures.run_figures import write_all

    write_all(Made(scene("smooth-line").replace(**{"thermal.on": False})), tmp_path, 50)
    assert matplotlib.image.imread(tmp_path / "centreline.png").shape[:2] == (325, 400)  # 8 x 6.5 inches


def test_absurd_dots_per_inch_are_refused(tmp_path):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    from tehl_taichi.scene import SceneError

    found = CliRunner().invoke(app, ["plot", str(store(tmp_path / "a.zarr").path), "--dpi", "5"]).exception
    assert isinstance(found, SceneError) and "allowed: 40 to 1200" in str(found)
