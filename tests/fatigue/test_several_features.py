"""Several features: the searched points and the numbers do not depend on their order, nor on a place without effect."""

from dataclasses import replace

import numpy as np
import pytest
from fatigue.stress.test_material_points import CELLS, Formula, gear

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment, index_statistics
from tehl_taichi.fatigue.stress.histories import StressHistories

pytestmark = pytest.mark.usefixtures("taichi_cpu")


class Whole(Formula):
    """Rows on both sides of the axis, whose bump grows towards y = a."""

    def __init__(self, scene, **more):
        super().__init__(scene, **more)
        self.y = np.linspace(-1, 1, 2 * CELLS + 1) * self.a

    def fields(self, n, names):
        return {name: field * (1 + 0.1 * self.y / self.a) for name, field in super().fields(n, names).items()}


def small(*places, **changes):
    """Small asperities of surface a at (x, y), in cells."""
    scene = gear(**{"feature.width": 100e-6, **changes})
    cell = Formula(scene).a / CELLS
    return replace(scene, features=tuple(replace(scene.features[0], x=x * cell, y=y * cell) for x, y in places))


def searched(scene):
    """(x', y) of the searched points, in cells."""
    reader = Whole(scene)
    passage = StressHistories(scene, reader, reader.centres)
    return (side * CELLS / reader.a for side in (passage.x, passage.y))


def test_their_order_changes_no_number():
    scene = small((0, 2), (0, -5))
    one, other = (assessment.run(of, Whole(of)) for of in (scene, replace(scene, features=scene.features[::-1])))
    assert one.summary["below"]["statistics"]["points"] and one.summary == other.summary
    np.testing.assert_array_equal(one.Fi, other.Fi)


def test_the_part_around_each_is_as_wide():
    """Counted from the first feature or from the second one."""
    (first, _), (second, _) = (searched(small(*places)) for places in (((0, 0), (6, 0)), ((-6, 0), (0, 0))))
    np.testing.assert_allclose(first - 6, second, atol=1e-9)


@pytest.mark.parametrize("y", [3, -4])
def test_the_part_around_a_feature_moves_with_it(y):
    (_, axis), (_, beside) = (searched(small((0, at))) for at in (0, y))
    np.testing.assert_allclose(beside, axis + y, atol=1e-9)


def test_every_point_passes_a_feature_of_a_surface_at_rest():
    scene = gear(srr=2.0)
    cell = Formula(scene).a / CELLS
    still = replace(scene.features[0], surface="b", y=4 * cell, width=4 * cell)
    scene = replace(scene, features=(*scene.features, still))
    passage = StressHistories(scene, reader := Whole(scene), reader.centres)
    at = np.argmin(np.abs(passage.y - still.y))
    assert (index_statistics.weights(passage)[:, at] == 1).all()
    assert assessment.run(scene, reader).summary["statistics"]["points"] > passage.x.size


def test_the_place_of_a_ridge_along_itself_changes_nothing():
    scene = tehl.scene("ridge-on-ball").replace(**{"grid.nx": 64, "grid.ny": 16})
    found = [assessment.run(of, Formula(of)).summary for of in (scene, scene.replace(**{"feature.y": 0.4 * Formula(scene).a}))]
    assert found[0] == found[1]
