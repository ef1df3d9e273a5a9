"""An oil by its data sheet: what it becomes, what is refused, what is told of it."""

import json
import math
import tomllib

import pytest
from small_stores import SMALL, store
from tehl_cli.main import app
from typer.testing import CliRunner

from tehl_taichi.laws.density import LAWS
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.report import scene_text
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.scene import Scene, SceneError, data_sheet, mineral_alpha, scene, scene_file
from tehl_taichi.scene.named_oils import NAMED, from_values
from tehl_taichi.scene.oil import Oil

SHEET = {"nu_40": 220e-6, "nu_100": 19e-6, "rho_15": 890.0}
GEAR, SET = scene("gear"), {f"oil.{key}": value for key, value in SHEET.items()}
# Stachowiak & Batchelor, table 2.3: viscosity (mPa s) and pressure coefficient (1/GPa) at 30, 60, 100 deg C of all its
# mineral oils; the lightest has no coefficient at 30
TABLE = (((38, 12.1, 5.3), (None, 18.4, 13.4)), ((153, 34, 9.1), (23.7, 20.5, 15.8)), ((250, 50.5, 12.6), (25.0, 21.3, 17.6)),
         ((810, 135, 26.8), (34, 28, 22)), ((18.6, 6.3, 2.4), (20, 16, 13)), ((45, 12, 3.9), (28, 20, 16)),
         ((107, 23.3, 6.4), (29.6, 22.8, 17.8)), ((122, 26.3, 7.3), (27.0, 21.6, 17.5)), ((171, 31, 7.5), (28, 23, 18)),
         ((30.7, 8.6, 3.1), (25.7, 20.3, 15.4)), ((165, 30.0, 6.8), (33.0, 23.8, 16.0)), ((310, 44.2, 9.4), (34.6, 26.3, 19.5)),
         ((2000, 180, 24), (41.5, 29.4, 25.0)))


def nu(oil, Gamma):
    """m2/s at p = 0."""
    return math.exp(ln_eta(oil, 0.0, Gamma)) / (oil.rho0 * LAWS[oil.density].expansion(oil, 0.0, Gamma))


def alpha(oil, Gamma):
    """1/Pa at p = 0, by a difference of second order."""
    at = [ln_eta(oil, n * 1e5, Gamma) for n in range(3)]
    return (4 * at[1] - 3 * at[0] - at[2]) / 2e5


@pytest.mark.parametrize("more", [{}, {"rho_15": 0.0}, {"rho_15": 0.0, "rho0": 870.0}, {"beta0": 9e-4}, {"density": "tait"},
                                  {"nu_40": 46e-6, "nu_100": 6.8e-6}, {"expansion": "never"}])
def test_the_viscosities_of_the_sheet_come_out(more):
    oil = from_values({**SHEET, **more})
    assert nu(oil, 40.0) == pytest.approx(oil.nu_40, rel=1e-9) and nu(oil, 100.0) == pytest.approx(oil.nu_100, rel=1e-9)
    assert oil.rho0 == more.get("rho0", 853.0) if not oil.rho_15 else (
        oil.rho0 * LAWS[oil.density].expansion(oil, 0.0, 15.0) == pytest.approx(890.0, rel=1e-12))


def test_its_alpha_comes_out_at_40_degrees():
    oil = from_values({**SHEET, "alpha_40": 22.5e-9})
    assert alpha(oil, 40.0) == pytest.approx(22.5e-9, rel=1e-5) and oil.Cz == 0.0
    assert alpha(from_values(SHEET), 40.0) == pytest.approx(27.0e-9, rel=2e-3)


def test_the_slope_of_astm_d341():
    """By hand: log10 log10 220.7 = 0.36996, log10 log10 19.7 = 0.11209, log10(373.15/313.15) = 0.07613."""
    assert mineral_alpha.slope(220e-6, 19e-6) == pytest.approx((0.36996 - 0.11209) / 0.07613, rel=1e-3)


def by_walther(eta):
    """An oil of 880 kg/m3 with the viscosities of the table at 30 and 100 deg C."""
    oil = Oil(rho0=880.0)
    cold, hot = (eta[n] / LAWS[oil.density].expansion(oil, 0.0, Gamma) / 0.88 for n, Gamma in ((0, 30.0), (2, 100.0)))
    double = [math.log10(math.log10(nu + 0.7)) for nu in (cold, hot)]
    slope = (double[0] - double[1]) / math.log10(373.15 / 303.15)
    nu_40 = 10 ** 10 ** (double[0] - slope * math.log10(313.15 / 303.15)) - 0.7
    return from_values({"nu_40": nu_40 * 1e-6, "nu_100": hot * 1e-6, "rho0": 880.0})


def test_the_estimate_of_alpha_holds_for_the_mineral_oils_of_the_table():
    """Within what is said of it, and that is not said too modestly."""
    errors = [alpha(by_walther(eta), Gamma) * 1e9 / known - 1 for eta, alphas in TABLE
              for Gamma, known in zip((30.0, 60.0, 100.0), alphas) if known]
    assert len(errors) == 38 and 0.13 < max(map(abs, errors)) < mineral_alpha.WITHIN
    assert math.hypot(*errors) / len(errors) ** 0.5 == pytest.approx(0.074, abs=0.003)
    assert abs(sum(errors)) / len(errors) < 0.01


def test_the_law_is_near_the_viscosities_of_the_table_between():
    """Of the thinnest, the first, less so."""
    errors = [math.exp(ln_eta(by_walther(eta), 0.0, 60.0)) * 1e3 / eta[1] - 1 for eta, _ in TABLE]
    assert max(map(abs, errors[1:])) < 0.055 and 0.1 < errors[0] < 0.13


def test_the_reference_pao_has_a_quarter_less_than_the_estimate():
    pao = NAMED["reference-pao"].oil
    guess = from_values({"nu_40": nu(pao, 40.0), "nu_100": nu(pao, 100.0)})
    assert 0.7 < alpha(pao, 40.0) / alpha(guess, 40.0) < 0.77


@pytest.mark.parametrize("given, words", [
    ({"nu_40": 220}, ("oil.nu_40 = 220 m2/s", "at least 1e-06 m2/s and at most 0.1", "did you mean 220e-6 m2/s (220 mm2/s)?")),
    ({"rho_15": 0.89}, ("oil.rho_15 = 0.89 kg/m3", "0.89e3")),
    ({"alpha_40": 22}, ("oil.alpha_40 = 22 1/Pa", "22e-9 1/Pa (22 1/GPa)")),
    ({"nu_100": 0.0}, ("oil.nu_40 = 0.00022 m2/s", "needs both", "missing: oil.nu_100")),
    ({"nu_40": 0.0, "nu_100": 0.0}, ("oil.rho_15 = 890 kg/m3", "missing: oil.nu_40 and oil.nu_100")),
    ({"nu_100": 220e-6}, ("oil.nu_100 = 0.00022 m2/s", "less than nu_40 = 0.00022 m2/s")),
    ({"nu_40": -220e-6}, ("oil.nu_40 = -0.00022 m2/s", "out of range")),
    ({"nu_40": "220"}, ("oil.nu_40 = '220'", "not a number")),
    ({"nu_100": math.inf}, ("oil.nu_100 = inf", "finite")), ({"nu_40": 10**400}, ("oil.nu_40",)),
    ({"G0": 4.57}, ("oil.G0 = 4.57", "gives G0 = 4.83", "omit G0")), ({"Cz": -0.071}, ("oil.Cz = -0.071", "omit Cz")),
    ({"rho0": 853.0}, ("oil.rho0 = 853", "oil.rho_15", "875.123")), ({"S0": "steep"}, ("oil.S0 = 'steep'", "not a number")),
    ({"viscosity": "barus"}, ("oil.viscosity = 'barus'", "does not accept a data sheet", "roelands-temperature")),
    ({"name": "mineral-vg150"}, ("oil.name = 'mineral-vg150'", "has its own viscosity")),
    ({"name": ""}, ("oil.name", "text")), ({"nu_100": 60e-6}, ("oil.alpha_40 is missing", "nu_40 = 0.00022 m2/s", "3 to 4.5")),
])
def test_what_no_sheet_can_say_is_refused(given, words):
    with pytest.raises(SceneError) as error:
        from_values({**SHEET, **given})
    assert all(word in str(error.value) for word in words), error.value


@pytest.mark.parametrize("changes, words", [
    ({"oil.nu_40": 220e-6}, "missing: oil.nu_100"), ({**SET, "oil.G0": 4.57}, "contradict each other"),
    ({**SET, "oil.rho0": 853.0}, "oil.rho_15 = 890.0 and oil.rho0"),
    ({**SET, "oil.viscosity": "houpert"}, "does not accept a data sheet"),
    ({**SET, "oil.name": "mineral-vg68"}, "has its own"), ({**SET, "oil.eta0": 0.1}, "no effect"),
])
def test_the_same_of_changes(changes, words):
    with pytest.raises(SceneError, match=words):
        GEAR.replace(**changes)


@pytest.mark.parametrize("changes, words", [({"oil.G0": 4.57}, "gives G0"), ({"oil.rho0": 853.0}, "gives rho0"),
                                            ({"oil.viscosity": "barus"}, "accept"), ({"oil.nu_40": 0.0}, "missing: oil.nu_40")])
def test_a_sheet_stays_until_it_is_taken_back(changes, words):
    with pytest.raises(SceneError, match=words):
        GEAR.replace(**SET).replace(**changes)


def test_a_sheet_makes_another_oil_and_a_name_ends_it():
    oil = GEAR.replace(**SET).oil
    assert (oil.name, oil.rho_15, oil.viscosity) == ("data-sheet", 890.0, "roelands-temperature")
    assert scene("ball-on-disc").replace(**{**SET, "oil.name": "mine"}).oil.viscosity == "roelands-temperature"
    barus = {"oil.name": "thin", "oil.viscosity": "barus", "oil.eta0": 0.1, "oil.alpha": 2e-8}
    thin, back = (GEAR.replace(**SET).replace(**new).oil for new in (barus, {"oil.name": "reference-pao"}))
    assert (thin.name, thin.nu_40, thin.source) == ("thin", 0.0, "not given") and back == GEAR.oil


def test_what_follows_is_found_anew_with_every_change():
    first = GEAR.replace(**SET)
    oil = first.replace(**{"oil.nu_40": 320e-6, "oil.nu_100": 24e-6}).oil
    assert oil == GEAR.replace(**{**SET, "oil.nu_40": 320e-6, "oil.nu_100": 24e-6}).oil and "320 mm2/s" in oil.source
    spread = first.replace(**{"oil.beta0": 8e-4}).oil
    assert nu(spread, 100.0) == pytest.approx(19e-6, rel=1e-9) and spread.G0 != first.oil.G0
    assert first.replace(**{"oil.source": "ours"}).replace(**{"oil.nu_40": 230e-6}).oil.source == "ours"
    assert GEAR.replace(**{"oil.name": "mineral-vg220"}).replace(**{"oil.nu_100": 20e-6}).oil.source.startswith("data sheet: ")


def test_where_the_numbers_come_from_is_told():
    told = ("220 mm2/s at 40 deg C", "19 mm2/s at 100 deg C", "890 kg/m3 at 15 deg C",
            "alpha 27 1/GPa at 40 deg C estimated as for a mineral oil, within 15 %")
    made = GEAR.replace(**SET)
    assert all(word in made.oil.source for word in told) and any(told[0] in line for line in scene_text.words(made))
    assert "estimated" not in GEAR.replace(**SET, **{"oil.alpha_40": 22e-9}).oil.source
    assert "853 kg/m3 at 40 deg C, not from there" in from_values({"nu_40": 220e-6, "nu_100": 19e-6}).source


def test_an_estimate_is_warned_of_and_a_number_is_not():
    said, = [line for line in GEAR.replace(**SET).warnings() if "alpha" in line]
    assert "oil.alpha_40 is not given" in said and "27 1/GPa" in said and "15 %" in said
    assert not [line for line in GEAR.replace(**SET, **{"oil.alpha_40": 22e-9}).warnings() if "alpha" in line]
    heat, = [line for line in GEAR.replace(**SET).warnings() if line.startswith("oil.name")]
    assert "density's rise with pressure, conductivity and heat capacity are those of reference-pao" in heat


def test_files_give_the_same_oil(tmp_path):
    (tmp_path / "mine.toml").write_text('base = "gear"\n[oil]\nnu_40 = 220e-6\nnu_100 = 19e-6\nrho_15 = 890\n')
    found = scene_file.load(tmp_path / "mine.toml")
    assert found.oil == GEAR.replace(**SET).oil
    assert scene_file.from_data(tomllib.loads(scene_file.dumps(found)), "mine") == found == Scene.from_dict(found.to_dict())
    text = scene_file.dumps(found).replace("nu_40 = 0.00022", "nu_40 = 0.0003")
    with pytest.raises(SceneError, match="omit S0, G0, Dz|omit G0, S0, Dz"):
        scene_file.from_data(tomllib.loads(text), "mine")


def test_a_store_keeps_the_sheet_and_commands_tell_it(tmp_path):
    from tehl_taichi.store.store import Store

    description = SMALL.replace(**SET)
    store(tmp_path / "s.zarr", 3, description, warnings=json.dumps(description.warnings()))
    assert Store(tmp_path / "s.zarr").scene == description
    shown = CliRunner().invoke(app, ["show", str(tmp_path / "s.zarr")]).stdout
    assert "oil.alpha_40 is not given" in shown


def test_a_study_over_a_viscosity_of_the_sheet():
    made = plan(GEAR.replace(**SET), {"oil.nu_40": [150e-6, 220e-6], "oil.alpha_40": [20e-9, 25e-9]})
    made.refused()
    assert [nu(made.case(n).oil, 40.0) for n in (0, 3)] == pytest.approx([150e-6, 220e-6])
    assert alpha(made.case(3).oil, 40.0) == pytest.approx(25e-9, rel=1e-5)
    with pytest.raises(SceneError, match="did you mean 220e-6"):
        plan(GEAR.replace(**SET), {"oil.nu_40": [200e-6, 220.0]}).refused()


@pytest.mark.parametrize("grade, nu_100", [(220, 18.75), (320, 23.96)])
def test_gear_oils_are_those_of_their_grade(grade, nu_100):
    oil = NAMED[f"mineral-vg{grade}"].oil
    assert nu(oil, 40.0) * 1e6 == pytest.approx(grade, rel=1e-9) and nu(oil, 100.0) * 1e6 == pytest.approx(nu_100, rel=1e-9)
    assert "made of ISO 3448" in oil.source and "estimated" in oil.source and data_sheet.is_alpha_estimated(oil)
    with pytest.raises(SceneError, match="gives G0"):
        from_values({"name": oil.name, "G0": 4.57})


def test_the_list_reads_well_on_80_columns():
    lines = CliRunner(env={"COLUMNS": "80"}).invoke(app, ["oils"]).stdout.splitlines()
    assert max(map(len, lines)) <= 80 and lines[0].startswith("named oils") and not lines[1].strip(" ┏━┳┓")
    row, = [line for line in lines if "mineral-vg220" in line and "│" in line]
    assert "gear oil, ISO VG 220, VI 95" in row and "193" in row and "27.1" in row
    assert any(line.startswith("mineral-vg220: mineral, made of ISO 3448") for line in lines)


@pytest.mark.parametrize("changes, what", [
    (SET, "its data sheet has no traction data"), ({**SET, "oil.name": "ours"}, "its data sheet has no traction data"),
    ({"oil.name": "ours", "oil.viscosity": "roelands", "oil.eta0": 0.1, "oil.alpha": 2e-8, "oil.Z": 0.6},
     "its numbers do not include traction")])
def test_the_shear_law_that_an_own_oil_keeps_is_told(changes, what):
    own = GEAR.replace(**changes)
    said, = [line for line in own.warnings() if "shear law" in line]
    assert what in said and "limiting, tau_L0 = 1e+07 Pa, gamma = 0.075" in said and f"oil.name = {own.oil.name}," in said


@pytest.mark.parametrize("changes", [{}, {"oil.name": "mineral-vg220"}, {**SET, "rheology.gamma": 0.06}, {**SET, "srr": 0.0},
                                     {**SET, "rheology.law": "newtonian"}, {**SET, "rheology.law": "eyring"}])
def test_a_shear_law_that_is_chosen_or_does_not_act_is_not(changes):
    assert not [line for line in GEAR.replace(**changes).warnings() if "shear law" in line]


@pytest.mark.parametrize("changes", [{"oil.nu_40": 1e-4, "oil.source": 10**5000}, {"oil.nu_40": 1e-4, "oil.source": ["a"]},
                                     {"fatigue.kappa": 0.2, "fatigue.source": 10**5000}])
def test_a_source_that_is_no_text_is_refused_in_a_sentence(changes):
    """A number of more than 4300 digits has no text at all."""
    with pytest.raises(SceneError, match="source = .* must be text"):
        scene("gear").replace(**changes)
