"""Options of commands take numbers with a unit."""

import json
import re

import pytest
import typer.main
from tehl_cli.main import app
from typer.testing import CliRunner


def typed(command):
    return CliRunner().invoke(app, command, prog_name="tehl")


def refusal(command):
    """The sentence of a command that is refused."""
    done = typed(command)
    assert done.exit_code != 0
    return str(done.exception)


QUANTITY = re.compile(r"(?<![\w-])(m|µm|N|N m|Pa|m/s|1/min|deg C|degrees|half-widths a)(?![\w-])")  # in the help of an option
PLACES = {"at"}  # of figures and tables: numbers in half-widths a, which have no other unit


def test_every_option_of_a_quantity_takes_a_unit():
    """As the page of the keys says; text stays text until the quantity is known."""
    bare = [f"{command} --{option.name}" for command, found in typer.main.get_command(app).commands.items()
            for option in found.params if option.name not in PLACES and option.bare_type() == "float" and not option.metavar
            and QUANTITY.search(option.help or "")]
    assert bare == []


def _kept(taken):
    def command(store: str, **constants):
        taken.update(constants)
    return command


@pytest.mark.parametrize("options", [{"residual_xx": "-0.2GPa", "residual_yy": "-200 N/mm2", "length": "20um"},
                                     {"from_x": "-0.5a", "to_x": "0.5 a"}])
def test_constants_of_a_search_with_units(options):
    from tehl_cli.fatigue_options import with_fatigue_options

    from tehl_taichi.fatigue.overrides import changed
    from tehl_taichi.scene import scene

    taken, one = {}, typer.Typer(add_completion=False)
    one.command()(with_fatigue_options(_kept(taken)))
    bare = {"residual_xx": -2e8, "residual_yy": -2e8, "length": 2e-5, "from_x": -0.5, "to_x": 0.5}
    given = [word for name, text in options.items() for word in (f"--{name.replace('_', '-')}", text)]
    assert CliRunner().invoke(one, ["a.zarr", *given]).exit_code == 0
    assert changed(scene(), taken).fatigue == changed(scene(), {name: bare[name] for name in options}).fatigue


def test_a_point_and_a_residual_stress_with_units(tmp_path, monkeypatch):
    from tehl_cli.export_command import _point

    from tehl_taichi.crack.residual_stress import ResidualStress, read

    assert _point("-37um,0.01 mm") == pytest.approx((-37e-6, 1e-5), rel=1e-12)
    assert ResidualStress(read("-100MPa")).stress == ResidualStress(read("-100e6")).stress == [-1e8]
    monkeypatch.chdir(tmp_path)
    (tmp_path / "3.csv").write_text("0, -5e7\n1e-4, 0\n")  # a file, although it reads like a number with a unit
    assert ResidualStress(read("3.csv")).stress.tolist() == [-5e7, 0.0]


def test_a_run_with_units():
    """Equal to the run with bare numbers in SI units."""
    units = typed("run gear --dry-run --load .9kN/mm --speed 10m/s --temperature 363.15K --height 1um --width 0.2mm".split())
    bare = typed("run gear --dry-run --load 9e5 --speed 10 --temperature 90 --height 1e-6 --width 2e-4".split())
    assert units.exit_code == 0 and units.output == bare.output != typed(["run", "gear", "--dry-run"]).output


def test_a_bearing_with_units(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    common = "bearing mine --balls 9 --no-run --no-figure --quiet --json --ball-diameter".split()
    found = [json.loads(typed([*common, *rest.split()]).stdout) for rest in
             ("9.525mm --pitch-diameter 46mm --load 3kN --speed 50Hz --clearance 5um --temperature 343.15K --roughness 0.1um",
              "9.525e-3 --pitch-diameter 46e-3 --load 3000 --speed 3000 --clearance 5e-6 --temperature 70 --roughness 1e-7")]
    assert found[0]["loads_N"] == found[1]["loads_N"] and found[0]["inner"]["p_Hertz_Pa"] == found[1]["inner"]["p_Hertz_Pa"]
    assert found[0]["inner"]["film_formula_m"] == found[1]["inner"]["film_formula_m"]


def test_a_dent_with_units():
    from tehl_cli.bearing_features import dent_of

    assert dent_of("10um,0.3mm,rim=1.2um") == dent_of("10e-6,0.3e-3,rim=1.2e-6")


def test_ranges_with_units(tmp_path, monkeypatch):
    """Of `--over`, of samples, and of traction curves: the study of SI values, by its name."""
    monkeypatch.chdir(tmp_path)
    over = [typed(["sweep", "mtm", "--dry-run", "--thermal", *rest]).stdout for rest in
            (["--over", "srr=1:50%:3"], ["--over", "srr=0.01:0.5:3"], ["--samples", "4", "--over", "load=0.01:0.05kN"],
             ["--samples", "4", "--over", "load=10:50"])]
    assert over[0] == over[1] != "" and over[2] == over[3] != ""
    curves = "traction mtm --isothermal --grid 64x16 --workers 1 --quiet --no-figure --json --srr".split()
    refused = [refusal([*curves, *rest]) for rest in (["0:300%:3"], ["0:0.5m:3"], ["0.1", "--load", "5N,1kN,2"])]
    parts = "operation.srr = 3 is out of range", "'m' is no unit", "2 has no unit"
    assert all(part in said for part, said in zip(parts, refused))


@pytest.mark.parametrize("command, parts", [
    ("run gear --dry-run --load 5kN", ("contact.load", "'kN'", "N/mm")),
    ("run gear --dry-run --speed 1500rpm", ("operation.u_m", "radius")),
    ("bearing 6206 --no-run --speed 3m", ("bearing.speed", "rpm")),
    ("bearing 6206 --no-run --dent 10um,3K", ("--dent", "'K'")),
    ("run gear --dry-run --load five", ("contact.load = 'five' is not a number",)),
    ("flank fzg-c --torque 3kN", ("gear.torque", "kN m")),
    ("sweep gear --dry-run --over temperature=70C,80Pa", ("operation.temperature", "'Pa'"))])
def test_another_unit_is_refused(command, parts, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert all(part in refusal(command.split()) for part in parts)


def test_an_oil_by_its_option_is_that_of_its_key():
    """Also in what is said of two that contradict each other."""
    named = typed("run gear --dry-run --oil mineral-vg220".split())
    assert named.exit_code == 0 and named.output == typed("run gear --dry-run --set oil.name=mineral-vg220".split()).output
    assert "mineral-vg220" in named.output
    assert "--oil mineral-vg220 and --set oil.name=mineral-vg320 contradict" in refusal(
        "run gear --dry-run --oil mineral-vg220 --set oil.name=mineral-vg320".split())
    assert "did you mean 'mineral-vg220'" in refusal("flank fzg-c --oil vg220".split())
    assert "did you mean 'mineral-vg220'" in refusal("traction mtm --oil vg220".split())
