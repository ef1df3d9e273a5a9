"""tehl run, resume, show and plot on stores that were cut, thinned, broken off, filled up or damaged."""

import json
import os
import random
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from commands import CALL, here
from small_stores import store

from tehl_taichi.disk import files
from tehl_taichi.runs.summary.summary_numbers import BARS
from tehl_taichi.store.store import Store

# a ridge: one dimension, 51 steps in a second
RIDGE = ("run", "gear", "--set", "feature.shape=ridge", "--grid", "64x8", "--isothermal", "--quiet", "--threads", "2",
         "--set", "fatigue.depths=[]")


@pytest.fixture
def tehl(tmp_path, monkeypatch):
    """The command line in this process: its exit code, stdout and stderr."""
    monkeypatch.chdir(tmp_path)

    def call(*words):
        done = here(*words)
        return done.returncode, done.stdout, done.stderr

    return call


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return tmp_path_factory.mktemp("whole") / "whole.zarr"


@pytest.fixture
def unbroken(tehl, whole):
    """The store of the ridge's whole passage, and its summary."""
    if not whole.exists():
        code, _, said = tehl(*RIDGE, "--out", whole)
        assert code == 0, said
    return Store.open(whole)


def assert_same(one, other, numbers):
    """Entries of two stores at these step numbers agree to 1e-10 in every field."""
    a, b = (dict(zip(saved.scalar("step").astype(int), range(len(saved)))) for saved in (one, other))
    for step in numbers:
        left, right = one.fields(a[step]), other.fields(b[step])
        assert left.keys() == right.keys()
        for name in left:
            np.testing.assert_allclose(left[name], right[name], rtol=1e-10, atol=0, err_msg=f"{name} of step {step}")


def same_results(one, other):
    for part in ("transient", "fatigue"):
        for name, value in one.summary[part].items():
            expected = pytest.approx(value, rel=1e-10) if isinstance(value, float) else value
            assert other.summary[part][name] == expected, name


def test_a_cut_passage_says_so_and_goes_on_to_the_same_result(tehl, unbroken):
    code, out, said = tehl(*RIDGE, "--steps", 5, "--out", "cut.zarr", "--json")
    summary = json.loads(out)
    assert code == 0 and summary["steps"] == 5 and "warning: passage cut at -1.37 a" in said
    assert any(sentence.startswith("passage cut at -1.37 a") for sentence in summary["warnings"])
    assert any(line.startswith("rest of the passage") for line in summary["left_out"])
    assert "cut at -1.37 a; extend with: tehl resume cut.zarr" in tehl("show", "cut.zarr")[1]
    code, out, _ = tehl("resume", "cut.zarr", "--steps", 7, "--threads", 2, "--json")
    assert code == 0 and json.loads(out)["steps"] == 12 and "passage cut at -0.94 a" in out
    code, out, _ = tehl("resume", "cut.zarr", "--threads", 2, "--json")
    summary = json.loads(out)
    assert code == 0 and summary["steps"] == 51 and summary["warnings"] == unbroken.warnings
    cut = Store.open("cut.zarr")
    assert cut.scene == unbroken.scene and len(cut) == 52
    assert_same(cut, unbroken, range(52))
    same_results(cut, unbroken)
    code, _, said = tehl("resume", "cut.zarr", "--threads", 2)
    assert code == 0 and "is finished" in said


def test_an_end_inside_the_contact_is_a_cut_too(tehl, unbroken):
    code, out, _ = tehl(*RIDGE, "--set", "time.x_end=0.0", "--no-fatigue", "--out", "half.zarr", "--json")
    assert code == 0 and "passage cut at 0.00 a" in " ".join(json.loads(out)["warnings"])
    assert tehl("resume", "half.zarr", "--threads", 2, "--quiet")[0] == 0
    assert_same(Store.open("half.zarr"), unbroken, range(52))


def test_no_steps_are_the_steady_start_alone(tehl, unbroken):
    code, out, _ = tehl(*RIDGE, "--steps", 0, "--out", "none.zarr", "--json")
    summary = json.loads(out)
    assert code == 0 and summary["steps"] == 0 and "transient" not in summary and "fatigue" not in summary
    assert tehl("resume", "none.zarr", "--steps", 2, "--threads", 2, "--quiet")[0] == 0
    assert_same(Store.open("none.zarr"), unbroken, range(3))


def test_every_third_step_is_stored_and_all_of_them_count(tehl, unbroken):
    code, _, said = tehl(*RIDGE, "--set", "output.every=3", "--out", "thin.zarr", "--steps", 20)
    assert code == 0 and "output.every = 3 leaves 0.188 a" in said
    assert tehl("resume", "thin.zarr", "--threads", 2, "--quiet")[0] == 0
    thin, t = Store.open("thin.zarr"), unbroken.summary["transient"]
    stored = sorted({*range(0, 52, 3), 20})
    assert thin.scalar("step").tolist() == stored  # 20: where it was stopped
    assert_same(thin, unbroken, stored)
    for name, value in thin.summary["transient"].items():
        if name not in (*BARS, "ripple_max_Pa"):
            assert value == pytest.approx(t[name], rel=1e-10), name
    assert 0 < thin.summary["transient"]["ripple_max_Pa"] <= t["ripple_max_Pa"]  # of what is stored
    for name in ("pressure_cycles", "newton_steps", "rejected_steps"):
        assert thin.summary["work"][name] == unbroken.summary["work"][name]
    assert thin.summary["fatigue"]["Fi_max"] == pytest.approx(unbroken.summary["fatigue"]["Fi_max"], rel=0.07)


def test_thermal_stress_of_thinned_entries():
    """Of a hot spot that moves with the surface, entries two steps apart and the last one: nearly that of every step."""
    from types import SimpleNamespace

    from tehl_taichi.fatigue.assessment import Snapshots
    from tehl_taichi.fatigue.stress.histories import StressHistories
    from tehl_taichi.fatigue.stress.thermal_stress import ThermalStress
    from tehl_taichi.scene import scene
    from tehl_taichi.scene.scales import Scales

    description = scene("gear").replace(**{"grid.nx": 64, "feature.shape": "ridge"})
    a, u = Scales.of(description).a, description.operation.u_a
    x, dx = np.linspace(-2.5 * a, 1.5 * a, 65), 4 * a / 64

    def shot(step):
        centre = -1.6 * a + step * dx
        rise = 60 * np.exp(-((x / a) ** 2)) + 50 * np.exp(-(((x - centre) / (0.4 * a)) ** 2)) * (step > 0)
        return SimpleNamespace(step=step, time=step * dx / u, feature_x=centre, x=x, y=np.zeros(1),
                               fields={"temperature_a": 90.0 + rise[:, None]})

    def heat(steps):
        reader = Snapshots([shot(step) for step in steps])
        passage = StressHistories(description, reader, np.array([reader.feature_x(n) for n in range(len(reader))]))
        stress = passage.heat(ThermalStress).on([0])
        return np.stack([stress(tick)[:, 0, 0] for tick in passage.ticks])

    kept = [*range(0, 31, 2), 31]
    whole, thin = heat(range(32)), heat(kept)
    assert np.abs(thin - whole[kept])[2:].max() < 0.02 * np.abs(whole).max()


def test_a_run_that_still_goes_is_left_alone(tehl, tmp_path):
    path = store(tmp_path / "a.zarr").path
    with Store.write(path):
        for words in (("resume", path), ("run", "--force", "--out", path)):
            code, _, said = tehl(*words)
            assert code == 2 and f"is still being written by process {os.getpid()}" in said and "--force" not in said
        assert "still being written by process" in tehl("show", path)[1]
    assert "not finished; resume with: tehl resume" in tehl("show", path)[1]


def test_a_finished_steady_run_gives_valid_json(tehl):
    steady = ("run", "smooth-line", "--steady", "--isothermal", "--grid", "32x8", "--threads", 2, "--out", "s.zarr")
    code, first, _ = tehl(*steady, "--json")
    assert code == 0
    for words in (("resume", "s.zarr", "--json"),):
        code, out, _ = tehl(*words)
        assert code == 0 and json.loads(out, parse_constant=pytest.fail)["steady"] == json.loads(first)["steady"]
    assert "±" in tehl("show", "s.zarr")[1] or "steady h_c" in tehl("show", "s.zarr")[1]


def test_a_full_disk_in_the_middle_of_a_run(tehl, unbroken, monkeypatch):
    left, written = [400], files.write

    def filling(path, content):
        left[0] -= 1
        if left[0] < 0:
            raise OSError(28, "No space left on device")
        written(path, content)

    monkeypatch.setattr("tehl_taichi.disk.files.write", filling)
    monkeypatch.setattr("tehl_taichi.runs.recorder.SHOWN", 0.0)
    code, _, said = tehl(*RIDGE, "--out", "full.zarr")
    assert code == 4 and len([line for line in said.splitlines() if not line.startswith("warning: ")]) == 1
    assert "cannot write to full.zarr: No space left on device" in said and "tehl resume full.zarr" in said
    left[0] = 10**9
    assert 1 < len(Store.open("full.zarr")) < 52
    assert tehl("resume", "full.zarr", "--threads", 2, "--quiet")[0] == 0
    assert_same(Store.open("full.zarr"), unbroken, range(52))
    same_results(Store.open("full.zarr"), unbroken)


def test_figures_go_into_folders(tehl, tmp_path):
    (tmp_path / "file").touch()
    path = store(tmp_path / "bare").path  # no suffix: the figures must not land inside
    code, _, said = tehl("plot", path, "--out", "file")
    assert code == 2 and "cannot put figures into file" in said and said.count("\n") == 1
    assert tehl("plot", path)[0] == 0 and (tmp_path / "bare-figures" / "centreline.png").exists()
    assert not list(path.glob("*.png"))


def test_show_and_plot_of_damaged_stores_are_a_sentence(tehl, tmp_path):
    path = store(tmp_path / "a.zarr").path
    (path / "p_max_Pa" / "c" / "0").write_bytes(b"nonsense")
    for words in (("show", path), ("plot", path), ("resume", path), ("fatigue", path)):
        code, out, said = tehl(*words)
        assert (code, out, said.count("\n")) == (2, "", 1) and "p_max_Pa/c/0 is damaged" in said
    for text in ("[]", '{"attributes": {"scene": "[]"}}'):
        (path / "zarr.json").write_text(text)
        for words in (("show", path), ("resume", path), ("run", path, "--out", "b.zarr")):
            code, out, said = tehl(*words)
            assert (code, out, said.count("\n")) == (2, "", 1) and "a.zarr" in said


def process(*words, **options):
    return subprocess.Popen([*CALL, *map(str, words)], text=True, stderr=subprocess.PIPE, **options)


def test_letters_that_an_encoding_lacks_are_spelled(tmp_path):
    code = ("from tehl_cli import entry; entry._print_in_any_encoding(); print('1 ± 0.1 µm, 20 °C, σ₁, ☃')")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                          env={**os.environ, "PYTHONIOENCODING": "ascii"})
    assert done.stdout == "1 +- 0.1 um, 20 deg C, sigma1, ?\n", done.stderr


def test_a_reader_that_has_seen_enough(tmp_path):
    path = store(tmp_path / "a.zarr").path
    for words in (("show", path), ("scenes",)):
        read, write = os.pipe()
        os.close(read)
        run = process(*words, stdout=write)
        os.close(write)
        assert (run.wait(), run.stderr.read()) == (0, "")


@pytest.mark.parametrize("name, by", [("SIGINT", "interrupted"), ("SIGTERM", "stopped by SIGTERM"),
                                      ("SIGHUP", "stopped by SIGHUP")])
@pytest.mark.parametrize("late", ["typer", "tehl_taichi.runs.open_results"])
def test_a_hasty_stop_meets_no_import(name, by, late):
    """While the first module is loaded, and inside of a command."""
    code = ("import sys; from tehl_cli import entry; heavy = {'typer', 'numpy', 'rich', 'tehl_taichi'} & sys.modules.keys(); "
            "assert not heavy, heavy\n"
            "class Late:\n"
            "    def find_spec(self, name, *_):\n"
            f"        if name == '{late}': import os, signal; os.kill(os.getpid(), signal.{name})\n"
            "sys.meta_path.insert(0, Late()); sys.argv = ['tehl', 'resume', 'no.zarr']; entry.main()")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (4, f"tehl: {by}; all stored data are kept\n")


@pytest.mark.parametrize("stop", [signal.SIGTERM, signal.SIGHUP])
def test_a_kill_and_a_closed_terminal_are_named(tmp_path, stop):
    run = process("run", "gear", "--threads", "2", cwd=tmp_path)
    run.stderr.readline()  # the scene is read, its name reserved; the steady start takes seconds
    assert [path.name for path in (tmp_path / "runs").iterdir()] == [".gear-1.zarr.part"]
    os.kill(run.pid, stop)
    assert run.wait() == 4 and f"stopped by {stop.name} before anything was stored" in run.stderr.read()
    assert list(tmp_path.iterdir()) == []


def test_a_stopped_run_says_by_what_and_goes_on_to_the_same_result(tehl, unbroken, monkeypatch):
    """A signal in the passage, by the handlers of the command; whole processes: the closed terminal below."""
    from tehl_cli import entry

    append, numbers = Store.append, iter(range(99))

    def killed(*words, **options):
        append(*words, **options)
        if next(numbers) == 7:
            os.kill(os.getpid(), signal.SIGTERM)

    before = signal.signal(signal.SIGTERM, entry._stop)
    try:
        with monkeypatch.context() as patched:
            patched.setattr(Store, "append", killed)
            code, _, said = tehl(*RIDGE, "--out", "a.zarr")
    finally:
        signal.signal(signal.SIGTERM, before)
    assert code == 4 and re.search(r"^tehl: stopped by SIGTERM after \d+ steps; resume with: tehl resume a.zarr$", said, re.M)
    stopped = Store.open("a.zarr")
    assert stopped.writer is None and 1 < len(stopped) < 52
    assert tehl("resume", "a.zarr", "--threads", 2, "--quiet")[0] == 0
    assert_same(Store.open("a.zarr"), unbroken, range(52))


def test_a_closed_terminal_takes_no_last_word_and_changes_no_exit_code(tmp_path):
    """In the passage, with a bar in a terminal that is gone when the signal comes."""
    ours, theirs = os.openpty()
    words = ("run", "gear", "--threads", "2", "--grid", "64x16", "--isothermal", "--no-live", "--out", "a.zarr")
    run = subprocess.Popen([*CALL, *words], cwd=tmp_path, stdout=theirs, stderr=theirs,
                           env={**os.environ, "TERM": "xterm", "COLUMNS": "120"})
    os.close(theirs)
    while not re.search(rb"\d/48", os.read(ours, 4096)):
        pass
    os.close(ours)
    os.kill(run.pid, signal.SIGHUP)
    assert run.wait() == 4
    assert Store.open(tmp_path / "a.zarr").writer is None


@pytest.mark.slow
def test_forty_kills_and_as_many_resumes(tmp_path):
    """Runs killed at random moments, resumed and killed again until they are through: nothing is lost, nobody is stuck."""
    draw, small = random.Random(3), ("--grid", "64x16", "--isothermal", "--threads", "1", "--steps", "24")
    began = time.monotonic()
    done = process("run", "gear", *small, "--out", "whole.zarr", cwd=tmp_path, stdout=subprocess.DEVNULL)
    assert done.wait() == 0
    longest = 1.5 * (time.monotonic() - began)
    kills, stores, path = 0, 0, tmp_path / "k.zarr"
    while kills < 40:
        words = ("resume", path, "--threads", "1") if path.exists() else ("run", "gear", *small, "--out", path)
        run = process(*words, cwd=tmp_path, stdout=subprocess.DEVNULL)
        moment = draw.uniform(0.0, longest)
        try:
            run.wait(moment)
            assert run.returncode == 0, run.stderr.read()
        except subprocess.TimeoutExpired:
            polite = [signal.SIGTERM, signal.SIGINT] if moment > 1.0 else []  # before, the interpreter itself is starting
            os.kill(run.pid, draw.choice([signal.SIGKILL, *polite]))
            code = run.wait()  # as Python itself ends: all is stored, its own handlers are gone
            assert code in (-signal.SIGKILL, 4, 0) or path.exists() and Store.open(path).finished
            kills += 1
        if path.exists():
            saved = Store.open(path)
            assert saved.writer is None and len(saved) >= 1
            if saved.finished:
                assert_same(saved, Store.open(tmp_path / "whole.zarr"), range(25))
                path.rename(tmp_path / f"{stores}.zarr")
                stores += 1
    assert stores >= 2
