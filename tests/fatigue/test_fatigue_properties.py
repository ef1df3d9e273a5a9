"""The fatigue of a passage that is mirrored, moved, drawn on other rows, stored at other moments: the same answer."""

import dataclasses

import numpy as np
import pytest
from fatigue.stress.test_material_points import CELLS, Formula, gear

from tehl_taichi.fatigue import assessment
from tehl_taichi.fatigue.stress.histories import StressHistories, between, equal_steps
from tehl_taichi.scene.feature import Feature

pytestmark = pytest.mark.usefixtures("taichi_cpu")


class Beside(Formula):
    """The bump at y = beside (a), on rows from -wide to wide (a), `per_a` of them an a; shear along y where it is higher."""

    def __init__(self, scene, beside, wide=1.25, per_a=8, sideways=0.03):
        super().__init__(scene)
        self.beside, self.sideways = beside, sideways
        self.y = np.linspace(-wide, wide, int(2 * wide * per_a) + 1) * self.a

    def fields(self, n, names):
        hill = np.exp(-((self.y / self.a - self.beside) ** 2) / 0.02)[None, :]
        smooth = self.p_H * np.sqrt(np.maximum(1 - (self.x / self.a) ** 2, 0))[:, None] * np.ones_like(hill)
        p = smooth + (self.pressure(n, self.x)[:, None] - smooth) * hill
        found = {"pressure": p, "traction_x_a": 0.05 * p, "traction_y_a": self.sideways * (p - smooth)}
        return {name: found[name] for name in names} if names else found


def off_axis(y, **changes):
    """The gear with its asperity at y (a)."""
    scene = gear(**changes)
    a = Formula(scene).a
    return scene.replace(**{"feature.y": y * a})


def assessed(beside, **how):
    scene = off_axis(beside)
    sideways = how.pop("sideways", 0.03)
    found = assessment.run(scene, Beside(scene, beside, sideways=sideways, **how))
    return found.summary, found.maps["Fi"][0]


def test_a_mirrored_passage_has_the_mirrored_answer():
    right, left = assessed(0.25, wide=1.75), assessed(-0.25, wide=1.75, sideways=-0.03)
    for part in (lambda s: s, lambda s: s["below"]):
        one, other = part(right[0]), part(left[0])
        assert one["Fi_max"] == pytest.approx(other["Fi_max"], rel=2e-4)  # images beyond the first row alone
        assert one["y_m"] == pytest.approx(-other["y_m"], abs=1e-12) and one["x_m"] == pytest.approx(other["x_m"], abs=1e-12)
        assert one["depth_m"] == other["depth_m"] if "depth_m" in one else True
    np.testing.assert_allclose(right[1], left[1][:, ::-1], rtol=1e-3)


def test_the_worst_point_lies_at_the_bump_whatever_rows_there_are():
    """Rows more, finer (dy another part of dx), and beyond the window: places by y, not by number."""
    usual, _ = assessed(0.25)
    a = Formula(gear()).a
    assert abs(usual["y_m"] - 0.25 * a) < 0.13 * a and abs(usual["below"]["y_m"] - 0.25 * a) < 0.13 * a
    for how in ({"wide": 1.5}, {"per_a": 16, "wide": 0.75}):
        other, _ = assessed(0.25, **how)
        assert other["Fi_max"] == pytest.approx(usual["Fi_max"], rel=0.01), how
        assert other["below"]["Fi_max"] == pytest.approx(usual["below"]["Fi_max"], rel=0.01), how
        assert abs(other["y_m"] - usual["y_m"]) <= 0.13 * a


def test_a_second_feature_widens_what_is_searched_and_moves_no_place():
    scene = gear()
    a = Formula(scene).a
    two = scene.replace(**{"time.x_end": 1.5})
    both = dataclasses.replace(two, features=(*two.features, Feature(shape="ridge", height=2e-7, width=5e-5, x=-0.8 * a)))
    one, wide = (StressHistories(s, Formula(scene), Formula(scene).centres) for s in (two, both))
    assert wide.x[0] < one.x[0] and wide.x[-1] == pytest.approx(one.x[-1], abs=1e-15)
    known = {round(float(x) / wide.dx, 6) for x in wide.x}
    assert all(round(float(x) / one.dx, 6) in known for x in one.x)


@pytest.mark.parametrize("kept", [(0, 1, 4, 6, 7, 12), (0, 3, 9, 12), tuple(range(13))])
def test_fields_between_unequal_moments_are_on_their_line(kept):
    """The function t -> (2 t, 5 - t) at moments of one clock, from some of them."""
    times = 0.7 + 1e-6 * np.array(kept, float)
    ticks, dt = equal_steps(times)

    def of(t):
        return np.array([2 * t, 5 - t])

    found = list(between((of(t) for t in times), ticks))
    every = times[0] + dt * np.arange(ticks[-1] + 1)
    assert len(found) == every.size and ticks[-1] * dt == pytest.approx(12e-6)
    np.testing.assert_allclose(found, [of(t) for t in every], rtol=1e-12)


def test_the_early_part_ends_with_the_moment_that_it_names():
    """until: exactly at a stored moment, just before it, just after: as a window of the search (fatigue.to_x) has it."""
    scene = gear()
    reader = Formula(scene)
    at = reader.centres[9] / reader.a
    for until, to_x in ((at, at), (at + 0.4 / CELLS, at), (at - 0.4 / CELLS, reader.centres[8] / reader.a)):
        part = assessment.run(scene, Formula(scene), until=until).summary["resolved"]
        alone = assessment.run(scene.replace(**{"fatigue.to_x": to_x + 1e-6}), Formula(scene)).summary
        assert part["Fi_max"] == pytest.approx(alone["Fi_max"], rel=1e-7)
        assert part["below"]["Fi_max"] == pytest.approx(alone["below"]["Fi_max"], rel=1e-3)
