"""Films by formula: of the contact that there is, with what is known of how good they are, and its half-axes."""

import math

import pytest
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.report import scene_text
from tehl_taichi.runs.summary.summary_rows import summary_rows
from tehl_taichi.scene import film_formula, hertz
from tehl_taichi.scene.film_formula import central_film, formula_words, moes_line, moes_numbers, nijenbanning, spread
from tehl_taichi.scene.scales import Scales, reduced_modulus
from tehl_taichi.view.figures import map_panels

FILM = {"rheology.law": "newtonian", "thermal.on": False, "srr": 0.0}


def ellipse(ratio, p_H=1e9, speed=2.0, **changes):
    """A contact of R_x = 10 mm and R_x/R_y = ratio."""
    kind = "point" if ratio == 1 else "elliptic"
    return tehl.scene("smooth-line").replace(**{**FILM, "contact.kind": kind, "contact.radius_x": 10e-3, "speed": speed,
                                                "contact.radius_y": 10e-3 / ratio, "hertz_pressure": p_H, **changes})


def dimensionless(scene):
    """U, G, W of Hamrock & Dowson, and R_x."""
    s, E, Gamma = Scales.of(scene), reduced_modulus(scene), scene.operation.temperature
    eta0 = math.exp(film_formula.ln_eta(scene.oil, 0.0, Gamma))
    return eta0 * s.u_m / (E * s.R), E * film_formula.pressure_coefficient(scene.oil, Gamma), scene.load / (E * s.R**2), s.R


def chittenden(scene):
    """Central film of Chittenden, Dowson, Dunn & Taylor 1985, flow along an axis of the ellipse."""
    U, G, W, R = dimensionless(scene)
    return 4.31 * U**0.68 * G**0.49 * W**-0.073 * (1 - math.exp(-1.23 * Scales.of(scene).curvature ** (-2 / 3))) * R


def hamrock_dowson(scene):
    """Central film of Hamrock & Dowson 1977, for ellipses that are longer across."""
    U, G, W, R = dimensionless(scene)
    k = 1.03 * Scales.of(scene).curvature ** -0.64
    return 2.69 * U**0.67 * G**0.53 * W**-0.067 * (1 - 0.61 * math.exp(-0.73 * k)) * R


@pytest.mark.parametrize("ratio", [0.1, 0.2, 0.5, 1.0])
@pytest.mark.parametrize("p_H", [0.5e9, 1e9, 2e9])
@pytest.mark.parametrize("speed", [1.0, 5.0])
def test_three_formulas_of_ellipses_agree(ratio, p_H, speed):
    scene = ellipse(ratio, p_H, speed)
    for other in (chittenden, hamrock_dowson):
        assert central_film(scene) == pytest.approx(other(scene), rel=0.16)


@pytest.mark.parametrize("ratio", [0.1, 0.2, 2.0, 5.0])
def test_an_ellipse_is_no_circle(ratio):
    scene = ellipse(ratio)
    M, L = _moes(scene)
    circle = nijenbanning(M, L) / nijenbanning(M, L, ratio) * central_film(scene)
    assert abs(chittenden(scene) / central_film(scene) - 1) < abs(chittenden(scene) / circle - 1) - 0.05


def _moes(scene):
    s, E, Gamma = Scales.of(scene), reduced_modulus(scene), scene.operation.temperature
    eta0 = math.exp(film_formula.ln_eta(scene.oil, 0.0, Gamma))
    return moes_numbers(scene.load, s.R, E, eta0, film_formula.pressure_coefficient(scene.oil, Gamma), s.u_m, "point")


@pytest.mark.parametrize("M, L", [(300.0, 10.0), (300.0, 2.0), (3000.0, 10.0), (3000.0, 0.5)])

def test_a_long_ellipse_is_a_line_at_its_largest_load_per_width(M, L):
    ratio, R, E, U = 0.02, 1.0, 1.0, 1e-12
    a, _, p_H = hertz.ellipse(M * E * R**2 * U**0.75, R, R / ratio, E)
    line = moes_line(math.pi / 2 * p_H * a / (E * R) * U**-0.5, L)
    assert nijenbanning(M, L, ratio) == pytest.approx(line, rel=0.15)


def test_a_circle_is_what_it_was():
    """By hand: the asymptote of elastic bodies and thick oil of a circle, 1.48 1.63^-0.35 M^(-1/12) L^0.75."""
    assert nijenbanning(1e4, 20.0) == pytest.approx(1.48 * 1.63**-0.35 * 1e4 ** (-1 / 12) * 20**0.75, rel=0.03)


@pytest.mark.parametrize("scene, within, words", [
    (tehl.scene("smooth-line").replace(hertz_pressure=0.8e9), 0.09, "Moes, line, isothermal, Newtonian: within 9%"),
    (tehl.scene("smooth-line"), 0.16, "Moes, line, isothermal, Newtonian, heavy load: within 16%"),
    (tehl.scene("smooth-line").replace(hertz_pressure=3.5e9), 0.25, "heavy load: within 25%"),
    (ellipse(0.5), 0.07, "Nijenbanning, Venner & Moes, elliptic, isothermal, Newtonian: within 7%"),
    (ellipse(1.0), 0.07, "point"), (ellipse(2.0), 0.15, "within 15%"), (ellipse(0.5, 2.5e9), 0.25, "heavy load: within 25%"),
    (ellipse(0.05), 0.25, "within 25%"),
    (tehl.scene("mtm").replace(hertz_pressure=6e8, speed=10.0), 0.3, "thick film: within 30%"),
    (tehl.scene("smooth-line").replace(hertz_pressure=5e8, speed=20.0), 0.3, "thick film: within 30%")])
def test_how_good_a_formula_is_is_said(scene, within, words):
    assert spread(scene) == within and words in formula_words(scene)


@pytest.mark.parametrize("name, p_H, speed", [("mtm", 3e8, 1.0), ("smooth-line", 4e8, 20.0)])
def test_thick_films_are_thinner_than_the_formula(name, p_H, speed):
    """By more than its error for other films, and by less than stated."""
    scene = tehl.scene(name).replace(**{**FILM, "hertz_pressure": p_H, "speed": speed, "srr": 0.0, "rheology.law": "newtonian"})
    steady, = tehl.simulate(scene)
    assert 0.1 < central_film(scene) / steady.scalars["h_c_m"] - 1 < spread(scene)


@pytest.mark.parametrize("p_H", [0.5e9, 1e9, 3e9])
def test_films_of_lines_lie_within_it(p_H):
    scene = tehl.scene("smooth-line").replace(**FILM, **{"grid.nx": 256, "hertz_pressure": p_H, "speed": 10.0})
    steady, = tehl.simulate(scene)
    assert steady.scalars["h_c_m"] == pytest.approx(central_film(scene), rel=spread(scene) + 0.01)


def test_an_ellipse_says_its_half_axes_and_its_film(tmp_path):
    scene = ellipse(0.5, **{"grid.nx": 64, "grid.ny": 32, "grid.y_max": 1.6})
    run, s = tehl.run(scene, tmp_path / "a.zarr"), Scales.of(scene)
    assert run.summary["hertz"] == {"a_m": s.a, "b_m": s.b, "p_Pa": s.p_H} and s.b > 1.5 * s.a
    steady = run.summary["steady"]
    assert steady["h_c_m"] == pytest.approx(steady["film_formula_m"], rel=0.12)  # the grid is coarse
    rows = dict(summary_rows(run.summary))
    assert rows["Hertz half-axis b, across"] == f"{s.b * 1e3:.4f} mm"
    assert any(what.startswith("h_c by formula (Nijenbanning") and "elliptic" in what for what in rows)
    assert any("half-axis b" in what for what, _ in scene_text.numbers(scene))
    assert "across" in " ".join(scene_text.words(scene))
    assert map_panels.half_axis(scene) == f" (b = {s.b / s.a:.3g} a)" and map_panels.half_axis(ellipse(1.0)) == ""
    assert run.save_figures(tmp_path / "p")


def test_a_dry_run_tells_the_contact_and_starts_nothing(tmp_path, monkeypatch):
    from tehl_cli.main import app

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("tehl_taichi.engine.runtime.start", lambda *_, **__: pytest.fail("started"))
    words = ["run", "ball-on-disc", "--set", "contact.kind=elliptic", "--set", "contact.radius_y=0.03", "--dry-run"]
    done = CliRunner().invoke(app, [*words, "--set", "fatigue.length=5e-6"])
    assert done.exit_code == 0 and not list(tmp_path.iterdir())
    for said in ("half-width a = ", "half-axis b = ", "p_H = ", "h_c by formula: ", "elliptic", "0 steps",
                 "warning: fatigue.length has no effect here"):
        assert said in done.output, done.output


@pytest.mark.parametrize("ratio", [0.3, 1.0, 2.0, 5.0])
def test_light_loads_of_constant_oil_have_the_film_of_rigid_bodies(ratio):
    """128 r (1 + 2/(3 r))^-2 (0.131 atan(r/2) + 1.683)^2 (U/W)^2 R_x, r = R_y/R_x (Brewe, Hamrock & Taylor 1979): the smallest
    film, which is somewhat less than the central one, alike for all ellipses."""
    shape = ratio * (1 + 2 / (3 * ratio)) ** -2 * (0.131 * math.atan(ratio / 2) + 1.683) ** 2
    M = 0.01  # (U/W)^2 over the unit of length sqrt(2 U) is M^-2/4
    assert nijenbanning(M, 1e-9, 1 / ratio) / (128 / 4 * shape / M**2) == pytest.approx(1.18, abs=0.06)


def test_slip_of_either_sign_heats_the_inlet():
    """Its part grows by 2.23 S^0.83."""
    scenes = [tehl.scene("gear").replace(srr=srr) for srr in (0.0, 0.5, -0.5, 1.0)]
    rolling, *both, fast = (1 / film_formula.inlet_heating(scene) - 1 for scene in scenes)
    assert both[0] == pytest.approx(both[1]) and rolling > 0.01
    assert (both[0] / rolling, fast / rolling) == pytest.approx((1 + 2.23 * 0.5**0.83, 3.23))
