"""What is said twice, or comes from another version, is refused: nothing is mixed or dropped in silence."""

import json

import pytest
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.crack.crack_options import CrackOptions
from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.runs import single_run
from tehl_taichi.runs.flank import load_table
from tehl_taichi.runs.flank.flank_source import flank_source
from tehl_taichi.runs.sweep import study_file
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.runs.sweep.study_table import Study

LINE = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})


def as_of(version, path):
    """The metadata of a group, said to be of that version."""
    root = json.loads((path / "zarr.json").read_text())
    root["attributes"]["version"] = version
    (path / "zarr.json").write_text(json.dumps(root))


@pytest.mark.parametrize("version", ["0.1.0", "99.0", "unknown"])
def test_a_study_of_another_version_is_not_gone_on_with(tmp_path, version):
    found = plan(LINE, {"srr": [0.1, 0.2]})
    Study.write(tmp_path / "s.zarr", found).close()
    Study.write(tmp_path / "s.zarr", found).close()
    as_of(version, tmp_path / "s.zarr")
    with pytest.raises(StoreError, match=f"was written by version {version}, this is .*not mixed"):
        tehl.sweep(LINE, {"srr": [0.1, 0.2]}, tmp_path / "s.zarr", workers=1)
    assert len(Study.open(tmp_path / "s.zarr")) == 2  # it can be read


def test_neither_is_a_case_or_a_position(tmp_path):
    path = tmp_path / "pitch"
    words = {"at": ["C"], "steady": True, "changes": {"grid.nx": 64, "thermal.on": False}, "folder": path, "workers": 1}
    flank = tehl.flank("fzg-c", **words)
    store = next(path.glob("*.zarr"))
    assert tehl.flank("fzg-c", **words).rows == flank.rows
    as_of("0.7.0", store)
    with pytest.raises(StoreError, match="was written by version 0.7.0 .*not mixed"):
        tehl.flank("fzg-c", **words)
    with pytest.raises(StoreError, match="was written by version 0.7.0 .*not mixed"):
        single_run.run_or_resume(tehl.open(store).scene, store)


HEADS = ["x_pl_mm", "load_N_per_mm", "R_a_mm", "R_b_mm", "u_a_m_s", "u_b_m_s", "point", "mine"]


@pytest.mark.parametrize("twice", HEADS)
def test_a_table_with_a_column_twice(tmp_path, twice):
    row = ["1", "300", "10", "20", "3", "2", "C", "7"]
    (tmp_path / "t.csv").write_text(",".join([*HEADS, "other"]) + "\n" + ",".join([*row, "9"]) + "\n")
    assert len(load_table.load(tmp_path / "t.csv")) == 1
    (tmp_path / "t.csv").write_text(",".join([*HEADS, f" {twice} "]) + "\n" + ",".join([*row, "9"]) + "\n")
    with pytest.raises(SceneError, match=f"has the column {twice} twice"):
        load_table.load(tmp_path / "t.csv")


def test_positions_by_number_and_by_name():
    with pytest.raises(SceneError, match=r"positions = 5 and at = \['C'\] contradict each other"):
        flank_source("fzg-c").positions(count=5, at=["C"])
    assert len(flank_source("fzg-c").positions(at=["C"])) == 1 and len(flank_source("fzg-c").positions(count=9)) == 9


@pytest.mark.parametrize("words", [
    "sweep gear --set srr=0.1 --over srr=0.1,0.2", "sweep gear --set operation.srr=0.1 --over srr=0.1,0.2",
    "sweep gear --set load=1e6 --over hertz_pressure=1e9,2e9", "sweep gear --grid 64x16 --over grid.nx=64,128",
    "sweep gear --set feature.height=1e-6 --over height=1e-6,2e-6", "sweep gear --isothermal --over thermal.on=true,false",
    "sweep gear --set srr=0.1 --over operation.u_a=1,2", "sweep gear --set srr=0.1 --samples 3 --over srr=0:0.1",
    "run gear --srr 0.1 --set operation.srr=0.2", "run gear --set srr=0.1 --set srr=0.2", "run gear --speed 3 --set speed=4",
    "run gear --grid 64x16 --set grid.nx=128",
    "run gear --kappa 0.2 --set fatigue.kappa=0.3", "run gear --zoom auto --set zoom.factor=2",
    "run gear --thermal --set thermal.on=false", "flank fzg-c --steady --set time.steady_only=false",
    "flank fzg-c --height 1e-6 --set height=2e-6"])
def test_a_key_that_is_set_and_set_again(words):
    from tehl_cli.main import app

    found = CliRunner().invoke(app, words.split()).exception
    assert isinstance(found, SceneError) and "contradict each other: give one of them" in str(found), found


@pytest.mark.parametrize("words", ["sweep gear --set speed=3 --over srr=0.1,0.2 --dry-run",
                                   "sweep gear --set srr=0.1 --set operation.srr=0.1 --over load=1e6,2e6 --dry-run"])
def test_keys_that_go_together_do(words):
    from tehl_cli.main import app

    assert CliRunner().invoke(app, words.split()).exit_code == 0


@pytest.mark.parametrize("words, name", [
    ("run gear --srr 0.1 --srr 0.2", "--srr"), ("run gear --srr=0.1 --quiet --srr 0.1", "--srr"),
    ("run gear --thermal --isothermal", "--thermal/--isothermal"), ("sweep gear --grid 64 --over srr=0,1 --grid 32", "--grid"),
    ("bench speed --threads 1 --threads 2", "--threads"), ("fatigue none --kappa 0.2 --kappa 0.3", "--kappa"),
    ("bearing 6206 --load 5000 --load 6000", "--load"), ("report none --out a --out b", "--out")])
def test_an_option_that_is_typed_twice(words, name):
    from tehl_cli.main import app

    found = CliRunner().invoke(app, words.split())
    assert found.exit_code == 2 and f"{name} is given twice; give it once" in " ".join(found.output.replace("│", "").split())


def test_options_that_take_several_values_do():
    from tehl_cli.main import app

    words = "sweep gear --over srr=0.1,0.2 --over speed=1,2 --set grid.nx=64 --set grid.ny=16 --dry-run --dry-run"
    assert CliRunner().invoke(app, words.split()).exit_code == 0


def test_a_figure_and_a_dent_that_are_described_twice(tmp_path):
    from tehl_cli.bearing_features import dent_of
    from tehl_cli.main import app

    assert dent_of("10um,0.3mm,rim=1um,rim_width=9um").rim_width == 9e-6
    with pytest.raises(SceneError, match="gives a value twice"):
        dent_of("10um,0.3mm,rim=1um,rim=5um")
    words = ["compare", "a", "b", "--format", "png", "--out", str(tmp_path / "c.pdf")]
    assert "does not end in .png; omit --format" in str(CliRunner().invoke(app, words).exception)
    assert "not end" not in str(CliRunner().invoke(app, [*words[:3], "--out", words[-1]]).exception)


@pytest.mark.parametrize("text", ["[set]\nsrr = 0.1\n[over]\nsrr = [0.1, 0.2]",
                                  "[set]\nload = 1e6\n[over]\nhertz_pressure = [1e9]",
                                  "[set]\nsrr = 0.1\n[[together]]\nsrr = [0.1, 0.2]\nload = [1e6, 2e6]"])
def test_a_study_file_that_says_a_key_twice(tmp_path, text):
    (tmp_path / "a.toml").write_text(text)
    with pytest.raises(SceneError, match="in all cases and the sweep over .* contradict each other"):
        study_file.load(tmp_path / "a.toml")


@pytest.mark.parametrize("text, said", [
    ("[over]\noperation.srr = [0.1]\n\"operation.srr\" = [0.2, 0.3]", "operation.srr is given twice"),
    ("[over]\nsrr = [0.1]\n[set]\n\"oil.eta0\" = 0.1\noil.eta0 = 0.2", "oil.eta0 is given twice, .*: 0.1 and 0.2"),
    ("[[together]]\noil.eta0 = [0.1]\n\"oil.eta0\" = [0.2]", "oil.eta0 is given twice"),
    ("[[together]]\nsrr = [0.1]\nload = [1e6]\n[[together]]\nsrr = [0.2]\nload = [2e6]", "srr, load is swept twice in"),
    ("[[together]]\nsrr = [0.1]\nload = [1e6]\n[[together]]\nload = [2e6]\nsrr = [0.2]", "is swept twice")])
def test_a_study_file_of_which_nothing_is_dropped(tmp_path, text, said):
    (tmp_path / "a.toml").write_text(text)
    with pytest.raises(SceneError, match=said):
        study_file.load(tmp_path / "a.toml")


def test_a_crack_on_the_other_side_of_its_mouth():
    for side, start in (("entry", 4e-5), ("exit", -4e-5)):
        with pytest.raises(SceneError, match=f"not on the side '{side}'"):
            CrackOptions(side=side, start=start)
        assert CrackOptions(side=side, start=-start).sides == (side,)
