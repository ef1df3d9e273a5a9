"""Figure of a run-in, of a state that is made up."""

from types import SimpleNamespace

import made_run_in
import pytest

import tehl_taichi as tehl
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.run_in_figure import run_in

pytest.importorskip("matplotlib")


def drawn(state):
    store = SimpleNamespace(scene=tehl.scene("gear"), run_in=state)
    page = FigureStyle(dpi=40)
    with page.style():
        return run_in(page, SimpleNamespace(store=store))


def test_it_shows_heights_stresses_and_passages_of_the_body_that_changed_most():
    figure = drawn(made_run_in.flowed())
    assert figure.get_suptitle() == "gear: run-in of body a, 1 passage before the one that is judged"
    heights, passages, along, across = figure.axes[:4]
    before, after = (line.get_ydata() for line in heights.lines)
    assert before.max() == pytest.approx(1.5) and after.max() == pytest.approx(1.2)
    assert [one.get_height() for one in passages.patches] == pytest.approx([300, 0])
    assert [ax.get_title() for ax in (along, across)] == ["residual σ_xx", "residual σ_yy"] and along.yaxis_inverted()
    assert len(along.collections[0].get_array().reshape(-1)) == 21 * 3  # without the deepest layer, which has less than 2 %


def test_a_run_in_that_changed_nothing_says_so():
    assert drawn(made_run_in.elastic()).get_suptitle() == "gear: run-in of body a, no steel yields"
