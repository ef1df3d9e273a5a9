"""Interference colours of a film."""

import numpy as np
import pytest
from made_figures import made

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import scene
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.interference import SEEN, Light, intensity, light, matching, white_light
from tehl_taichi.view.figures.interference_figure import interference
from tehl_taichi.view.figures.moments import Moments

pytest.importorskip("matplotlib")


def test_one_wavelength_is_dark_at_every_half_of_it():
    """2 n h = 0, lambda, 2 lambda: dark; between them bright; a grey picture."""
    assert intensity([0.0, 295e-9, 590e-9], 590e-9) == pytest.approx([0, 0, 0], abs=1e-12)
    assert intensity([147.5e-9, 442.5e-9], 590e-9) == pytest.approx([1, 1])
    assert Light("monochromatic", wavelength="590 nm").colours(np.array([73.75e-9])) == pytest.approx(0.5)


def test_the_standard_observer():
    """CIE 1931: x, y and z have one integral (106.86 nm), y is 1 at 555 nm."""
    assert matching(np.arange(380.0, 781.0)).sum(axis=1) == pytest.approx(106.86, rel=0.01)
    y = matching(SEEN)[1]
    assert SEEN[y.argmax()] == pytest.approx(555.0, abs=5.0) and y.max() == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize("difference, order", [(260, "rgb"), (430, "R>G>B"), (555, "R,B>G"), (660, "B>R"), (760, "G>R"),
                                               (910, "R,G>B"), (1080, "R,B>G")])
def test_white_light_has_newtons_colours(difference, order):
    """Path differences 2 n h in nm: white, orange, the sensitive tint, blue, green, yellow, pink (chart of Michel-Levy)."""
    R, G, B = white_light(np.array([difference / 2 * 1e-9]))[0]
    good = {"rgb": min(R, G, B) > 0.9, "R>G>B": R > G > B, "R,B>G": min(R, B) > G + 0.1, "B>R": B > R + 0.2, "G>R": G > R + 0.2,
            "R,G>B": min(R, G) > B + 0.2}
    assert good[order], (R, G, B)


def test_no_film_is_black_and_a_thick_one_has_no_colour():
    thin, thick = white_light(np.array([0.0, 5e-6]))
    assert thin == pytest.approx(0, abs=1e-6) and np.ptp(thick) < 0.05 and thick.mean() == pytest.approx(0.735, abs=0.03)


def test_the_refractive_index_follows_the_density():
    """By hand: (1.47^2 - 1)/(1.47^2 + 2) = 0.2790, a tenth more of it is an index of 1.5259."""
    assert Light().index_at(1.0) == pytest.approx(1.47) and Light().index_at(1.1) == pytest.approx(1.5259, abs=1e-4)


@pytest.mark.parametrize("built_in, place", [("ball-on-disc", (0.0, 0.0)), ("ball-bearing", (0.0, 4.0))])
def test_the_picture_has_the_colour_of_the_film(built_in, place):
    """At the middle of a circle, and 4 a beside that of an ellipse, which lies on its side."""
    store, white = made(built_in), Light()
    figure = FigureStyle().drawn(lambda: interference(FigureStyle(), Moments(store), white))
    image = figure.axes[0].images[0]
    left, right, low, top = image.get_extent()
    lying = built_in == "ball-bearing"
    assert ((low, top) == pytest.approx((1.4, -1.6))) == lying and image.origin == ("upper" if lying else "lower")
    across, along = place[::-1] if lying else place
    rows, columns = image.get_array().shape[:2]
    row = (along - low) / (top - low) * (rows - 1) if not lying else (along - top) / (low - top) * (rows - 1)
    found = image.get_array()[round(row), round((across - left) / (right - left) * (columns - 1))]
    f = store.fields(0, ["pressure", "film"])
    at = np.searchsorted(store.x / store.a, place[0]), np.searchsorted(store.y / store.a, place[1])
    near = [one[at[0] - 1 : at[0] + 1, max(at[1] - 1, 0) : at[1] + 1] for one in (f["film"], f["pressure"])]
    ratio = 1 + 0.69e-9 * near[1] / (1 + 2.55e-9 * near[1])
    paths = near[0] * white.index_at(ratio)
    span = white_light(np.linspace(0.98 * paths.min(), 1.02 * paths.max(), 200))
    assert np.abs(span - found).max(axis=1).min() < 0.03
    assert "white light, refractive index 1.47" in " ".join(figure.get_suptitle().split())


def test_the_scale_has_the_colour_of_its_film_in_micrometres():
    """Of oil with the density and so the refractive index of the middle."""
    store, white = made("ball-on-disc"), Light()
    scale = FigureStyle().drawn(lambda: interference(FigureStyle(), Moments(store), white)).axes[1]
    image, index = scale.images[0], float(scale.get_xlabel().partition(" index is ")[2].partition(",")[0])
    low, top = image.get_extent()[:2]
    assert scale.get_xlabel().startswith("film (µm)")
    assert (low, top * 1e-6) == pytest.approx((0.0, Moments(store).film_top([0])))
    h = np.linspace(low, top, image.get_array().shape[1]) * 1e-6
    assert np.abs(image.get_array()[0] - white_light(index * h)).max() < 0.05 and index > 1.47


def test_options_without_effect_are_refused():
    assert light() is None and light("chromatic").kind == "chromatic"
    for given, words in (((None, 1.5), "refractive_index = 1.5"), (("chromatic", None, 5e-7), "wavelength = 5e-07"),
                         (("white",), "chromatic, monochromatic"), (("chromatic", 3.0), "index = 3"),
                         (("monochromatic", None, 589.3), "589.3e-9 m")):
        with pytest.raises(SceneError) as caught:
            light(*given)
        assert words in str(caught.value)


def test_a_line_contact_has_no_picture(tmp_path):
    from tehl_taichi.view.figures.run_figures import write_all

    store = made("smooth-line")
    with pytest.raises(SceneError, match="need a map over x and y"):
        write_all(store, tmp_path / "figures", light=Light())
    assert scene("ball-on-glass").rows > 0
