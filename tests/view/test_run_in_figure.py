"""Figure of a run-in, of a state that is made up."""

from types import SimpleNamespace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.plastic.run_in import BodyRunIn, RunInState
from tehl_taichi.plastic.steel_body import SteelState
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.run_in_figure import run_in

pytest.importorskip("matplotlib")
X, Y, DEPTHS = np.linspace(-2e-4, 2e-4, 21), np.linspace(0, 1e-4, 5), np.array([5e-6, 1.5e-5, 3e-5, 6e-5])


def body(sinks):
    hill = np.exp(-(X[:, None] ** 2 + Y**2) / 5e-9)
    residual = -5e8 * hill * np.exp(-DEPTHS / 1e-5)[:, None, None, None] * np.arange(6, 0, -1)[:, None, None] / 6
    start = SteelState(0 * residual, residual[:, 0] * -1e-12, residual, sinks * hill)
    return BodyRunIn(X, Y, DEPTHS, True, start, sinks * hill)


def drawn(state):
    store = SimpleNamespace(scene=tehl.scene("gear"), run_in=state)
    page = FigureStyle(dpi=40)
    with page.style():
        return run_in(page, SimpleNamespace(store=store))


def test_it_shows_heights_stresses_and_passages_of_the_body_that_changed_most():
    record = {"judged": False, "surface_change_m": 3e-7, "new_plastic_strain": 1e-3}
    records = [{**record, "passage": 1}, {**record, "passage": 2, "judged": True, "surface_change_m": 0.0}]
    figure = drawn(RunInState({"a": body(3e-7), "b": body(1e-8)}, passages=1, records=tuple(records), done=True))
    assert figure.get_suptitle() == "gear: run-in of body a, 1 passage before the one that is judged"
    heights, passages, along, across = figure.axes[:4]
    before, after = (line.get_ydata() for line in heights.lines)
    assert before.max() == pytest.approx(1.5) and after.max() == pytest.approx(1.2)
    assert [one.get_height() for one in passages.patches] == pytest.approx([300, 0])
    assert [ax.get_title() for ax in (along, across)] == ["residual σ_xx", "residual σ_yy"] and along.yaxis_inverted()
    assert len(along.collections[0].get_array().reshape(-1)) == 21 * 3  # without the deepest layer, which has less than 2 %


def test_a_run_in_that_changed_nothing_says_so():
    record = {"passage": 1, "judged": True, "surface_change_m": 0.0, "new_plastic_strain": 0.0}
    figure = drawn(RunInState({"a": body(0.0)}, records=(record,), done=True))
    assert figure.get_suptitle() == "gear: run-in of body a, no steel yields"
