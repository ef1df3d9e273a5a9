"""The part of the sides of a line contact in the error bars of a passage."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from advice import advised

from tehl_taichi.fatigue.assessment import Snapshots
from tehl_taichi.march.accuracy.domain_error import SIDES, DomainError
from tehl_taichi.march.accuracy.side_change import side_change
from tehl_taichi.march.passage import march
from tehl_taichi.runs.summary import domain_warnings
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

COARSE = {"grid.nx": 64, "thermal.on": False, "fatigue.on": False, "numerics.estimate_error": False}


class Films:
    """Reader of films (entries, x, y)."""

    def __init__(self, description, films):
        a, count = Scales.of(description).a, films.shape[1]
        self.films, self.x = films, np.linspace(-2.5 * a, 1.5 * a, count)

    def __len__(self):
        return len(self.films)

    def fields(self, n, names):
        assert names == ("film",)
        return {"film": self.films[n]}


def films(description, last=(), outside=1.0, first=()):
    """Reader of 40 films of 1 um on 81 x 9 nodes; the 20th differs by these factors in its last and its first row inside the
    contact, and outside.
    """
    values = np.full((40, 81, 9), 1e-6)
    inside = slice(40, 60)  # -0.5 to 0.45 a
    for factor, row in [*((one, -1) for one in last), *((one, 0) for one in first)]:
        values[10:30, inside, row] *= factor
    values[20, 75] *= outside
    return Films(description, values)


def test_the_largest_change_at_a_side_counts():
    gear = scene("gear")
    assert side_change(gear, films(gear)) == 0.0
    assert side_change(gear, films(gear, last=[1.03])) == pytest.approx(0.03)
    assert side_change(gear, films(gear, last=[0.93])) == pytest.approx(0.07)
    assert side_change(gear, films(gear, outside=2.0)) == 0.0  # behind the contact
    assert side_change(gear, films(gear, first=[1.5])) == 0.0  # the plane of symmetry is no side
    off = gear.replace(**{"feature.y": 5e-5})
    assert side_change(off, films(off, first=[1.5])) == pytest.approx(0.5)


def test_only_features_that_end_between_the_sides_of_a_line_contact_count():
    gear = scene("gear")
    edge = Scales.of(gear).b * gear.grid.y_max
    for other in (scene("smooth-line"), replace(scene("ball-on-disc"), features=gear.features),
                  scene("furrow-line"), gear.replace(**{"feature.y": 0.95 * edge})):
        assert side_change(other, films(other, last=[1.2], first=[1.2])) == 0.0
    there, = gear.replace(**{"feature.y": 0.95 * edge}).features
    ridge, = gear.replace(**{"feature.shape": "ridge"}).features
    # one of two, at the other side, or one of two that changes both sides by itself
    for both in ((*gear.features, there), (replace(there, y=-there.y),), (*gear.features, ridge), (ridge, *gear.features)):
        other = replace(gear, features=both)
        assert side_change(other, films(other, last=[1.2], first=[1.2])) == 0.0
    assert side_change(gear, Films(gear, np.ones((1, 81, 9)))) == 0.0


def test_the_part_of_the_sides_adds_as_a_square():
    """To all numbers of a passage; of temperatures to their rise."""
    known, sides = DomainError(film=1e-3, friction=2e-3), 0.02
    both = DomainError(film=1e-3, friction=2e-3, sides=sides)
    for name, value, size in (("h_min_m", 1e-7, 1e-7), ("p_max_Pa", 2e9, 2e9), ("b:Fi_max", 1.5, 1.5),
                              ("friction_coefficient_mean", 0.05, 0.05), ("film_max_C", 190.0, 100.0)):
        part = math.hypot(known.of(name, value, 90.0, True), SIDES * sides * size)
        assert both.of(name, value, 90.0, True) == pytest.approx(part)
    assert DomainError.from_values(both.values()).sides == sides


@pytest.mark.usefixtures("taichi_cpu")
def test_narrow_domains_err_by_no_more_than_their_part():
    """Largest pressure, smallest film in the middle and mean friction, against sides three times as far away."""
    found = []
    for y_max, ny in ((0.5, 8), (1.5, 24)):
        one = scene("gear").replace(**COARSE, **{"grid.y_max": y_max, "grid.ny": ny, "operation.srr": -0.12})
        shots = [*march(one)]
        middle = min(shots[1:], key=lambda shot: abs(shot.feature_x))
        found.append((side_change(one, Snapshots(shots)), np.array([
            max(shot.scalars["p_max_Pa"] for shot in shots[1:]), middle.scalars["h_min_m"],
            np.mean([shot.scalars["friction_coefficient"] for shot in shots[1:]])])))
    (narrow, values), (wide, truth) = found
    errors = np.abs(values / truth - 1)
    assert 0.02 < narrow < 0.06 and wide < 0.3 * narrow
    assert (errors < SIDES * narrow).all() and errors.max() > 0.1 * SIDES * narrow


@pytest.mark.usefixtures("taichi_cpu")
def test_near_sides_are_a_warning_with_a_domain_that_suffices(tmp_path):
    import tehl_taichi as tehl

    near = scene("gear").replace(**COARSE, **{"grid.y_max": 0.4, "grid.ny": 8})
    summary = tehl.run(near, tmp_path / "near.zarr").summary
    said, = (text for text, code in zip(summary["warnings"], summary["warning_codes"]) if code == "sides")
    assert "grid.y_max = 0.4 b" in said and summary["domain"]["side_change"] > 0.02
    y_max, ny = advised("y_max", said), int(advised("ny", said))
    assert ny / y_max >= 8 / 0.4 and y_max < 2
    wide = tehl.run(near.replace(**{"grid.y_max": y_max, "grid.ny": ny}), tmp_path / "wide.zarr").summary
    assert "sides" not in wide["warning_codes"] and 0 < wide["domain"]["side_change"] < 0.02


def test_far_sides_are_no_warning():
    store = SimpleNamespace(scene=scene("gear"))
    assert not [*domain_warnings.near_sides(store, {"domain": {"side_change": 0.0199}})]
    assert not [*domain_warnings.near_sides(store, {"domain": {}})]
    assert len([*domain_warnings.near_sides(store, {"domain": {"side_change": 0.0201}})]) == 1
