"""Numbers meant in another unit than the one they are read in: wherever one comes in, somebody says so."""

import dataclasses

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.crack.crack_options import CrackOptions
from tehl_taichi.crack.residual_stress import ResidualStress, read
from tehl_taichi.errors import SceneError
from tehl_taichi.runs.bearing.rolling_bearing import RollingBearing
from tehl_taichi.runs.flank import load_table
from tehl_taichi.runs.flank.mesh import Mesh
from tehl_taichi.runs.flank.positions import positions_along
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.gear_pair import GearPair
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.sections import SECTIONS, Body
from tehl_taichi.values.quantity import Number, Numbers, kinds
from tehl_taichi.values.unit_hints import WRITTEN
from tehl_taichi.values.units import UNITS

DECLARED = {**SECTIONS, "oil": Oil, "feature": Feature, "bodies": Body, "gear": GearPair, "bearing": RollingBearing,
            "crack": CrackOptions}
TYPED = [(f"{section}.{key}", kind, power, name) for section, cls in DECLARED.items() for key, kind in kinds(cls).items()
         if isinstance(kind, Number) and kind.usual for power, name in WRITTEN.get(kind.unit, ())[:2]]
# of which another unit cannot be told: any value between is one that somebody has
EITHER = {"oil.eta_g", "gear.torque", "bearing.load"}


def test_every_unit_with_another_way_to_write_it_is_tried():
    assert len(TYPED) > 80 and {"Pa", "m", "1/Pa", "Pa sqrt(m)", "m2/s"} <= {kind.unit for _, kind, _, _ in TYPED}


def test_names_of_powers_are_units_of_that_size():
    """By the tables of units that texts may have."""
    tables = [{**sizes, unit: 1.0} for unit, sizes in UNITS.items()]
    for unit, ways in WRITTEN.items():
        for power, name in ways:
            sizes = [table[name] / table[unit] for table in tables if {unit, name} <= table.keys()]
            assert sizes and sizes == pytest.approx([10.0**power] * len(sizes)), (unit, name)


@pytest.mark.parametrize("key, kind, power, name", TYPED, ids=lambda value: value if isinstance(value, str) else "")
def test_a_usual_value_in_another_unit_is_refused_or_doubted(key, kind, power, name):
    typed = kind.usual / 10.0**power
    value = [typed] if isinstance(kind, Numbers) else typed
    try:
        kind.check(key, value)
        said = kind.doubted(key, typed)
    except SceneError as error:
        said = str(error)
    assert said or key in EITHER or (key, name) == ("contact.radius_y", "mm")
    assert not said or "did you mean" in said and float(said.split("did you mean ")[1].split()[0]) == pytest.approx(
        kind.usual, rel=1e-4)


@pytest.mark.parametrize("key", sorted({key for key, _, _, _ in TYPED}))
def test_a_usual_value_in_its_unit_passes(key):
    kind = next(kind for name, kind, _, _ in TYPED if name == key)
    kind.check(key, [kind.usual] if isinstance(kind, Numbers) else kind.usual)
    assert not kind.doubted(key, kind.usual)


@pytest.mark.parametrize("value, passes", [(0.0, True), (-2e8, True), (2e8, True), (-1e5, True), (-99e3, False),
                                           (-200.0, False), (200.0, False), (-0.2, False), (-2e10, False)])
def test_a_residual_stress_of_either_sign(value, passes):
    for change in ({"fatigue.residual_xx": value}, {"fatigue.residual_yy": value}):
        if passes:
            tehl.scene("gear").replace(**change)
        else:
            with pytest.raises(SceneError, match=r"allowed: 0, or at least 100000 Pa and at most 1e\+10 Pa, positive or"):
                tehl.scene("gear").replace(**change)


@pytest.mark.parametrize("scale, said", [(1.0, ""), (1e-6, "did you mean 100e6 Pa"), (1e-9, "did you mean 0.1e9 Pa")])
def test_given_stresses(scale, said):
    stresses = np.zeros((3, 6))
    stresses[:, 0] = 100e6 * scale, -100e6 * scale, 0.0
    if not said:
        assert tehl.fatigue(stresses).f[0] > 6e7 and tehl.fatigue(0 * stresses).f[0] == 0
    else:
        with pytest.raises(SceneError, match=said):
            tehl.fatigue(stresses)


@pytest.mark.parametrize("changes, said", [
    ({"threshold": 3.0}, "did you mean 3e6 Pa sqrt"), ({"length": 100.0}, "did you mean 100e-6 m"),
    ({"distance": 3}, "did you mean 3e-6 m"), ({"start": -40.0}, "did you mean -40e-6 m"),
    ({"residual": -200.0}, "did you mean -200e6 Pa"), ({"residual": np.float64(-200)}, "did you mean -200e6 Pa"),
    ({"residual": [(0, -200), (1e-4, -100)]}, "did you mean -200e6 Pa"),
    ({"residual": [(0, -2e8), (100, -1e8)]}, "did you mean 100e-6 m"),
    ({"residual": [(0, -2e8), (0.1, -1e8)]}, "did you mean 0.1e-3 m")])
def test_what_is_asked_of_a_crack(changes, said):
    with pytest.raises(SceneError, match=said):
        CrackOptions(**changes)
    CrackOptions(threshold=3e6, residual=[(0, -2e8), (1e-4, 0.0)], start=-4e-5)


@pytest.mark.parametrize("text, rows", [
    ("0, -2e8\n1e-4, 0\n", [[0, -2e8], [1e-4, 0]]), ("depth_m,stress_Pa\n0,-2e8\n1e-4,0\n", [[0, -2e8], [1e-4, 0]]),
    ("# measured\n0;-2e8\n1e-4;0\n", [[0, -2e8], [1e-4, 0]]), ("0 -2e8\n1e-4 0\n", [[0, -2e8], [1e-4, 0]]),
    (",depth (m),residual stress (Pa)\n0,0,-2e8\n1,1e-4,0\n", [[0, -2e8], [1e-4, 0]]),
    ("sigma_Pa,depth_m\n-2e8,0\n0,1e-4\n", [[0, -2e8], [1e-4, 0]]),
    ("depth_um,stress_MPa\n0,-200\n50,0\n", [[0, -2e8], [5e-5, 0]])])
def test_a_table_of_residual_stress(tmp_path, text, rows):
    (tmp_path / "t.csv").write_text(text)
    np.testing.assert_allclose(read(str(tmp_path / "t.csv")), rows, rtol=1e-12)


@pytest.mark.parametrize("text, said", [
    ("0,0,-2e8\n1,1e-4,0\n", "line 1 has 3 columns"), ("x,y\n0,-2e8\n", "names no depth and stress"), ("", "it is empty"),
    ("depth_mils,stress_MPa\n0,-200\n50,0\n", "'depth_mils' is in mils, which is not one of m, cm, mm"),
    ("0,-2e8\n1e-4\n", "line 2 has 1 column; allowed: 2")])
def test_a_table_of_residual_stress_that_is_refused(tmp_path, text, said):
    (tmp_path / "t.csv").write_text(text)
    with pytest.raises(SceneError, match=said):
        read(str(tmp_path / "t.csv"))


def test_a_residual_stress_is_linear_between_its_rows():
    assert ResidualStress([(0, -2e8), (1e-4, 0.0)])(np.array([0.0, 5e-5, 1e-3])).tolist() == [-2e8, -1e8, 0.0]


HEAD = "x_pl_mm,load_N_per_mm,R_a_mm,R_b_mm,u_a_m_s,u_b_m_s\n"


@pytest.mark.parametrize("row, said", [
    ("1,300,10e-3,20e-3,3,2", "did you mean 0.01e3 mm"), ("1,300000,10,20,3,2", "did you mean 300000e-3 N/mm"),
    ("1,300,10,20,3000,2000", "did you mean 3000e-3 m/s"), ("0.004,300,10,20,3,2", "did you mean 0.004e3 mm"),
    ("0,300,10,20,3,2\n-0.004,300,10,20,3,2", "did you mean -0.004e3 mm")])
def test_tables_of_a_flank(tmp_path, row, said):
    (tmp_path / "t.csv").write_text(HEAD + row + "\n")
    with pytest.raises(SceneError, match=said):
        load_table.load(tmp_path / "t.csv")


def test_shares_of_the_load_by_ways_in_millimetres():
    from tehl_taichi.scene.gear_pair import gear_pair

    pair = gear_pair("fzg-c")
    ends = [1.01 * end for end in Mesh(pair).ends]
    positions_along(Mesh(dataclasses.replace(pair, load_share=tuple((x, 1.0) for x in ends))))
    with pytest.raises(SceneError, match="did you mean -.*e-3 m"):
        positions_along(Mesh(dataclasses.replace(pair, load_share=tuple((1e3 * x, 1.0) for x in ends))))


def test_a_temperature_in_kelvin():
    with pytest.raises(SceneError, match=r"did you mean 60 deg C \(333.15 K\)"):
        tehl.scene("gear").replace(temperature=333.15)


def test_a_radius_across_in_millimetres():
    with pytest.raises(SceneError, match="did you mean 20e-3 m"):
        tehl.scene("gear").replace(**{"contact.kind": "elliptic", "contact.radius_y": 20.0, "contact.hertz_pressure": 1e9})


def test_a_load_in_newton_per_millimetre_is_doubted():
    smooth = tehl.scene("smooth-line")
    assert any("did you mean 2000e3 N/m (2000 N/mm)?" in said for said in smooth.replace(load=2000.0).warnings())
    assert not any("did you mean" in said for said in smooth.replace(load=2e6).warnings())


def test_options_and_files_say_it_too(tmp_path):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    (tmp_path / "a.toml").write_text('base = "gear"\n[fatigue]\nresidual_xx = -200\n')
    for args in (["run", str(tmp_path / "a.toml")], ["run", "gear", "--set", "fatigue.residual_xx=-200"],
                 ["sweep", "gear", "--over", "fatigue.residual_xx=-100,-200", "--dry-run"]):
        done = CliRunner().invoke(app, args)
        assert done.exit_code != 0 and "did you mean -" in str(done.exception or done.output)
