"""Passages: balances, the film under a feature, steps that fail, going on, symmetries, order in time.

Isothermal and, unless said, Newtonian: the limits of the film and the pressure under the asperity are those of such a film.
"""

import numpy as np
import pytest

from tehl_taichi.errors import Error
from tehl_taichi.march.accuracy.peaks import ripple
from tehl_taichi.march.passage import NotConverged, Passage, march
from tehl_taichi.scene import scene as built_in
from tehl_taichi.scene.scales import Scales

pytestmark = pytest.mark.usefixtures("taichi_cpu")


def scene(name="gear"):
    return built_in(name).replace(**{"thermal.on": False, "rheology.law": "newtonian"})


def test_the_disturbance_of_a_furrow_travels_with_the_oil():
    """The film that the furrow (u_a = u_m/2) let in at the inlet moves ahead of it with u_m; its pressure does not ripple (it
    did by 1.2 % on steps of two cells, which nothing damped)."""
    description = scene("furrow-line")
    S, speeds = Scales.of(description), []
    steps = list(march(description))
    for one, later in zip(steps[1:], steps[5:]):
        at = one.feature_x / S.a
        if -0.75 < at < -0.1:
            X = np.linspace(at + 0.3, 0.6, 200)
            film = [np.interp(X, one.x / S.a, one.fields["film"][:, 0])]
            shifts = np.linspace(0, 0.3, 301)
            misfit = [np.sum((film[0] - np.interp(X + q, later.x / S.a, later.fields["film"][:, 0])) ** 2) for q in shifts]
            speeds.append(shifts[int(np.argmin(misfit))] * S.a / (later.time - one.time))
    assert np.median(speeds) == pytest.approx(description.operation.u_m, rel=0.005)
    assert max(ripple(s.fields["pressure"])[0] for s in steps) < 0.003 * max(s.scalars["p_max_Pa"] for s in steps)


def passage(**changes):
    return list(march(scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, **changes})))


@pytest.mark.parametrize("law", ["newtonian", "limiting"])
def test_coarse_passage_conserves_and_leaves_the_steady_state_behind(law):
    steps = passage(**{"rheology.law": law})
    assert min(s.scalars["h_min_m"] for s in steps) > 0
    for s in steps:
        assert s.scalars["load_error"] < 1e-6 and s.scalars["residual"] < 1e-6 and s.scalars["mass_error"] < 1e-6
    effort = sorted(s.scalars["cycles"] for s in steps[1:])
    assert effort[-1] < 80
    assert max(s.scalars["p_max_Pa"] for s in steps) > 1.5 * steps[0].scalars["p_max_Pa"]
    assert steps[-1].scalars["p_max_Pa"] == pytest.approx(steps[0].scalars["p_max_Pa"], rel=0.02)
    S, description = Scales.of(scene()), scene()  # the feature moves with its surface from the steady start on
    moved = [s.feature_x - description.path[0] * S.a for s in steps[1:]]
    assert moved == pytest.approx([s.time * description.reference.speed for s in steps[1:]]) and steps[0].time == 0.0


def test_film_under_the_asperity_stays_what_it_was_let_in_as():
    """128 columns: within 5 % of the limit 0.142 um, and the same all along the contact."""
    steps = [s for s in march(scene("gear").replace(**{"grid.nx": 128, "grid.ny": 32})) if s.step]
    inside = [s for s in steps if abs(s.feature_x) < 0.2e-3]
    films = np.array([s.scalars["h_min_m"] for s in inside])
    assert len(inside) > 30 and films == pytest.approx(0.142e-6, rel=0.05) and np.ptp(films) < 0.015 * films.mean()
    centre = min(inside, key=lambda s: abs(s.feature_x))
    assert centre.scalars["p_max_Pa"] == pytest.approx(3.98e9, rel=0.003)


def test_snapshots_of_one_dimension_do_not_share_their_arrays():
    """A row needs no turning into columns: what a snapshot keeps must be its own all the same."""
    description = built_in("furrow-line").replace(**{"thermal.on": False, "grid.nx": 64, "time.steps": 2})
    shots = list(march(description))
    assert description.one_dimensional and len(shots) == 3
    for name, values in shots[1].fields.items():
        assert not np.shares_memory(values, shots[2].fields[name]), name


def test_touching_asperity_never_goes_negative():
    steps = passage(height=3e-6)
    assert min(s.scalars["h_min_m"] for s in steps) > 0
    assert max(s.scalars["contact_load_fraction"] for s in steps) > 0
    assert all(s.scalars["residual"] < 1e-6 for s in steps)


@pytest.mark.parametrize("thermal", [False, True])
def test_going_on_from_a_state_repeats_the_run(thermal):
    description = scene("gear").replace(**{"thermal.on": thermal, "grid.nx": 64, "grid.ny": 16, "time.steps": 12})
    run = march(description)
    whole = [next(run) for _ in range(6)]
    state = whole[-1].state
    whole += run
    rest = list(march(description, state))
    assert len(rest) == 7
    with pytest.raises(Error, match="state of step 4 is no longer available"):
        march(description, whole[4].state)
    for name, values in rest[-1].fields.items():
        assert np.array_equal(values, whole[-1].fields[name]), name


def test_a_step_that_fails_is_taken_in_parts(monkeypatch):
    changes = {"time.steps": 60, "time.courant": 0.25}
    whole = passage(**changes)
    solve, calls = Passage._solve, []

    def failing(self):
        report = solve(self)
        calls.append(report)
        if len(calls) in (40, 41):  # step 40 and its first half are declared lost
            report.converged = False
        return report

    monkeypatch.setattr(Passage, "_solve", failing)
    parts = passage(**changes)
    assert [s.step for s in parts] == [s.step for s in whole] and sum(s.scalars["rejected"] for s in parts) == 2
    assert parts[-1].scalars["p_max_Pa"] == pytest.approx(whole[-1].scalars["p_max_Pa"], rel=2e-3)
    assert parts[-1].time == whole[-1].time


def test_a_step_that_never_converges_stops_with_the_reason(monkeypatch):
    solve = Passage._solve

    def failing(self):
        report = solve(self)
        report.converged = self.step < 3
        return report

    monkeypatch.setattr(Passage, "_solve", failing)
    with pytest.raises(NotConverged, match=r"step 4 .* down to 0.015625"):
        passage()


BALL = {"grid.nx": 64, "grid.ny": 32, "time.steps": 12, "time.x_start": -1.5}


def on_ball(y, **changes):
    """A bump on the ball after 12 steps, centred at y (m)."""
    description = scene("ridge-on-ball").replace(**{"feature.shape": "cosine", "feature.width": 120e-6, **BALL, **changes})
    return list(march(description.replace(**{"feature.y": y})))[-1]


def test_the_whole_domain_gives_the_same_as_the_half():
    half, whole = (on_ball(y, **{"numerics.tolerance": 1e-8}) for y in (0.0, 1e-15))  # 1e-6 is 400 Pa, seen in the outlet
    assert whole.y.size == 2 * half.y.size - 1 and whole.y[0] == -whole.y[-1]
    for name in ("pressure", "film"):
        both = np.hstack([half.fields[name][:, :0:-1], half.fields[name]])
        np.testing.assert_allclose(whole.fields[name], both, rtol=2e-4, atol=2e-4 * np.median(both[both > 0]))


def test_the_first_moment_of_the_whole_domain_has_the_mirrored_shear_across():
    """A feature that has not come yet changes nothing; pressure drives the oil out to both sides."""
    description = scene("ridge-on-ball").replace(**{"feature.shape": "cosine", "feature.width": 120e-6, **BALL,
                                                    "rheology.law": "limiting", "srr": 0.2, "thermal.on": False})
    half, whole = (next(iter(march(description.replace(**{"feature.y": y})))).fields for y in (0.0, 1e-15))
    for name in ("traction_y_a", "traction_y_b"):
        assert np.abs(half[name]).max() > 1e5
        np.testing.assert_array_equal(whole[name], np.hstack([-half[name][:, :0:-1], half[name]]))


def test_a_feature_beside_the_axis_of_a_line_contact():
    """Two bumps at +y and -y are symmetric in themselves, and so is the whole domain."""
    data = scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "time.steps": 24}).to_dict()
    data["feature"] = [{**data["feature"][0], "y": y} for y in (0.4 * 0.362e-3, -0.4 * 0.362e-3)]
    last = list(march(type(scene()).from_dict(data)))[-1]
    P = last.fields["pressure"]
    assert last.y[0] == -last.y[-1] and P.max() > 1.2 * P[:, [0, -1]].max()
    np.testing.assert_allclose(P, P[:, ::-1], rtol=0, atol=2e-3 * P.max())


def test_a_feature_on_the_other_side_of_the_axis_has_the_mirrored_passage():
    """Near the sides, too: with one of them a mirror, the other one a row without end, the film differed by up to 7 %."""
    both = [passage(**{"feature.y": y, "grid.nx": 64, "grid.ny": 16}) for y in (0.2e-3, -0.2e-3)]
    for one, other in zip(*both):
        assert one.scalars["p_max_Pa"] == pytest.approx(other.scalars["p_max_Pa"], rel=2e-5)
        np.testing.assert_allclose(one.fields["film"], other.fields["film"][:, ::-1], rtol=2e-3)
        P = one.fields["pressure"]
        np.testing.assert_allclose(P, other.fields["pressure"][:, ::-1], rtol=0, atol=1e-4 * P.max())


def test_mirror_symmetry_of_friction():
    both = [passage(srr=srr, **{"time.steady_only": True, "rheology.law": "limiting"})[0]
            for srr in (-0.12, 0.12)]
    assert np.allclose(both[0].fields["traction_x_a"], both[1].fields["traction_x_b"], rtol=1e-12, atol=1e-3)


@pytest.mark.slow
def test_isothermal_passage_at_the_default_grid():
    description = scene("gear")
    at = min(march(description), key=lambda s: abs(s.feature_x) if s.step else 1)
    assert at.scalars["p_max_Pa"] == pytest.approx(3.98e9, rel=0.003)
    assert at.scalars["h_min_m"] == pytest.approx(0.142e-6, rel=0.02)


@pytest.mark.slow
def test_second_order_in_time():
    ends = []
    for courant in (0.25, 0.125, 0.0625):
        description = scene("gear").replace(**{
            "grid.nx": 64, "grid.ny": 16, "time.courant": courant, "time.x_start": -1.85, "time.x_end": -0.6,
            "numerics.tolerance": 1e-9, "numerics.krylov_tolerance": 1e-3, "height": 0.5e-6, "width": 400e-6})
        ends.append(list(march(description))[-1].fields)
    for name in ("pressure", "film"):
        steps = [np.sqrt(np.mean((a[name] - b[name]) ** 2)) for a, b in zip(ends, ends[1:])]
        assert np.log2(steps[0] / steps[1]) > 1.9
