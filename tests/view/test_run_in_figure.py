"""Figure of a run-in, of a state that is made up."""

from dataclasses import replace
from types import SimpleNamespace

import made_run_in
import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.run_in_data import profiles
from tehl_taichi.view.figures.run_in_figure import run_in

pytest.importorskip("matplotlib")


def drawn(state):
    store = SimpleNamespace(scene=tehl.scene("gear"), run_in=state)
    page = FigureStyle(dpi=40)
    with page.style():
        return run_in(page, SimpleNamespace(store=store))


def test_it_shows_heights_stresses_and_passages_of_both_bodies_that_flowed():
    figure = drawn(made_run_in.flowed())
    assert figure.get_suptitle() == "gear: run-in of bodies a and b, 1 passage before the one that is judged"
    heights, passages, along, across, other, strains, under, _ = figure.axes[:8]
    before, after = (line.get_ydata() for line in heights.lines)
    assert before.max() == pytest.approx(1.5) and after.max() == pytest.approx(1.2)
    assert [one.get_height() for one in passages.patches] == pytest.approx([300, 0])
    assert [ax.get_title() for ax in (along, across)] == ["body a: residual σ_xx", "body a: residual σ_yy"]
    assert len(along.collections[0].get_array().reshape(-1)) == 21 * 3  # without the deepest layer, which has less than 2 %
    assert other.get_title() == "surface b" and other.lines[1].get_ydata().min() == pytest.approx(-0.01)
    assert [one.get_height() for one in strains.patches] == pytest.approx([0.1, 0.001, 0.02, 0])
    assert under.get_title() == "body b: residual σ_xx" and along.yaxis_inverted() and under.yaxis_inverted()
    assert under.collections[0].get_clim() == along.collections[0].get_clim()


def test_residual_stresses_are_those_of_the_profile_in_megapascals():
    state = made_run_in.flowed()
    figure, found = drawn(state), profiles(tehl.scene("gear"), state)
    for body, axes in zip(found, (figure.axes[2:4], figure.axes[6:8])):
        for ax, (name, stress) in zip(axes, body.residual.items()):
            image = ax.collections[0]
            places = image.get_coordinates()
            assert ax.get_title() == f"body {body.body}: residual {name}"
            np.testing.assert_allclose(image.get_array().reshape(places.shape[:2]) * 1e6, stress.T, atol=1.0)
            np.testing.assert_allclose(places[0, :, 0] * 1e-6, body.x)
            np.testing.assert_allclose(places[:, 0, 1] * 1e-6, body.depths)
    assert figure.axes[-1].get_ylabel() == "MPa"


def test_one_body_that_flowed_has_four_panels():
    state = made_run_in.flowed()
    figure = drawn(replace(state, bodies={"a": state.bodies["a"], "b": made_run_in.body(0.0)}))
    assert figure.get_suptitle().startswith("gear: run-in of body a, 1") and len(figure.axes) == 5  # and a colour bar


def test_a_run_in_that_changed_nothing_says_so():
    assert drawn(made_run_in.elastic()).get_suptitle() == "gear: run-in of body a, no steel yields"


def test_the_profile_is_that_of_the_middle_row():
    """Of a feature beside it, and where the surface sank less than elsewhere."""
    scene = tehl.scene("gear").replace(**{"feature.y": 1e-4, "time.run_in": 1, "bodies.a.yield_stress": 2.2e9})
    state, feature = made_run_in.flowed(), scene.features[0]
    body = state.bodies["a"]
    body.start.sinking[:, 0] *= 0.5
    one, = (profile for profile in profiles(scene, state) if profile.body == "a")
    assert one.before == pytest.approx(feature.height_at(body.x - feature.x, -feature.y), abs=1e-15)
    assert one.before - one.after == pytest.approx(body.start.sinking[:, 0], abs=1e-15)
