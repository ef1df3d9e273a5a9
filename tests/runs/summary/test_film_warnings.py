"""What the judge of results says about friction, peaks and ripples, on made-up stores."""

from types import SimpleNamespace

import numpy as np
import pytest

from tehl_taichi.runs import zoom_need
from tehl_taichi.runs.summary import film_warnings
from tehl_taichi.runs.summary import result_warnings as judge_of_results
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.surface.shapes.map import EXAMPLE
from tehl_taichi.values.coded_text import Reason, without_options


class Made:
    warnings = ()

    """A store of two entries on 97 x 9 nodes."""

    def __init__(self, description, friction=(0.05, 0.06), contact=(0.0, 0.0), pressure=None):
        self.scene, a = description, Scales.of(description).a
        self.x, self.y, self.at = np.linspace(-2.5, 1.5, 97) * a, np.linspace(0, a, 9), np.array([-1.6, 0.3]) * a
        smooth = 1.9e9 * np.sqrt(np.maximum(1 - (self.x / a) ** 2, 0))[:, None] * np.ones(9)
        self.pressure = [smooth, smooth * 1.2 if pressure is None else pressure(self.x / a, smooth)]
        self.series = {"friction_coefficient": np.array(friction), "contact_load_fraction": np.array(contact),
                       "p_max_Pa": np.array([p.max() for p in self.pressure])}

    def __len__(self):
        return 2

    def scalar(self, name):
        return self.series[name]

    def feature_x(self, n):
        return self.at[n]

    def fields(self, n, names):
        assert names == ("pressure",)
        return {"pressure": self.pressure[n]}


def said(store):
    return judge_of_results.warnings(store, rippled(store))


def rippled(store):
    """What a summary has that the check of ripples asks for first."""
    return {"steady": {"ripple_Pa": film_warnings.worst_ripple(store, range(len(store)))[0][0]}}


def gear(**changes):
    return scene("gear").replace(**{"thermal.on": False, **changes})


def test_a_peak_under_a_scan_is_told_with_its_centre():
    scan = gear(**{f"feature.{key}": value for key, value in EXAMPLE.items()})
    text, = film_warnings.unresolved(Made(scan, pressure=lambda X, smooth: smooth + 3e9 * (np.abs(X - X[40]) < 1e-9)[:, None]),
                                     {})
    assert "of the passage (scan centre at 0.30 a)" in text
    rough = Made(scan, pressure=lambda X, smooth: smooth * (1 + 0.05 * (-1) ** np.arange(97))[:, None])
    for part, name in (("steady", "ripple_Pa"), ("transient", "ripple_max_Pa")):
        text, = film_warnings.ripples(rough, {part: {name: film_warnings.worst_ripple(rough, range(len(rough)))[0][0]}})
        assert "(scan centre at 0.30 a, X = " in text


def test_a_plausible_run_has_no_warnings_of_its_film():
    assert [text for check in film_warnings.CHECKS for text in check(Made(gear()), {})] == []


def test_friction_that_no_oil_bears():
    store = Made(gear(**{"rheology.law": "newtonian"}), friction=(1.8, 33.3))
    text, = (text for text in said(store) if "friction" in text)
    assert "steady 1.8" in text and "33.3" in text and "more than 0.2" in text and "newtonian" in text
    text, = (text for text in said(Made(gear(), friction=(0.05, 0.21))) if "friction" in text)
    assert "steady" not in text and "'limiting'" in text
    assert not any("friction" in text for text in said(Made(gear(), friction=(0.05, 0.19))))


def test_what_follows_from_a_friction_that_no_oil_bears_is_named():
    def told(summary, **changes):
        return next(film_warnings.friction(Made(gear(**{"rheology.law": "newtonian"}, **changes), friction=(1.8, 33.3)),
                                           summary))

    index, heat = "the fatigue index is that of the pressure alone", "the temperatures that follow have no meaning"
    assert index not in told({}) and heat not in told({})
    assert told({"fatigue": {}}).endswith(f"; {index}")
    assert told({}, **{"thermal.on": True}).endswith(f"; {heat}")
    assert told({"fatigue": {}}, **{"thermal.on": True}).endswith(f"; {index} and {heat}")
    assert index not in told({"fatigue": {}}, **{"fatigue.shear": False})  # as it was asked for


def test_friction_of_solid_contact_is_not_the_films():
    """A third of the load on touching surfaces with 0.6: their part is 0.2."""
    description = gear(**{"rheology.mu_boundary": 0.6})
    assert not any("friction" in text for text in said(Made(description, friction=(0.05, 0.25), contact=(0.0, 1 / 3))))
    assert any("friction" in text for text in said(Made(description, friction=(0.05, 0.45), contact=(0.0, 1 / 3))))


def front(X, smooth):
    """A plateau with a free edge at X = 0.8."""
    out = smooth.copy()
    out[(X > 0.4) & (X < 0.8), 4] = 4e9
    return out


@pytest.mark.parametrize("changes, advice", [
    ({"rheology.law": "newtonian"}, "1/sqrt(cell); oil without a shear limit has no finite value here; use --thermal or"),
    ({"rheology.law": "newtonian", "thermal.on": True}, "; a finer grid may resolve it: --grid 512x64 (4 times the work)"),
    ({"rheology.law": "newtonian", "srr": 0.0}, "1/sqrt(cell); oil without a shear limit"),
    ({}, "wide; a finer grid may resolve it"),
    ({"srr": 0.0}, "wide; a finer grid may resolve it")])
def test_a_peak_at_a_free_edge(changes, advice):
    def tip(X, smooth):
        out = front(X, smooth)
        out[np.flatnonzero(X < 0.8)[-1], 4] = 5e9
        return out

    text, = film_warnings.unresolved(Made(gear(**changes), pressure=tip), {})
    assert text.startswith("exit not resolved: p_max 5.00 GPa of the passage (feature at 0.30 a), at X = 0.79")
    assert advice in text


def test_a_peak_that_three_grids_know_is_not_warned_of():
    store = Made(gear(), pressure=lambda X, smooth: smooth + 6e9 * (np.abs(X - X[90]) < 1e-9)[:, None])
    assert len(list(film_warnings.unresolved(store, {"transient": {"error": {"p_max_Pa": None}}}))) == 1
    assert not list(film_warnings.unresolved(store, {"transient": {"error": {"p_max_Pa": 1e8}}}))


def test_an_exit_whose_error_is_not_known_tells_which_grid_to_try():
    why = Reason("a pressure peak of 89% of the largest is only a few cells wide", "exit")
    assert film_warnings.finer_grid(gear(), why) == "--grid 512x64 (4 times the work)"
    for left, other in ((gear(**{"rheology.law": "newtonian"}), why), (gear(), "exit not resolved: of an older store"),
                        (gear(feature=[]), why)):
        assert film_warnings.finer_grid(left, other) == ""


@pytest.mark.parametrize("at,told", [(40, True), (90, False)])
def test_a_resolved_part_that_ends_before_the_outlet_says_why(at, told):
    """At the outlet the bars say it. The part ends before the only moment that there is."""
    store = Made(gear(), pressure=lambda X, smooth: smooth + 6e9 * (np.abs(X - X[at]) < 1e-9)[:, None])
    found = list(film_warnings.first_unresolved(store, {"fatigue": {"resolved": {"to_x_a": 0.2}}}))
    assert len(found) == told and not list(film_warnings.first_unresolved(store, {"fatigue": {}}))
    for text in found:
        assert text.startswith("the resolved part of the passage ends before the feature at 0.30 a: its pressure peak of ")
        assert "at X = -0.83, y = 0 um is only a few cells wide; a finer grid may resolve it: --grid " in text


def test_what_is_an_exit():
    from tehl_taichi.march.accuracy import readings

    assert [readings.is_at_exit(x, 0.4e-3) for x in (-0.3e-3, 0.1e-3, 0.3e-3)] == [False, False, True]


def test_an_unresolved_peak_inside_wants_a_finer_grid():
    def needle(X, smooth):
        out = smooth.copy()
        out[30, 4] = 5e9
        return out

    text, = (text for text in said(Made(gear(srr=0.0), pressure=needle)) if "p_max" in text)
    assert text.startswith("p_max") and "at X = -1.25" in text and "finer grid" in text and "sqrt" not in text


def test_a_ripple_of_the_pressure():
    def wavy(size):
        return lambda X, smooth: smooth * 1.2 + size * ((-1.0) ** np.arange(97) * (abs(X) < 0.5))[:, None]

    text, = (text for text in said(Made(gear(), pressure=wavy(30e6))) if "ripples" in text)
    assert "by up to 0.030 GPa (feature at 0.30 a, X = -0." in text and "time.courant" in text
    assert not any("ripples" in text for text in said(Made(gear(), pressure=wavy(8e6))))


@pytest.mark.parametrize("changes, advice", [({"rheology.law": "newtonian"}, "oil without a shear"), ({}, "time.courant")])
def test_a_ripple_at_the_exit_of_oil_without_a_limit(changes, advice):
    """Where the frozen film ends in a free edge it is the singular peak that shakes the nodes beside it."""
    def mound(X, smooth):
        return smooth * 1.2 + 30e6 * ((-1.0) ** np.arange(97) * (abs(X - 0.9) < 0.35))[:, None]

    made = Made(gear(**changes), pressure=mound)
    text, = film_warnings.ripples(made, rippled(made))
    assert text.startswith("exit not resolved: ") is bool(changes) and advice in text
    made = Made(gear(**changes), pressure=lambda X, smooth: mound(X, smooth)[::-1])
    inside, = film_warnings.ripples(made, rippled(made))
    assert inside.startswith("the pressure ripples") and "X = -" in inside and "time.courant" in inside


def test_many_numbers_without_an_error_are_one_short_sentence():
    """The first of them and how many more; the data of the warning has all."""
    reason = Reason("no coarser grid gives it", "coarse")
    keys = [f"n{k}" for k in range(9)]
    store, summary = SimpleNamespace(scene=scene("gear")), {"steady": {"unknown": dict.fromkeys(keys, reason)}}
    line, = judge_of_results.unknown_errors(store, summary)
    assert line.startswith("the error of steady n0, steady n1, steady n2, steady n3 and 5 more numbers is not known")
    assert line.data["numbers"] == [f"steady {key}" for key in keys]
    numbers = "h_c_m", "friction_coefficient", "film_max_C", "contact_area_share_max"
    line, = judge_of_results.unknown_errors(store, {"steady": {"unknown": dict.fromkeys(numbers, reason)}})
    assert line.startswith("the error of steady h_c, steady friction coefficient, steady largest film temperature, "
                           "steady largest area of solid contact is not known")
    assert line.data["numbers"] == [f"steady {key}" for key in numbers]
    assert judge_of_results.few_names(keys[:6]) == "n0, n1, n2, n3, n4, n5"
    line, = judge_of_results.unknown_errors(store, {"contact_alone": {"unknown": {"surface_Fi_max": reason}}})
    assert line.startswith("the error of Fi_max at the surface of the smooth contact is not known")


@pytest.mark.parametrize("code", ["touch", "changes", "place", "peak", "value", "rival", "alone"])
def test_a_reason_that_a_finer_grid_removes_names_it_and_a_window_for_numbers_of_the_passage(code, monkeypatch):
    monkeypatch.setattr(zoom_need, "work", lambda store, factor: 1.3 * factor)
    reason = Reason("made up", code)
    steady, passage, smooth = ({"steady": {"unknown": {"h_c_m": reason}}}, {"transient": {"unknown": {"h_min_m": reason}}},
                               {"contact_alone": {"unknown": {"Fi_max": reason}}})
    grid = "--grid 512x128 (8 times the work)"
    for summary, more in ((steady, ""), (smooth, ""), ({**steady, **passage}, ", or --zoom 4 (6 times the work)")):
        said, = judge_of_results.unknown_errors(SimpleNamespace(scene=gear()), summary)
        assert said.endswith(f" is not known: made up; try a finer grid: {grid}{more}")
        assert "--" not in without_options(said)


@pytest.mark.parametrize("code", ["shallow", "coarse", "other", "unsettled", "beyond", ""])
def test_a_reason_that_no_grid_removes_names_none(code):
    summary = {"transient": {"unknown": {"h_min_m": Reason("made up", code)}}}
    assert [str(one) for one in judge_of_results.unknown_errors(SimpleNamespace(scene=gear()), summary)] == [
        "the error of passage h_min is not known: made up"]
