"""The body without the feature: its material points, which the feature slides over, and what is said of both."""

import made_results
import numpy as np
import pytest
from fatigue.stress.test_material_points import CELLS, Formula, gear

from tehl_taichi.errors import SceneError
from tehl_taichi.fatigue import assessment
from tehl_taichi.fatigue.judged_surfaces import by_surface, others, parts
from tehl_taichi.fatigue.search_result import SearchResult
from tehl_taichi.fatigue.stress import histories
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.report import verdict
from tehl_taichi.runs.summary import summary_rows

pytestmark = pytest.mark.usefixtures("taichi_cpu")
SLIP = {"srr": -0.5, "fatigue.depths": []}
PACE = 1.25 / 0.75  # of surface b


class Carried(Formula):
    """The bump stands still on surface b, at `place` a of it, wide enough for the cells."""

    def pressure(self, n, x):
        at = PACE * self.centres[n] / self.a + self.place
        bump = 0.5 * np.exp(-((x / self.a - at) ** 2) / 0.05) if n else 0.0
        return self.p_H * np.sqrt(np.maximum(1 - (x / self.a) ** 2, 0)) * (1 + bump)


@pytest.mark.parametrize("place", [0.25, -0.25])
def test_points_of_b_move_with_their_surface(place):
    """szz = -p at their place at every moment, by cells of PACE between two of them."""
    scene = gear(**{**SLIP, "fatigue.surfaces": "b"})
    result = assessment.run(scene, reader := Carried(scene, place=place))
    assert result.summary["surface"] == "b" and result.other is None
    assert abs(result.summary["x_m"] / reader.a - place) < 0.25
    at, szz = result.worst["x_a"][:-1], result.worst["stress"][:-1, 2]
    inside = (at > reader.centres[0] + 1e-9) & (at < reader.centres[-1] - 1e-9)
    entries = np.rint((at[inside] - reader.centres[0]) / reader.a * CELLS).astype(int)
    x = PACE * at[inside] + result.summary["x_m"]
    p, smooth = np.array([reader.pressure(*one) for one in zip(entries, x)]), np.abs(np.abs(x / reader.a) - 1) > 3 / CELLS
    np.testing.assert_allclose(-szz[inside][smooth], p[smooth], atol=2e-3 * reader.p_H)  # six nodes do not see an edge
    assert p.max() > 1.2 * reader.p_H and szz[0] == szz[-1] == 0.0  # it comes from outside and leaves


def test_the_window_of_b_is_what_the_feature_slides_over():
    scene = gear(**SLIP)
    own, other = (StressHistories(scene, Formula(scene), Formula(scene).centres, surface=s) for s in scene.surfaces)
    slide = (PACE - 1) * own.a
    assert other.x[0] == pytest.approx(own.x[0] - slide, abs=own.dx) and other.x[-1] == pytest.approx(own.x[-1] + slide,
                                                                                                 abs=own.dx)
    np.testing.assert_array_equal(own.positions, own.centres)
    np.testing.assert_allclose(np.diff(other.centres), PACE * np.diff(other.positions), rtol=1e-9)


def test_the_counted_moments_are_those_of_the_feature_for_both_bodies():
    scene = gear(**SLIP, **{"fatigue.from_x": -0.5, "fatigue.to_x": 0.75})
    for surface in scene.surfaces:
        passage = StressHistories(scene, reader := Formula(scene), reader.centres, surface=surface)
        inside = (reader.centres >= -0.5 * passage.a) & (reader.centres <= 0.75 * passage.a)
        np.testing.assert_allclose(passage.positions, reader.centres[inside], rtol=1e-12)


@pytest.mark.parametrize("place", [0.0, 0.4, -0.7])
def test_a_feature_beside_the_first_one_meets_other_points_as_it_enters_and_leaves(place):
    """Where its centre is at -a and at a, over the points of b that are there then."""
    scene = gear(**SLIP, **{"feature.x": place * Formula(gear(**SLIP)).a})
    b = next(s for s in scene.surfaces if s.name == "b")
    passage = StressHistories(scene, reader := Formula(scene), reader.centres, surface=b)
    feature, moved = scene.features[0], [side * passage.a - scene.features[0].x for side in (-1, 1)]
    inside = np.clip(moved, reader.centres[0], reader.centres[-1])
    assert passage.passed(feature) == pytest.approx(tuple(feature.x + inside - PACE * inside))


def test_fractions_of_a_cell_are_exact_for_polynomials_of_degree_five():
    x = np.arange(20.0)
    fields = np.stack([x**n for n in range(6)], axis=-1)
    found = histories.shifted(fields, 6.37, 5)
    np.testing.assert_allclose(found, np.stack([(6.37 + np.arange(5)) ** n for n in range(6)], axis=-1), rtol=1e-11)
    np.testing.assert_array_equal(histories.shifted(fields, 6.0, 5), fields[6:11])


def without_names(found):
    """A summary without the words that differ between bodies."""
    return {key: without_names(value) if isinstance(value, dict) else value for key, value in found.items()
            if key not in ("surface", "carries_feature")}


def test_equal_bodies_with_equal_loads_have_equal_answers():
    """In rolling, with equal shear on both."""
    scene = gear(**{"srr": 0.0, "fatigue.surfaces": "both"})

    class Same(Formula):
        def fields(self, n, names):
            found = super().fields(n, ())
            found["traction_x_b"] = found["traction_x_a"]
            return {name: found[name] for name in names} if names else found

    found = assessment.run(scene, Same(scene))
    one, other = (without_names(summary) for summary in found.summaries.values())
    assert one == other


def test_a_body_at_rest_is_refused_by_its_name():
    scene = gear(**{"srr": 2.0, "fatigue.surfaces": "b"})
    with pytest.raises(SceneError, match="surface b is at rest"):
        assessment.run(scene, Formula(scene))


def test_the_worse_body_leads_and_the_other_is_kept():
    scene = gear(**{**SLIP, "fatigue.surfaces": "both"})
    found = assessment.run(scene, Formula(scene))
    first, second = found.summaries
    assert found.summary["Fi_max"] > found.other.summary["Fi_max"] and {first, second} == {"a", "b"}
    assert found.maps["other_Fi"][0].shape == found.other.Fi.shape and found.maps["other_Fi"][1][0] == "other_feature_frame_x"
    summary = {"fatigue": found.summary, "fatigue_by_surface": found.summaries}
    assert by_surface(summary) == found.summaries and list(others(summary)) == [second]
    assert by_surface({"fatigue": {"Fi_max": 1.0}}) == {"a": {"Fi_max": 1.0}}  # of a version that searched body a alone
    rows = dict(summary_rows.fatigue_rows(found.summary, others(summary)))
    assert rows["worse body"] == first and any(f"({second})" in what for what in rows)


def test_the_body_that_decides_leads_where_the_other_has_more_in_the_whole_passage():
    """Body a has more in moments that the grid does not resolve; b decides, in tables, on the screen and on pages."""
    early = {name: {**made_results.fatigue(Fi, None), "error": {"Fi_max": 0.01}, "to_x_a": 0.5} for name, Fi in
             (("a", 0.7), ("b", 0.9))}
    whole = {name: {**made_results.fatigue(Fi, None), "surface": name, "error": {"Fi_max": None}}
             for name, Fi in (("a", 1.5), ("b", 1.3))}
    resolved = {name: {**one, "resolved": early[name]} for name, one in whole.items()}
    for searches, decides in ((resolved, "b"), (whole, "a")):
        found = SearchResult.joined([SearchResult(one, Fi=one["Fi_max"]) for one in searches.values()]).decided()
        assert list(found.summaries)[0] == decides and found.Fi == searches[decides]["Fi_max"]
        assert found.other.other is None and found.other.Fi == searches[found.other.summary["surface"]]["Fi_max"]
        summary = parts(found.summaries)
        assert summary["fatigue"] is searches[decides]
        assert dict(summary_rows.fatigue_rows(summary["fatigue"], others(summary)))["worse body"] == decides


@pytest.mark.parametrize("Fi_a, Fi_b, said", [((1.2, 0.01), (0.9, 0.01), "Yes: the fatigue limit is exceeded at surface a."),
                                              ((0.9, 0.01), (0.8, 0.3), "Not decided: the index is 1 within its error at "
                                                                        "surface b."),
                                              ((1.2, None), (1.5, 0.05), "Yes: the fatigue limit is exceeded at surface b."),
                                              ((0.9, None), (0.8, 0.01), "Probably not: the index stays below 1; the error of "
                                                                         "this is unknown."),
                                              ((0.9, 0.01), (0.8, 0.01), "No: the index stays below 1.")])
def test_the_verdict_is_of_both(Fi_a, Fi_b, said):
    def search(name, Fi, error):
        return {"surface": name, "Fi_max": Fi, "error": {"Fi_max": error}, "surface_angle_deg": 60.0}

    _, headline, _, tells = verdict.of_fatigue(search("a", *Fi_a), beside={"b": search("b", *Fi_b)})
    assert headline == said and sum(one.startswith("At surface") for one in tells) == 2
