"""Figures of pages have the values of the store and of the search, in the unit of their axis, where they belong."""

from types import SimpleNamespace

import made_results
import numpy as np
import pytest
from made_figures import Made, made

import tehl_taichi as tehl
from tehl_taichi.report import bearing_page, chain_plot, fatigue_plots, flank_page, map_plots, passage_plots, run_tables
from tehl_taichi.report.searches import searches
from tehl_taichi.runs.bearing.stored_bearing import Bearing
from tehl_taichi.scene.scales import Scales

pytest.importorskip("plotly")


@pytest.fixture(scope="module")
def store(thermal):
    return tehl.open(thermal).store


@pytest.fixture(scope="module")
def search(store):
    return searches(store)[0]


def named(traces, begin):
    return next(trace for trace in traces if trace.get("name", "").startswith(begin))


def test_histories_are_over_the_position_in_half_widths(store):
    found, a = passage_plots.histories(store), Scales.of(store.scene).a
    for trace in found.traces:
        np.testing.assert_allclose(np.array(trace["x"]) * a, store.scalar("feature_x")[1:])
    for trace, name, factor in zip(found.traces, ("p_max_Pa", "h_min_m"), (1e9, 1e-6)):
        np.testing.assert_allclose(np.array(trace["y"]) * factor, store.scalar(name)[1:])


def test_stresses_of_the_critical_point_are_over_the_position_in_half_widths(search):
    from tehl_taichi.fatigue.findley import shear_path

    history, a = search.result.worst, Scales.of(search.scene).a
    trace = named(fatigue_plots.worst_points(search)[0][0].traces, "normal to")
    np.testing.assert_allclose(np.array(trace["x"]) * a, history["x_a"][:-1])
    np.testing.assert_allclose(np.array(trace["y"]) * 1e6, shear_path(history["stress"], history["normal"])[2][:-1])


def test_the_critical_point_is_marked_in_the_section_at_its_place(search):
    section, over = fatigue_plots.depth(search)
    deep = search.result.numbers["below"]
    mark = named(section.traces, "critical point")
    assert (mark["x"][0], mark["y"][0]) == pytest.approx((deep["x_m"] * 1e6, deep["depth_m"] * 1e6)) and deep["x_m"] < 2e-5
    assert named(over.traces, "below")["y"][0] == pytest.approx(deep["depth_m"] * 1e6)


def test_stresses_under_the_feature_and_of_the_smooth_contact_have_one_unit(store, search):
    chain, = chain_plot.figures(store, search)
    result, stresses = search.result, [trace for trace in chain.traces if trace["xaxis"] == "x2"]
    for trace, values in zip(stresses, (result.findley_stress_under_row.max(axis=1), result.findley_stress_contact_alone)):
        np.testing.assert_allclose(np.array(trace["x"]) * 1e6, values)
        np.testing.assert_allclose(np.array(trace["y"]) * 1e-6, result.row_depths)


def test_shares_of_a_rough_surface_are_per_cent(search, monkeypatch):
    curves = [("surface a", np.array([0.5, 1.0]), np.array([0.6, 0.2]))]
    monkeypatch.setattr(fatigue_plots.distribution_figure, "curves", lambda result: curves)
    result = SimpleNamespace(numbers={"rough": True})
    figure, = fatigue_plots.distribution(SimpleNamespace(result=result, on=""))
    assert list(figure.traces[0]["y"]) == pytest.approx([60.0, 20.0]) and "%" in figure.layout["yaxis"]["title"]["text"]


@pytest.mark.parametrize("built_in", ["ball-on-disc", "ball-bearing"])
def test_a_map_has_its_field_at_its_places(built_in):
    """Also of a wide ellipse, whose long axis is to the right; the film of places upstream is another one than downstream."""
    store = Made(made(built_in).scene)
    grown = store.fields
    store.fields = lambda n, names: {name: values * (1 + 0.1 * store.x[:, None] / store.a)
                                     for name, values in grown(n, names).items()}
    lying = built_in == "ball-bearing"
    for figure, factor in zip(map_plots.maps(store), (1e9, 1e-6)):
        heat = figure.traces[0]
        z, field = np.array(heat["z"]).T, store.fields(0, [figure.name[4:]])[figure.name[4:]]
        for i, j in ((0, 0), (3, -2), (-1, 5)):
            x, y = np.array(heat["x"])[i] * store.a, np.array(heat["y"])[j] * store.a
            x, y = (y, x) if lying else (x, y)
            at = np.argmin(np.abs(store.x - x)), np.argmin(np.abs(store.y - abs(y)))
            assert z[i, j] * factor == pytest.approx(field[at]), figure.name


def test_a_page_of_a_flank_has_the_films_and_points_of_its_positions(tmp_path):
    found = tehl.open(made_results.flank(tmp_path))
    film = flank_page.figures(found)[0]
    centre = named(film.traces, "steady, centre")
    values = [(at.x_pl, summary["steady"]["h_c_m"]) for at, _, summary in found.rows if summary]
    assert list(zip(centre["x"], centre["y"])) == [pytest.approx((x * 1e3, h * 1e6)) for x, h in values]
    letters = {one["text"]: one["x"] for one in film.layout["annotations"]}
    assert letters == pytest.approx({name: x * 1e3 for name, x in found.points.items()})


def test_a_page_of_a_bearing_names_the_ring_with_the_thinner_film(tmp_path):
    found = tehl.bearing("6206", load=3000.0, run=False, folder=tmp_path / "b")
    films = {"inner": 4e-7, "outer": 3e-7}
    rings = {ring: {**one, "summary": {"steady": {"h_c_m": films[ring]}}} for ring, one in found.rings.items()}
    assert "0.3 µm at the outer ring" in bearing_page.answer(Bearing(found.folder, {**found.record, **rings})).headline


def test_a_page_of_a_bearing_has_its_loads_by_azimuth_and_its_slip_across(tmp_path):
    found = tehl.bearing("6206", load=3000.0, run=False, folder=tmp_path / "b")
    loads, contacts = bearing_page.figures(found)
    bars, record = dict(zip(loads.traces[0]["x"], loads.traces[0]["y"])), found.record
    for azimuth, load in zip(record["azimuths_deg"], record["loads_N"]):
        assert next(one for at, one in bars.items() if abs((at - azimuth + 180) % 360 - 180) < 1e-9) == load
    assert "azimuth" in loads.layout["xaxis"]["title"]["text"] and "(N)" in loads.layout["yaxis"]["title"]["text"]
    pressures, slips = ([trace for trace in contacts.traces if trace.get("yaxis", "y") == axis] for axis in ("y", "y2"))
    for pressure, slip, ring in zip(pressures, slips, found.rings.values(), strict=True):
        assert max(pressure["y"]) * 1e9 == pytest.approx(ring["p_Hertz_Pa"])
        assert list(slip["y"]) == ring["slip"]["slip_m_s"] and slip["x"][-1] * 1e-3 == pytest.approx(ring["b_m"])


def rows_of(block):
    """{label: texts} of a table or of facts."""
    return {label: texts for label, *texts in block.data["rows"]}


def test_the_table_of_critical_points_has_the_numbers_of_its_labels(search):
    deep = {**made_results.fatigue()["below"], "x_m": -7e-6, "y_m": 21e-6, "tau_amp_Pa": 4.4e8, "sigma_n_max_Pa": 3.1e7}
    rows = rows_of(run_tables.worst_points({**made_results.fatigue(), "x_m": 8e-6, "y_m": 3e-6, "below": deep}, search.scene))
    assert (rows["x of the feature"], rows["y of the feature"]) == (["8 µm", "-7 µm"], ["3 µm", "21 µm"])
    assert (rows["shear amplitude"], rows["largest normal stress"]) == (["400 MPa", "440 MPa"], ["20 MPa", "31 MPa"])
    assert rows["depth"][1] == "25 µm" and rows["largest principal stress"] == ["60 MPa"] * 2


def test_numerics_have_the_numbers_of_their_labels(store):
    """Steps in microseconds, errors of their own."""
    scalars = {"dt_s": [0.0, 2.5e-6, 1.5e-6], "residual": [1e-7, 2e-7], "load_error": [3e-4, 1e-4], "mass_error": [4e-5, 5e-5]}
    work = {"newton_steps": 31, "pressure_cycles": 470, "cycles_per_step_max": 22, "rejected_steps": 1}
    made_up = SimpleNamespace(summary={"work": work, "wall_s": 3.0, "compile_s": 1.0}, scene=store.scene, x=store.x, y=store.y,
                              steps=3, last_step=2, scalar=lambda name: np.array(scalars[name]))
    rows = {label: text for label, (text,) in rows_of(run_tables.numerics(made_up)).items()}
    assert rows["time step"] == "2.5 µs" and [rows[f"largest error of {name}"] for name in ("residual", "load", "mass")] == [
        "2.0e-07", "3.0e-04", "5.0e-05"]
    assert (rows["Newton steps"], rows["Krylov iterations"], rows["most in a step"]) == ("31", "470", "22")
