"""What a run prints, sums up and stores: every number against the stored fields, every unit against what its values must be."""

import contextlib
import io
import json
import os
import re
from types import SimpleNamespace
from unittest import mock

import numpy as np
import pytest
import zarr

A, P_HERTZ, LOAD, INLET = 0.36216e-3, 1.93361e9, 1.1e6, 90.0  # m, Pa, N/m, deg C of the gear, by Hertz
U_A, U_B = 8.5 * 0.94, 8.5 * 1.06  # m/s at SRR -0.12


def tehl(*words):
    """What the command prints on stdout, run in this process."""
    from tehl_cli.main import app

    out = io.StringIO()
    with contextlib.redirect_stdout(out), mock.patch.dict(os.environ, {"COLUMNS": "200"}):
        app([str(word) for word in words], standalone_mode=False)
    return out.getvalue()


def run(folder, *words):
    """A finished run: its JSON summary, its store and its table."""
    from tehl_taichi.engine import runtime
    from tehl_taichi.store.store import Store

    path, now = folder / "run.zarr", runtime.ensure()
    said = tehl("run", *words, "--threads", now["threads"], "--out", path, "--json", "--quiet")
    store, shown = Store.open(path), tehl("show", path)
    rows = dict(re.findall(r"^│ (.+?) +│ +(.+?) │$", shown, re.M)[::-1])  # of two rows the first: that of the surface
    fields = {name: np.stack([store.fields(n, [name])[name] for n in range(len(store))]).astype(float) for name in store.stored}
    return SimpleNamespace(summary=json.loads(said), store=store, rows=rows, shown=shown, fields=fields)


@pytest.fixture(scope="module")
def gear(taichi_cpu, tmp_path_factory):
    """Ten steps of the gear with temperatures, on 64 x 16 cells, the asperity entering."""
    return run(tmp_path_factory.mktemp("units"), "gear", "--grid", "64x16", "--steps", 10, "--set", "time.x_start=-1.4",
               "--set", "fatigue.surfaces=a")


@pytest.fixture(scope="module")
def light(taichi_cpu, tmp_path_factory):
    """A light, nearly rolling contact: within the range of every law."""
    return run(tmp_path_factory.mktemp("light"), "smooth-line", "--grid", "64x16", "--steady", "--thermal", "--srr", "-0.01",
               "--hertz-pressure", "0.5e9")


def arrays(gear):
    """{name: array} of the store."""
    return dict(zarr.open_group(str(gear.store.path), mode="r").arrays())


def per_width(gear, values):
    """int dx of the mean over y of every entry: of cells around the columns, the first of which has a pressure, too."""
    x, y = gear.store.x, gear.store.y
    return (np.trapezoid(values, y, axis=2) / y[-1]).sum(axis=1) * (x[1] - x[0])


def test_hertz(gear):
    assert gear.summary["hertz"] == pytest.approx({"a_m": A, "p_Pa": P_HERTZ}, rel=1e-4)
    assert gear.summary["grid"] == {"nx": 65, "ny": 17, "nz": 9} and gear.summary["steps"] == 10


def test_the_stored_pressure_carries_the_load(gear):
    """int p dx = 1.1e6 N/m with p in Pa and x in m, at every entry, less the 0.02 % that the oil before the grid carries."""
    carried = per_width(gear, gear.fields["pressure"])
    np.testing.assert_allclose(carried, carried[0], rtol=2e-6)
    assert 1e-4 < 1 - carried[0] / LOAD < 3e-4


def test_steady_numbers_are_those_of_the_first_entry(gear):
    s, f, x = gear.summary["steady"], {name: values[0] for name, values in gear.fields.items()}, gear.store.x
    assert s["p_max_Pa"] == pytest.approx(f["pressure"].max(), rel=1e-6) == pytest.approx(P_HERTZ, rel=0.1)
    assert s["h_min_m"] == pytest.approx(f["film"].min(), rel=1e-6)
    assert s["h_c_m"] == pytest.approx(np.interp(0.0, x, f["film"][:, -1]), rel=1e-6) == pytest.approx(0.39e-6, rel=0.03)
    for name, field in (("film_max_C", None), ("surface_a_max_C", "temperature_a"), ("surface_b_max_C", "temperature_b")):
        largest = f[field].max() if field else None
        assert largest is None or s[name] == pytest.approx(largest, rel=1e-6)
    assert s["film_max_C"] >= f["temperature_mid"].max() - 1e-3 and s["film_max_C"] == pytest.approx(142, abs=4)


def test_passage_numbers_are_those_of_the_entries_behind_the_start(gear):
    t, f = gear.summary["transient"], {name: values[1:] for name, values in gear.fields.items()}
    assert t["p_max_Pa"] == pytest.approx(f["pressure"].max(), rel=1e-6)
    assert t["h_min_m"] == pytest.approx(f["film"].min(), rel=1e-6)
    assert t["surface_a_max_C"] == pytest.approx(f["temperature_a"].max(), rel=1e-6)
    assert t["surface_b_max_C"] == pytest.approx(f["temperature_b"].max(), rel=1e-6)
    assert t["film_max_C"] >= f["temperature_mid"].max() - 1e-3 > gear.summary["steady"]["film_max_C"]
    assert t["p_max_Pa"] > gear.summary["steady"]["p_max_Pa"] and t["h_min_m"] < gear.summary["steady"]["h_min_m"]
    carried = per_width(gear, f["contact"] * f["pressure"]) / LOAD
    assert t["contact_load_fraction_max"] == pytest.approx(carried.max(), rel=1e-5)
    for key in ("load_error_max", "mass_error_max", "residual_max"):
        assert 0 < t[key] < 1e-6 and t[key] == gear.store.scalar(key[:-4])[1:].max()
    assert 0 < t["temperature_change_K"] < 0.05


def test_friction_of_every_entry_and_its_mean(gear):
    """int (tau_a - tau_b)/2 over the load; the mean is of the steps, without the steady start."""
    drag = 0.5 * per_width(gear, gear.fields["traction_x_a"] - gear.fields["traction_x_b"]) / LOAD
    np.testing.assert_allclose(gear.store.scalar("friction_coefficient"), drag, rtol=1e-5)
    assert gear.summary["transient"]["friction_coefficient_mean"] == pytest.approx(drag[1:].mean(), rel=2e-6)
    assert gear.summary["steady"]["friction_coefficient"] == pytest.approx(drag[0], rel=1e-5) == pytest.approx(0.0517, rel=0.02)
    assert abs(drag[1:].mean() / drag.mean() - 1) > 2e-5


def test_time_and_place_of_the_feature(gear):
    """It moves with u_a = 7.99 m/s from -1.4 a on; a step takes what the store says."""
    store = gear.store
    assert store.feature_x(0) == pytest.approx(-1.4 * A, rel=1e-4)
    at = np.array([store.feature_x(n) for n in range(len(store))])
    np.testing.assert_allclose(np.diff(at), U_A * np.diff(store.time), rtol=1e-9)
    np.testing.assert_allclose(store.scalar("dt_s")[1:], np.diff(store.time), rtol=1e-9)
    assert gear.summary["transient"]["dt_s"] == pytest.approx(4 * A / 64 / U_A, rel=1e-4)


def test_work_is_added_up(gear):
    store, w = gear.store, gear.summary["work"]
    assert w["pressure_cycles"] == store.scalar("cycles").sum() and w["newton_steps"] == store.scalar("newton").sum()
    assert w["cycles_per_step_max"] == store.scalar("cycles")[1:].max() and w["rejected_steps"] == 0


def test_fatigue_numbers_are_those_of_its_maps(gear):
    f, store = gear.summary["fatigue"], gear.store
    stress, x, y = (store.map(name) for name in ("findley_stress", "feature_frame_x", "feature_frame_y"))
    i, j = np.unravel_index(int(np.argmax(stress)), stress.shape)
    assert f["findley_stress_max_Pa"] == pytest.approx(stress.max()) and (f["x_m"], f["y_m"]) == pytest.approx((x[i], y[j]))
    assert f["Fi_max"] == pytest.approx(stress.max() / 400e6) and store.map("Fi").max() == pytest.approx(f["Fi_max"])
    assert store.map("plane_theta")[i, j] == pytest.approx(f["surface_angle_deg"])


def test_laws_used_beyond_their_range_are_named(gear, light):
    """1.1 GPa and 107 deg C: the gear is beyond both, a light contact within; no temperature had to be held."""
    assert sorted(gear.summary["clamps"].values()) == [107.0, 1.1e9]
    assert light.summary["clamps"] == {} and light.summary["steady"]["p_max_Pa"] < 1.1e9
    assert light.summary["steady"]["film_max_C"] < 100


@pytest.mark.parametrize("p, T, held, expected", [(1.2e9, 90.0, 0, [1.1e9]), (1.0e9, 110.0, 0, [107.0]), (1.0e9, 90.0, 3, [3])])
def test_each_clamp_for_itself(p, T, held, expected):
    from tehl_taichi.runs.summary.summary import _clamps

    scalars = {"p_max_Pa": [0.9e9, p, 0.9e9], "film_max_C": [90.0, T, 90.0], "clamped": [0.0, held, np.nan]}
    store = SimpleNamespace(scene=SimpleNamespace(isothermal=False), scalar=lambda name: np.array(scalars[name]))
    assert list(_clamps(store).values()) == expected


UNITS = {"mm": 1e-3, "um": 1e-6, "GPa": 1e9, "MPa": 1e6, "°C": 1.0, "s": 1.0, "deg": 1.0, "%": 0.01, "": 1.0}


def printed(text, unit):
    """The numbers of a table row in SI, without its error; the row must say this unit."""
    text = text.split(" (")[0].removesuffix(", not resolved").removesuffix(" at most")
    assert unit == "" or text.endswith(unit), text
    numbers = re.findall(r"-?\d+\.?\d*(?:e[-+]\d+)?", re.sub(r"±\s*\S+", "", text))
    return [float(number) * UNITS[unit] for number in numbers]


def heat(gear, cut):
    """Largest temperatures of film, surface a and surface b over some entries."""
    f = gear.fields
    return [np.max(values[cut]) for values in (gear.store.scalar("film_max_C"), f["temperature_a"], f["temperature_b"])]


# row of the table: its unit, and its numbers from the fields of the store or Hertz
ROWS = {
    "Hertz half-width a": ("mm", lambda gear: [A]), "Hertz pressure p_H": ("GPa", lambda gear: [P_HERTZ]),
    "steady h_c": ("um", lambda gear: [np.interp(0.0, gear.store.x, gear.fields["film"][0, :, -1])]),
    "steady h_min": ("um", lambda gear: [gear.fields["film"][0].min()]),
    "steady p_max": ("GPa", lambda gear: [gear.fields["pressure"][0].max()]),
    "steady friction coefficient": ("", lambda gear: [0.0513]),  # on this grid; 0.0515 on fine ones
    "steady film / surface a / surface b, largest": ("°C", lambda gear: heat(gear, slice(0, 1))),
    "passage film / surface a / surface b, largest": ("°C", lambda gear: heat(gear, slice(1, None))),
    "passage p_max": ("GPa", lambda gear: [gear.fields["pressure"][1:].max()]),
    "passage h_min": ("um", lambda gear: [gear.fields["film"][1:].min()]),
    "Fi_max at the surface, whole passage": ("", lambda gear: [gear.store.map("findley_stress").max() / 400e6]),
    "findley stress": ("MPa", lambda gear: [gear.store.map("findley_stress").max()]),
    "at x, y (as feature.x, feature.y)": ("um", lambda gear: [gear.summary["fatigue"][key] for key in ("x_m", "y_m")]),
    "critical plane, angle to the surface": ("deg", lambda gear: [gear.summary["fatigue"]["surface_angle_deg"]]),
    "shear amplitude, largest normal stress":
        ("MPa", lambda gear: [gear.summary["fatigue"][key] for key in ("tau_amp_Pa", "sigma_n_max_Pa")]),
    "load carried by solid contact":
        ("%", lambda gear: [per_width(gear, gear.fields["contact"] * gear.fields["pressure"]).max() / LOAD]),
}


@pytest.mark.parametrize("row", ROWS)
def test_printed_numbers_have_the_unit_that_they_say(gear, row):
    """To the digits printed: four, of um in the feature's frame and deg one behind the point."""
    unit, numbers = ROWS[row]
    assert printed(gear.rows[row], unit) == pytest.approx(numbers(gear), rel=2e-3, abs=0.06 * UNITS[unit] * (unit != ""))


def test_the_history_has_the_units_of_its_columns(gear):
    cells = [[cell.strip() for cell in line.strip("│┃").split("│" if "│" in line else "┃")]
             for line in gear.shown.split("history")[1].splitlines() if line[:1] in "│┃"]
    head, last = cells[0], cells[-1]
    row = dict(zip(head, map(float, last)))
    assert row["step"] == 10 and row["p_max GPa"] == pytest.approx(gear.fields["pressure"][-1].max() / 1e9, abs=1e-4)
    assert row["h_min um"] == pytest.approx(gear.fields["film"][-1].min() * 1e6, abs=1e-4)


# unit: smallest and largest value that the largest number of an array of the gear in this unit may be, unless it is 0
MAGNITUDES = {"Pa": (1e3, 2e10), "m": (1e-8, 3e-3), "s": (1e-7, 1e3), "degC": (85.0, 300.0), "K": (1e-6, 0.1),
              "1": (1e-30, 1e4), "degree": (0.0, 180.0)}


def test_every_stored_array_has_a_unit_that_fits_its_values(gear):
    seen = set()
    for name, array in arrays(gear).items():
        values = np.abs(np.asarray(array[...], float))
        values, units = values[np.isfinite(values) & (values > 0)], array.attrs["units"]
        assert units in MAGNITUDES and array.attrs["long_name"], name
        low, high = MAGNITUDES[units]
        assert values.size == 0 or (low <= values.max() <= high), (name, units, values.max())
        assert units != "degC" or values.min() > 80, name
        seen.add(name)
    assert {"x", "y", "time", "step", "feature_x", *gear.store.stored} <= seen


# name in the store: unit, and about its largest value as it follows from the scene: the film at the inlet is Hertz's gap,
# (X sqrt(X^2 - 1) - arcosh X)/2 a^2/R' at X = -2.5, 25.7 um, and h_c; shear at most 10 MPa + 0.075 p
STORED = {"pressure": ("Pa", P_HERTZ, 0.8), "film": ("m", 26e-6, 0.03), "x": ("m", 2.5 * A, 0.01),
          "y": ("m", A, 0.01), "feature_x": ("m", 1.4 * A, 0.01), "time": ("s", 10 * 4 * A / 64 / U_A, 0.01),
          "dt_s": ("s", 4 * A / 64 / U_A, 0.01), "p_max_Pa": ("Pa", P_HERTZ, 0.8), "h_min_m": ("m", 0.33e-6, 0.2),
          "h_c_m": ("m", 0.39e-6, 0.05), "film_max_C": ("degC", 145.0, 0.1), "surface_a_max_C": ("degC", 126.0, 0.1),
          "temperature_a": ("degC", 126.0, 0.1), "temperature_b": ("degC", 126.0, 0.1), "temperature_mid": ("degC", 143.0, 0.1),
          "traction_x_a": ("Pa", 220e6, 0.5), "traction_x_b": ("Pa", 220e6, 0.5),
          "traction_y_a": ("Pa", 3e6, 0.9), "findley_stress": ("Pa", 3.5e8, 0.7), "sigma1_max": ("Pa", 2e8, 0.9),
          "feature_frame_x": ("m", 0.6 * A, 0.2), "Fi": ("1", 0.9, 0.7), "plane_theta": ("degree", 90.0, 0.8),
          "friction_coefficient": ("1", 0.0517, 0.03), "step": ("1", 10.0, 1e-9)}


@pytest.mark.parametrize("name", STORED)
def test_stored_values_are_in_their_unit(gear, name):
    units, value, within = STORED[name]
    array = arrays(gear)[name]
    assert array.attrs["units"] == units
    values = array[:11] if array.metadata.dimension_names[0] == "time" else array[:]  # room for as many entries as steps
    assert np.nanmax(np.abs(np.asarray(values, float))) == pytest.approx(value, rel=within)
