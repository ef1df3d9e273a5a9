"""Ends of the domain by what they leave of the film, and grids that keep their cells."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.runs.summary import result_warnings
from tehl_taichi.scene import BUILT_INS, domain
from tehl_taichi.scene.film_formula import heated_film
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_text import without_options
from tehl_taichi.values.coded_warning import CodedWarning

BALL = tehl.scene("ball-on-disc").replace(**{"thermal.on": False})
THICK = {"speed": 20.0, "temperature": 60.0, "thermal.on": False}


@pytest.mark.parametrize("ratio", [0.3, 1.0, 3.0])
def test_far_beside_an_ellipse_the_gap_is_that_of_the_rigid_bodies(ratio):
    """y^2/(2 R_y), in a^2/R'."""
    scene, Y = BALL.replace(**{"contact.kind": "elliptic", "contact.radius_y": BALL.contact.radius_x / ratio}), 300.0
    s = Scales.of(scene)
    assert domain.side_gap(s, Y) == pytest.approx((Y * s.b) ** 2 / (2 * scene.contact.radius_y) / s.h, rel=0.02)


@pytest.mark.parametrize("name", ["smooth-line", "mtm", "ball-bearing"])
@pytest.mark.parametrize("thermal", [True, False])
def test_advised_ends_are_at_least_those_of_auto(name, thermal):
    """Also for a computed film that is thinner than that of the formula."""
    for speed in (1.0, 20.0, 80.0):
        scene = tehl.scene(name).replace(**{"speed": speed, "temperature": 60.0, "thermal.on": thermal})
        film = heated_film(scene) / Scales.of(scene).h
        for share in (0.3, 1.0, 2.0):
            advised = domain.remedy(scene, share * film)
            assert advised["x_min"] <= scene.grid.x_min and advised.get("y_max", scene.grid.y_max) >= scene.grid.y_max


def error_by_formula(scene, gap):
    """Share of the film that an inlet leaves: part with the pressure at the border, of the loss of cold oil without it."""
    cold, heated = domain.central_film(scene), heated_film(scene)
    part = 0.015 + (0.0 if scene.isothermal else min(3.5 / (1 + gap / min(cold, 3.3 * heated)), 0.25))
    return part * ((1 + gap / cold) / 1.4) ** -1.5


@pytest.mark.parametrize("heat, least", [(False, domain.GAPS), (True, domain.HEATED)])
def test_an_automatic_inlet_is_the_nearest_where_film_and_gap_are_enough_films(heat, least):
    """Of film and gap together, and little error of the cold oil before it; in steps of 8 % of the speed."""
    line, found = tehl.scene("smooth-line").replace(**{**THICK, "hertz_pressure": 5e8, "thermal.on": heat}), []
    for speed in np.geomspace(1.0, 50.0, 45):
        scene = line.replace(speed=float(speed))
        s, end = Scales.of(scene), -scene.grid.x_min
        films = [1 + domain.inlet_gap(s, X) * s.h / domain.heated_film(scene) for X in domain.INLETS]
        errors = [error_by_formula(scene, domain.inlet_gap(s, X) * s.h) for X in domain.INLETS]
        enough = [X for X, count, error in zip(domain.INLETS, films, errors) if count >= least and error <= 0.006]
        found.append(end)
        assert end == [*enough, 20.0][0]
    assert len(set(found)) > 1


@pytest.mark.parametrize("pressure, speed, temperature, srr, end", [
    (3.5e8, 50.0, 60.0, -1.0, -20.0), (5e8, 50.0, 40.0, -1.0, -20.0), (8e8, 20.0, 30.0, -0.5, -10.5),
    (1.5e9, 5.0, 80.0, -0.3, -2.5)])
def test_an_inlet_of_a_film_that_heat_thins_has_the_distance_of_a_colder_one(pressure, speed, temperature, srr, end):
    """From -10.5, -6.5 and -6.5 a their bars had 6, 18 and 3 % by the domain, with a warning; the last film is usual."""
    scene = tehl.scene("smooth-line").replace(**{"hertz_pressure": pressure, "speed": speed, "temperature": temperature,
                                                 "srr": srr})
    assert scene.grid.x_min == end


def test_a_passage_asks_for_a_longer_domain_than_its_start():
    scene = tehl.scene("gear").replace(**THICK)
    passage, start = (domain.within(one, 3e-3).grid.x_min for one in (scene, scene.replace(**{"time.steady_only": True})))
    assert scene.transient and passage < start


def test_ends_that_are_advised_leave_as_little_as_they_say():
    """At both ends, by the law of what an end costs: a part of (gap over film)^(-3/2)."""
    s = Scales.of(BALL)
    for film in np.geomspace(0.03, 0.3, 40):
        found = domain.remedy(BALL, film)
        for gap, part in ((domain.inlet_gap(s, found["x_min"]), domain.INLET),
                          (domain.side_gap(s, found["y_max"]), domain.SIDE)):
            assert domain.LEFT["point"] * ((1 + gap / film) / part) ** -1.5 <= domain.LITTLE


def test_an_advised_grid_keeps_the_size_of_the_cells():
    scene = BALL.replace(**{"grid.nx": 128, "grid.ny": 48, "grid.x_min": -2.5, "grid.y_max": 1.5})
    g = scene.grid
    nx, ny = map(int, re.findall(r"\d+", str(domain.same_cells(scene, x_min=-6.5, y_max=3.0))))
    assert (g.x_max + 6.5) / nx == pytest.approx((g.x_max - g.x_min) / g.nx, rel=0.1)
    assert 3.0 / ny == pytest.approx(g.y_max / g.ny, rel=0.1)


def test_a_moved_inlet_is_told_with_the_grid_that_is_as_fine_as_before():
    scene = tehl.scene("smooth-line").replace(**{**THICK, "hertz_pressure": 5e8, "grid.nx": 256})
    g, nx = scene.grid, int(re.search(r"--grid (\d+)", str(domain.moved(scene)))[1])
    usual = domain.OUTLETS[0] + domain.INLETS[0]
    assert g.x_max - g.x_min > 2 * usual and (g.x_max - g.x_min) / nx == pytest.approx(usual / 256, rel=0.08)


@pytest.mark.parametrize("name", ["smooth-line", "ball-on-disc"])
def test_an_outlet_moves_behind_the_rupture_of_a_thick_film_and_is_told(name):
    """The gap there is RUPTURED films, and no nearer end has it; a user's own end stays."""
    thick = tehl.scene(name).replace(**{"contact.load": 0.0, "contact.moes_M": 0.5, "contact.moes_L": 10.0, "grid.nx": 256,
                                        "oil.name": "moes-test-fluid", "grid.x_min": "auto", "grid.x_max": "auto",
                                        "thermal.on": False})
    s, g = Scales.of(thick), thick.grid
    film = heated_film(thick) / s.h
    ratios = {end: 1 + domain.inlet_gap(s, end) / film for end in domain.OUTLETS if end <= g.x_max}
    assert ratios.popitem()[1] >= domain.RUPTURED[s.kind] > max(ratios.values())
    assert f"to {g.x_max:g} a" in domain.moved(thick)
    assert thick.replace(**{"grid.x_max": 1.5}).grid.x_max == tehl.scene("gear").grid.x_max == 1.5
    assert domain.outlet(thick) == g.x_max


@pytest.mark.parametrize("pressure, speed, srr, film", [
    (1e8, 5.0, 0.0, 364.2), (2e8, 20.0, -0.5, 86.6), (3.5e8, 20.0, -0.5, 7.28), (3.5e8, 20.0, 0.0, 7.54),
    (5e8, 50.0, -1.0, 2.82)])
def test_an_outlet_is_behind_the_rupture_of_a_hot_thick_film(pressure, speed, srr, film):
    """Films computed on 64 columns, a^2/R': up to three times the formula with the heat of the inlet. By this formula the first
    three ended before their rupture."""
    thick = tehl.scene("smooth-line").replace(**{"hertz_pressure": pressure, "speed": speed, "temperature": 40.0, "srr": srr,
                                                 "grid.nx": 256})
    s, end = Scales.of(thick), thick.grid.x_max
    assert 1 + domain.inlet_gap(s, end) / film >= domain.RUPTURED["line"] and end == domain.outlet(thick)
    assert end <= thick.replace(**{"thermal.on": False}).grid.x_max  # an isothermal film is thicker


@pytest.mark.parametrize("scene, end", [(tehl.scene("smooth-line"), {"grid.x_min": -1.2}), (BALL, {"grid.y_max": 1.2})])
def test_a_fixed_end_within_the_film_is_too_short(scene, end):
    """Not for a thin film, nor for ends by the program or by the option, nor where the scene starves the inlet."""
    thick = scene.replace(**{**THICK, "speed": 5.0, "hertz_pressure": 4e8, "grid.x_min": "auto", "grid.y_max": "auto"})
    short, (key, value) = thick.replace(**end), *end.items()
    text = domain.too_short(short)
    s, film = Scales.of(short), float(re.search(r"of the formula \((\S+) m\)", text)[1])
    gap = domain.side_gap(s, value) if key == "grid.y_max" else domain.inlet_gap(s, value)
    assert text.startswith(f"the gap at {key} = {value:g} is only {1 + gap * s.h / film:.2f} times the film")
    farther = {found: float(far) for found, far in re.findall(r"--set (\S+)=(\S+)", text)}
    assert abs(farther[key]) > abs(value)
    assert [str(one) for one in short.typed_warnings if one.code == "domain"] == [text] and "--" not in without_options(text)
    for enough in (thick, short.replace(**farther), scene.replace(**end), short.replace(**{"grid.inlet": "starved"})):
        assert not domain.too_short(enough) and "domain" not in {one.code for one in enough.warnings()}


def test_a_computed_loss_replaces_the_estimate_of_a_short_domain(monkeypatch):
    """One sentence about a domain, not two; other warnings of the scene stay."""
    estimates = [CodedWarning("by formula", "domain"), CodedWarning("coarse", "cells")]
    store = SimpleNamespace(scene=SimpleNamespace(typed_warnings=estimates), warnings=[])
    for found in ([CodedWarning("computed", "domain")], []):
        monkeypatch.setattr(result_warnings, "coded_warning", lambda *_, found=found: found)
        assert result_warnings.warnings(store, {}) == [*estimates[len(found):], *found]


@pytest.mark.parametrize("speed", [0.01, 0.1, 0.5])
def test_a_film_that_is_not_thin_beside_the_ball_is_doubted(speed):
    """Whatever the speed: above a hundredth of the radius, where no domain helps."""
    scene = tehl.scene("ball-on-disc").replace(hertz_pressure=1e8, speed=speed)
    share = heated_film(scene) / Scales.of(scene).R
    found = {one.code: one.data for one in scene.warnings()}
    assert ("thick" in found, "domain" in found) == ((True, False) if share > 0.01 else (False, True))
    assert share < 0.01 or found["thick"]["film_m"] / found["thick"]["reduced_radius_m"] == pytest.approx(share)


@pytest.mark.parametrize("name", BUILT_INS)
def test_built_in_scenes_have_thin_films_on_domains_that_are_long_enough(name):
    assert not {"thick", "domain"} & {one.code for one in tehl.scene(name).warnings()}
