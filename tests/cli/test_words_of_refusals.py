"""What people run into first: brackets, endings, full disks, edited stores, other types in Python: one sentence each."""

import ast
import errno
import json
import os
import pickle
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import made_results
import numpy as np
import pytest
from commands import CALL, here
from small_stores import store
from tehl_cli.fatigue_options import _depths

import tehl_taichi as tehl
from tehl_taichi import errors
from tehl_taichi.disk import files
from tehl_taichi.errors import brief, typed_options
from tehl_taichi.runs.sweep import case, case_records, study_file, sweeping
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.runs.sweep.study_table import Study
from tehl_taichi.scene import scene_file
from tehl_taichi.scene.surface.maps import height_map
from tehl_taichi.store import attributes, integrity

PYTHON = re.compile("NoneType|object is|object has|subscriptable|indices must|Errno|Traceback|iterable|"
                    "(?:positional|keyword) argument|Expecting")


def one_sentence(text):
    """Whether a message is one for people: short, without what Python says of its own insides."""
    return 0 < len(text) < 400 and not PYTHON.search(text)


@pytest.mark.parametrize("text, said", [
    ("[together]\nsrr = [0.1, 0.2]", r"[together] in FILE must be [[together]]"),
    ("together = 3", r"together = 3 in FILE must be [[together]]"),
    ("[[over]]\nsrr = [0.1, 0.2]", r"[[over]] in FILE must be [over]"),
    ("[[set]]\nsrr = 0.1\n[over]\nspeed = [1.0, 2.0]", r"[[set]] in FILE must be [set]"),
    ("over = []", r"over = [] in FILE must be [over]"),
])
def test_brackets_of_a_study_file(tmp_path, text, said):
    file = tmp_path / "study.toml"
    file.write_text(text)
    with pytest.raises(tehl.SceneError) as found:
        study_file.load(file)
    assert str(found.value).startswith(said.replace("FILE", str(file)))


@pytest.mark.parametrize("text, said", [
    ("[feature]\nheight = 1e-6", "[feature] in FILE must be [[feature]]"),
    ("feature = 'ridge'", "feature = 'ridge' in FILE must be [[feature]]"),
    ("[[grid]]\nnx = 64", "[[grid]] in FILE must be [grid]"), ("oil = 'pao'", "oil = 'pao' in FILE must be [oil]"),
])
def test_brackets_of_a_scene_file(tmp_path, text, said):
    file = tmp_path / "mine.toml"
    file.write_text(f'base = "gear"\n{text}' if text[0] == "[" else f'{text}\nbase = "gear"')
    with pytest.raises(tehl.SceneError) as found:
        scene_file.load(file)
    assert str(found.value).startswith(said.replace("FILE", str(file)))


@pytest.mark.parametrize("ending", [".csv", ".txt", ".asc", ".npy"])
def test_endings_of_heights_in_capitals(tmp_path, ending):
    heights = np.arange(30.0).reshape(5, 6)
    names = [f"scan{form(ending)}" for form in (str.lower, str.upper, str.title)]
    for name in names:
        if ending == ".npy":
            with open(tmp_path / name, "wb") as file:
                np.save(file, heights)
        else:
            np.savetxt(tmp_path / name, heights, delimiter="," if ending == ".csv" else " ")
        assert np.array_equal(height_map.table_of(tmp_path / name).values, heights), name


def test_endings_of_scenes_studies_tables_and_pictures_in_capitals(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("MINE.TOML").write_text('base = "gear"\n[operation]\nsrr = 0.07')
    assert tehl.scene("MINE.TOML").operation.srr == pytest.approx(0.07)
    Path("STUDY.TOML").write_text('scene = "MINE.TOML"\n[over]\nspeed = [1.0, 2.0]')
    assert study_file.is_study_file("STUDY.TOML") and study_file.load("STUDY.TOML").count == 2
    assert study_file.load("STUDY.TOML").scene.operation.srr == pytest.approx(0.07)
    from tehl_taichi.runs.flank.flank_source import flank_source
    from tehl_taichi.view.figures.figure_style import FigureStyle

    Path("TABLE.CSV").write_text("x_pl_mm,R_a_mm,R_b_mm,u_a_m_s,u_b_m_s,load_N_per_mm\n1,9,8,8,9,200\n2,8,9,9,8,200\n")
    assert len(flank_source("TABLE.CSV").table) == 2
    Path("PAIR.TOML").write_text('base = "fzg-c"')
    assert flank_source("PAIR.TOML").pair is not None
    assert FigureStyle("png").of_file("a.PDF")[0].format == "pdf"
    with pytest.raises(tehl.SceneError, match="NOTHING.TOML"):
        tehl.scene("NOTHING.TOML")


def test_a_reader_of_instruments_that_dumps_all_it_tried(tmp_path, monkeypatch):
    """Sixty lines of every format that SurfaceTopography knows are of no use to anybody."""
    dump = "\n".join(["No reader found for the file.", *(f"  Format{n}: Traceback: not mine" for n in range(60))])

    def reader(kind):
        def read(path):
            raise kind(dump)

        return SimpleNamespace(read_topography=read)

    file = tmp_path / "scan.SUR"
    file.write_bytes(b"PK rubbish")
    for kind, said in ((type("CannotDetectFileFormat", (Exception,), {}), "does not read this format"),
                       (RuntimeError, "No reader found for the file.")):
        monkeypatch.setitem(sys.modules, "SurfaceTopography", reader(kind))
        with pytest.raises(tehl.SceneError) as found:
            height_map.table_of(file)
        assert said in str(found.value) and str(file) in str(found.value) and one_sentence(str(found.value))
    assert brief(ValueError("\n\n  first \n second")) == "first" and brief(KeyError()) == "KeyError"
    assert len(brief(ValueError("long " * 300))) < 210


def full(*_, **__):
    raise OSError(errno.ENOSPC, "No space left on device")


@pytest.mark.parametrize("scan", [False, True])
def test_new_where_nothing_can_be_written(taichi_cpu, tmp_path, monkeypatch, scan):
    """Read-only, or full in the middle of the file: said in a sentence, nothing is left."""
    np.savetxt(tmp_path / "scan.csv", np.arange(30.0).reshape(5, 6), delimiter=",")
    words = ("new", tmp_path / "my.toml", *(("--scan", tmp_path / "scan.csv") if scan else ()))
    for method, error in (("mkdir", OSError(errno.EROFS, "Read-only file system")),
                          ("write_text", OSError(errno.ENOSPC, "No space left on device"))):
        def fail(path, *args, error=error, usual=getattr(Path, method), **named):
            if path.is_relative_to(tmp_path):
                raise error
            return usual(path, *args, **named)  # the cache of kernels lies elsewhere

        with monkeypatch.context() as disk:
            disk.setattr(Path, method, fail)
            found = here(*words)
        code = 1 if error.errno == errno.ENOSPC else 2
        assert found.returncode == code and found.stdout == "" and one_sentence(found.stderr)
        assert str(tmp_path) in found.stderr and error.strerror in found.stderr
        assert {path.name for path in tmp_path.iterdir()} == {"scan.csv"}


GEAR = tehl.scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16})


def made_up(job, progress=None):
    return {"status": "converged", "reason": "", "summary": {"steady": {"h_c_m": 1e-7}}, "seconds": 1.0}


@pytest.mark.parametrize("where", ["tehl_taichi.runs.sweep.study_table.replace", "tehl_taichi.runs.sweep.case_records.append",
                                   "tehl_taichi.runs.sweep.study_table.Study._make",
                                   "tehl_taichi.runs.sweep.study_table.Study._csv"])
def test_a_sweep_into_a_full_disk(tmp_path, monkeypatch, where):
    """The sentence, not the number of the error; and the same command goes on."""
    path = tmp_path / "s.zarr"
    with monkeypatch.context() as disk:
        disk.setattr(where, full)
        with pytest.raises(tehl.StoreError, match="No space left on device; stored cases are kept"):
            sweeping.run(plan(GEAR, {"srr": [0.1, 0.2]}), path, workers=1, work=made_up)
    study = sweeping.run(plan(GEAR, {"srr": [0.1, 0.2]}), path, workers=1, work=made_up)
    assert study.counts["converged"] == 2 and Study.open(path).counts == study.counts


def test_commands_without_room_for_their_runs_do_not_begin(tmp_path, monkeypatch):
    usage, cycle = SimpleNamespace(free=3e6), tmp_path / "cycle.csv"
    cycle.write_text("angle_deg, load_N_per_mm, R_mm, u_a_m_s, u_b_m_s\n0, 100, 10, 3.0, 1.0\n")
    monkeypatch.setattr("shutil.disk_usage", lambda folder: usage)
    for words in (("run", "smooth-line"), ("sweep", "gear", "--over", "srr=0.1,0.2", "--workers", 1, "--threads-per-worker", 2),
                  ("flank", "fzg-c", "--steady"), ("cam", cycle), ("bearing", "6206", "--load", 3000, "--speed", 3000)):
        found = here(*words, "--out", tmp_path / "new" / "s")
        assert found.returncode == 1 and "only 3 MB left" in found.stderr and list(tmp_path.iterdir()) == [cycle], words


REFUSED = [(errno.ENOSPC, 1), (errno.EACCES, 2), (errno.EROFS, 2)]


@pytest.mark.parametrize("number, first", REFUSED)
@pytest.mark.parametrize("stored, left", [(0, None), (0, "0000.zarr"), (1, None)])
def test_a_study_is_interrupted_by_the_disk_once_it_has_a_store_or_a_result(tmp_path, monkeypatch, number, first, stored, left):
    """The exit code of a run that is resumed from its stored steps; before them that of a full disk, or of a path."""
    path, over = tmp_path / "s.zarr", {"srr": [0.1, 0.2]}

    def refuse(*_, **__):
        raise OSError(number, os.strerror(number))

    def last(job, progress=None):
        monkeypatch.setattr("tehl_taichi.runs.sweep.case_records.append", refuse)
        if left:
            (path / "cases" / left).mkdir()
        return made_up(job)

    answers = iter((*[made_up] * stored, last))
    with pytest.raises(tehl.Error, match=f"{os.strerror(number)}; stored cases are kept") as found:
        sweeping.run(plan(GEAR, over), path, workers=1, work=lambda job, progress=None: next(answers)(job))
    assert found.value.exit_code == (4 if stored or left else first) and Study.open(path).counts["converged"] == stored


@pytest.mark.parametrize("number, first", REFUSED)
@pytest.mark.parametrize("writes, code", [(0, None), (1, 4)])
def test_a_flank_that_the_disk_refuses_is_interrupted_once_it_has_a_result(tmp_path, monkeypatch, number, first, writes, code):
    from tehl_taichi.runs.flank import outcomes

    class Full:
        folder, left = tmp_path / "my flank", iter(range(writes))

        def lies_in(self, folder):
            return False

        def write(self):
            if next(self.left, None) is None:
                raise files.store_error(OSError(number, "refused"), "cannot write")

    monkeypatch.setattr(outcomes, "summaries", lambda *_: iter([(0, None)]))
    with pytest.raises(tehl.Error, match="cannot write") as found:
        outcomes.computed(Full(), lambda made, n, outcome: made, [GEAR])
    assert found.value.exit_code == (code or first)
    assert ("; repeat the call with folder='" in str(found.value)) is bool(code)


def test_the_systems_refusals_are_told_without_their_numbers(tmp_path, monkeypatch):
    for error, said in ((OSError(errno.ENOSPC, "No space left on device"), "tehl: No space left on device\n"),
                        (PermissionError(errno.EACCES, "Permission denied", "/x/y"), "tehl: /x/y: Permission denied\n"),
                        (MemoryError(), "tehl: MemoryError\n")):
        def fail(path, error=error):
            raise error

        monkeypatch.setattr("tehl_taichi.runs.open_results.kind", fail)
        found = here("show", tmp_path)
        assert found.returncode == 1 and found.stderr == said


@pytest.mark.parametrize("words, said", [
    (("--workers", 0), "--workers = 0"), (("--threads-per-worker", 0), "--threads-per-worker = 0"),
    (("--keep", "all"), "--keep = 'all'"), (("--workers", 2, "--scheduler", "tcp://10.0.0.1:8786"), "contradict each other")])
def test_a_dry_run_refuses_what_the_run_would(words, said):
    for dry in ((), ("--dry-run",)):
        found = here("sweep", "gear", "--over", "srr=0.1,0.2", *words, *dry)
        assert found.returncode == 2 and said in found.stderr and found.stdout == ""


CALLS = {"march": lambda one: tehl.march(one), "run": lambda one: tehl.run(one, "x.zarr"), "simulate": tehl.simulate,
         "sweep": lambda one: tehl.sweep(one, {"srr": [0.1]}, "s.zarr", workers=1),
         "over": lambda one: tehl.sweep("gear", one, "s.zarr", workers=1), "flank": lambda one: tehl.flank(one, folder="f"),
         "scene of a flank": lambda one: tehl.flank(scene=one or 3, folder="f"), "open": tehl.open, "resume": tehl.resume,
         "report": tehl.report, "export": tehl.export, "animate": tehl.animate, "compare": lambda one: tehl.compare(one, one),
         "crack": tehl.crack, "fatigue": tehl.fatigue, "path": lambda one: tehl.run("gear", one or 3),
         "folder": lambda one: tehl.flank(folder=one or 3), "scene of stresses": lambda one: tehl.crack([], one or 3)}


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("given", [None, 3, {"grid": 1}, b"gear", ["gear"], np.float64(2.0)], ids=repr)
def test_python_calls_with_something_else(call, given, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(tehl.Error) as found:
        CALLS[call](given)
    assert one_sentence(str(found.value)) and list(tmp_path.iterdir()) == []


def test_march_takes_the_name_of_a_built_in_scene(taichi_cpu):
    with pytest.raises(tehl.SceneError, match="unknown scene 'gaer' .did you mean 'gear'"):
        tehl.march("gaer")
    assert next(tehl.march("furrow-line")).fields["film"].shape == (tehl.scene("furrow-line").grid.nx + 1, 1)


def test_importing_what_python_m_runs_runs_nothing():
    code = "import sys; sys.argv = ['x', '--version']; import tehl_taichi.__main__; print('still here')"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "still here\n"
    told = subprocess.run([sys.executable, "-m", "tehl_taichi", "--version"], capture_output=True, text=True)
    assert told.returncode == 0 and told.stdout.startswith("tehl_taichi ")


def test_an_interrupt_is_named_by_its_signal_never_by_an_exit_code(monkeypatch, capsys):
    """Wherever Ctrl-C comes: typer makes 130 of it."""
    from tehl_cli import entry

    monkeypatch.setattr(entry.atexit, "register", lambda *_: None)  # or pytest itself would end with the code of this command
    monkeypatch.setattr(entry, "_stop_as_ctrl_c_does", lambda: None)
    monkeypatch.setattr(entry, "_ignore_stops", lambda: None)
    for raised, said in ((KeyboardInterrupt(), "interrupted"), (entry._by("SIGTERM"), "stopped by SIGTERM")):
        def ended(raised=raised):
            try:
                try:
                    raise raised
                except KeyboardInterrupt:
                    raise RuntimeError(130) from None
            except RuntimeError:
                raise SystemExit(130) from None

        monkeypatch.setattr("tehl_cli.main.app", ended)
        with pytest.raises(SystemExit) as end:
            entry.main()
        assert end.value.code == 4 and f"tehl: {said}; all stored data are kept" in capsys.readouterr().err


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGHUP])
def test_signals_in_the_first_moments(number, tmp_path):
    """As soon as the program has begun: 4 and a sentence."""
    path = store(tmp_path / "a.zarr").path
    code = CALL[2].replace("main()", "print('begun', flush=True); main()")
    for wait in (0.05, 0.2):
        run = subprocess.Popen([sys.executable, "-c", code, "show", path], text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
        assert run.stdout.readline() == "begun\n"
        time.sleep(wait)
        run.send_signal(number)
        _, said = run.communicate()
        assert run.returncode in (0, 4) and "130" not in said and "Traceback" not in said
        if run.returncode == 4:
            assert said.strip().splitlines()[-1].endswith("all stored data are kept")


DROPPED = """
import signal, sys, time, weakref
import tehl_cli.main
from tehl_cli.entry import main

class Thing: pass

def app():
    thing = Thing()
    kept = weakref.ref(thing, lambda _: signal.raise_signal(int(sys.argv[1])))
    del thing
    time.sleep(0.3)
    for _ in range(100): time.sleep(0.05)

tehl_cli.main.app = app
main()
"""


@pytest.mark.parametrize("number, named", [(signal.SIGINT, "interrupted"), (signal.SIGTERM, "stopped by SIGTERM")])
def test_a_stop_that_python_drops_comes_again(number, named):
    """Errors of the callback of a weak reference are ignored, a Ctrl-C among them."""
    run = subprocess.run([sys.executable, "-c", DROPPED, str(int(number))], text=True, capture_output=True)
    assert (run.returncode, run.stderr) == (4, f"tehl: {named}; all stored data are kept\n")


AGAIN = """
import signal, sys
import tehl_cli.main
from tehl_cli.entry import main

class Last:  # deleted when Python has handed the signals back to the system
    def __del__(self, stop=signal.raise_signal, number=int(sys.argv[1])):
        stop(number)

class Writer:  # what it is led to is written while the last message is printed
    def write(self, text, stop=signal.raise_signal, number=int(sys.argv[1])):
        stop(number)
        return sys.__stderr__.write(text)

    flush = sys.__stderr__.flush

def app():
    if sys.argv[2] == "last message":
        sys.stderr = Writer()
    signal.raise_signal(int(sys.argv[1]))

last, tehl_cli.main.app = Last(), app
main()
"""


@pytest.mark.parametrize("when", ["end of Python", "last message"])
@pytest.mark.parametrize("number, named", [(signal.SIGINT, "interrupted"), (signal.SIGTERM, "stopped by SIGTERM")])
def test_a_second_stop_changes_nothing(number, named, when):
    """Whenever it comes after the first one: 4 and its sentence."""
    run = subprocess.run([sys.executable, "-c", AGAIN, str(int(number)), when], text=True, capture_output=True)
    assert (run.returncode, run.stderr) == (4, f"tehl: {named}; all stored data are kept\n")


def test_a_stop_that_another_library_turns_into_an_error_is_a_stop():
    """As Python does with errors of __set_name__, and C code while it is imported."""
    code = AGAIN.replace("signal.raise_signal(int(sys.argv[1]))\n\nlast", "try: signal.raise_signal(int(sys.argv[1]))\n"
                         "    except BaseException: raise ImportError('initialization failed') from None\n\nlast")
    assert code != AGAIN
    run = subprocess.run([sys.executable, "-c", code, "15", ""], text=True, capture_output=True)
    assert (run.returncode, run.stderr) == (4, "tehl: stopped by SIGTERM; all stored data are kept\n")


def test_a_traceback_does_not_change_the_exit_code():
    plain, debug = here("show", "none.zarr"), here("show", "none.zarr", "--debug")
    assert plain.returncode == debug.returncode == 2
    assert ("Traceback" in debug.stderr, "Traceback" in plain.stderr) == (True, False)


def test_a_message_names_the_option_or_the_argument(tmp_path, monkeypatch):
    """As its reader types it; whole commands in backquotes stay, in Python, too."""
    monkeypatch.chdir(tmp_path)
    Path("mine").write_text("mine")
    for words, call, option, argument in (
            ("sweep gear --over srr=0.1,0.2 --workers 0", lambda: tehl.sweep("gear", {"srr": [0.1, 0.2]}, workers=0),
             "--workers = 0", "workers = 0"),
            ("flank fzg-c --threads 0", lambda: tehl.flank("fzg-c", threads=0), "--threads = 0", "threads = 0"),
            ("run gear --out mine", lambda: tehl.run("gear", "mine"), "another --out", "another path"),
            ("sweep gear --over srr=0.1,0.2 --keep all", lambda: tehl.sweep("gear", {"srr": [0.1, 0.2]}, keep="all"),
             "--keep = 'all'", "keep = 'all'")):
        with pytest.raises(tehl.Error) as raised:
            call()
        said = here(*words.split()).stderr
        assert option in said and argument in str(raised.value) and "--" not in str(raised.value)
        assert said == f"tehl: {str(raised.value).replace(argument, option)}\n"
    assert str(tehl.Error("`tehl run a --out NEW`; use --force")) == "`tehl run a --out NEW`; use force=True"
    assert str(tehl.Error("use --grid 128x32, --zoom 4, --set time.steps=3 or --precision f64")) == (
        "use grid.nx=128 and grid.ny=32, zoom.factor=4, time.steps=3 or numerics.precision='f64'")
    with pytest.raises(tehl.SceneError, match="^over needs a key"):
        tehl.sweep("gear", {})


@pytest.mark.parametrize("typed, word", [(True, "another --out"), (False, "another path")])
def test_a_worker_names_what_its_sweep_names(tmp_path, typed, word):
    """A job is made in the process of the command; its reasons are words of another one, where nothing was typed."""
    (tmp_path / "mine").write_text("mine")
    with typed_options(typed):
        job = case.CaseJob(GEAR, str(tmp_path / "mine"))
    with typed_options(not typed):
        assert word in case.run_case(pickle.loads(pickle.dumps(job)))["reason"]


def spoken_texts(tree):
    """Texts of a file without its docstrings; `%` stands for a value."""
    parts = list(ast.walk(tree))
    formatted = [part.values for part in parts if isinstance(part, ast.JoinedStr)]
    docstrings = {id(part.value) for part in parts if isinstance(part, ast.Expr)}
    other = docstrings | {id(one) for values in formatted for one in values}
    alone = [[part] for part in parts if isinstance(part, ast.Constant) and id(part) not in other]
    return ["".join(str(one.value) if isinstance(one, ast.Constant) else "%" for one in values)
            for values in (*formatted, *alone)]


def test_every_option_in_a_text_of_the_package_has_a_name_in_python():
    """Outside of whole commands in backquotes: errors, warnings, reasons; errors.py holds the names, commit.py calls git."""
    files = (path for path in Path(tehl.__file__).parent.rglob("*.py") if path.name not in ("errors.py", "commit.py"))
    texts = [text for path in files for text in spoken_texts(ast.parse(path.read_text(encoding="utf-8")))]
    named = [[re.sub("`[^`]*`", "", errors.for_reader(text.replace("%", value))) for value in ("4", "key=4")] for text in texts]
    assert len(texts) > 3000 and [one for one in named if all(re.search("--[a-z]", text) for text in one)] == []


@pytest.mark.parametrize("command", ["run", "flank", "sweep", "traction", "bearing", "roller"])
@pytest.mark.parametrize("name", ["my.tml", "runs/none"])
def test_a_missing_file_is_not_taken_for_a_misspelt_name(command, name):
    more = {"sweep": ("--over", "srr=0.1"), "traction": ("--srr", 0.1)}.get(command, ())
    found = here(command, name, *more)
    assert (found.returncode, found.stderr) == (2, f"tehl: {name} does not exist\n")


@pytest.mark.parametrize("words", ["run mine.tml", "run min.toml", "run mine", "bearing mine.tml", "bearing my.toml",
                                   "flank mine.tml", "flank mne.toml", "cam min.toml", "sweep mine.tml --over srr=0.1",
                                   "show mine", "run gear --set fatigue.table=mine.txt", "bearing 6206 --scan mine.tom"])
def test_a_missing_file_is_refused_with_the_nearest_one(tmp_path, words):
    (tmp_path / "mine.toml").write_text("")
    found = here(*words.split(), cwd=tmp_path)
    assert found.returncode == 2 and "did you mean 'mine.toml'?" in found.stderr
    assert re.search("does not exist|No such file|neither a file", found.stderr)


@pytest.mark.parametrize("words, said", [
    (("run", ""), "'' is not a scene"), (("sweep", "", "--over", "srr=0.1"), "'' is not a scene"),
    (("flank", ""), "gear = '' is not a path"), (("bearing", ""), "bearing = '' is not a path"),
    (("run", "gear", "--set", "=3"), "--set '=3' must have the form"), (("run", "gear", "--oil", ""), "and not empty")])
def test_an_empty_word_is_refused_as_such(words, said):
    """A shell gives one for a variable that is not set; an empty path is not the working directory."""
    found = here(*words)
    assert found.returncode == 2 and said in found.stderr


def test_a_bearing_file_may_have_any_ending(tmp_path):
    (tmp_path / "mine.tml").write_text('base = "6206"')
    (tmp_path / "6206").write_text("")  # no file hides a designation
    for name in ("mine.tml", "6206"):
        assert here("bearing", name, "--no-run", "--no-figure", cwd=tmp_path).returncode == 0


def test_suggested_commands_take_names_with_spaces(tmp_path):
    """As a shell reads them."""
    path = made_results.run(tmp_path / "my run.zarr")
    words = re.search(r"`(tehl .*?)`", here("resume", path).stderr)[1]
    assert shlex.split(words) == ["tehl", "run", str(path), "--out", "NEW"]


def test_a_name_that_is_too_long_is_named(tmp_path):
    name = 250 * "a"
    said = here("run", "gear", "--grid", "64x16", "--isothermal", "--steady", "--out", name, cwd=tmp_path).stderr
    assert f"cannot write to {name}: File name too long (250 bytes; allowed: 249)" in said


@pytest.mark.parametrize("make", [os.mkdir, os.mkfifo])
def test_a_scan_that_is_no_file_is_not_missing(tmp_path, make):
    make(tmp_path / "scan")
    assert "scan' is not a file" in here("new", tmp_path / "a.toml", "--scan", tmp_path / "scan", "--pixel", "1um").stderr


@pytest.mark.parametrize("depths, metres", [("50um", [50e-6]), ("5e-5,0.1mm", [5e-5, 1e-4]), ("none", []), ("auto", "auto")])
def test_depths_may_have_a_unit(depths, metres):
    assert _depths(depths) == (metres if isinstance(metres, str) else pytest.approx(metres))


@pytest.mark.parametrize("depths", ["deep", "50bar", "", "5e-5;1e-4"])
def test_other_depths_are_refused(depths):
    with pytest.raises(tehl.SceneError, match="^--depths = "):
        _depths(depths)


def test_arguments_without_effect_or_out_of_range_are_refused(tmp_path):
    run = tehl.open(made_results.run(tmp_path / "made.zarr"))
    for call, said in ((lambda: run.fatigue(on=False), "on = False has no effect"),
                       (lambda: run.fatigue(threads="1"), "threads = '1' is not a whole number"),
                       (lambda: run.fatigue(threads=0), "threads = 0 is out of range")):
        with pytest.raises(tehl.Error, match=said):
            call()


def test_a_study_has_stores_of_its_own_cases_only(tmp_path):
    with Study.write(tmp_path / "s.zarr", plan(tehl.scene("gear"), {"srr": [0.1, 0.2]})) as study:
        assert study.store_of(1).name == "0001.zarr"
        for number in (2, -1, "1"):
            with pytest.raises(tehl.SceneError, match="number = .* allowed: 0 to 1"):
                study.store_of(number)


WRONG = (None, 3, "x", [], "null", "3", '{"a": 1}', '[1]')
THRICE = {f"{name} {what}" for name in ("summary", "warnings", "date", "version", "outputs") for what in ("removed", "= 3")}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return made_results.run(tmp_path_factory.mktemp("edited") / "whole.zarr", search=made_results.fatigue())


def edits(attrs):
    """(what, attributes) with each attribute in turn removed or of another type."""
    for name in attrs:
        yield f"{name} removed", {key: value for key, value in attrs.items() if key != name}
        yield from ((f"{name} = {wrong!r}", {**attrs, name: wrong}) for wrong in WRONG if wrong != attrs[name])


def test_a_store_with_an_edited_attribute_is_read_or_refused_in_a_sentence(whole, tmp_path):
    path = tmp_path / "edited.zarr"
    shutil.copytree(whole, path)
    root = json.loads((path / "zarr.json").read_text())
    refused = 0
    for what, attrs in edits(root["attributes"]):
        (path / "zarr.json").write_text(json.dumps({**root, "attributes": attrs}))
        try:
            tehl.open(path)
        except tehl.StoreError as error:
            assert one_sentence(str(error)), (what, error)
            refused += 1
        for words in (("show", path), ("show", path, "--json"), ("compare", path, whole)) if what in THRICE else ():
            found = here(*words)
            assert found.returncode in (0, 2), (what, words, found.stderr)
            assert found.returncode == 0 or one_sentence(found.stderr), (what, words, found.stderr)
    assert refused > 20


@pytest.mark.parametrize("part", ["steady", "grid", "fatigue.below", "transient.error", "wall_s", "steady.h_c_m", "work",
                                  "fatigue.Fi_max", "warnings", "left_out", "clamps", "domain", "warning_codes",
                                  "steady.error_parts", "steady.error_parts.h_c_m", "steady.error_parts.h_c_m.domain"])
def test_a_summary_with_an_edited_part(whole, tmp_path, part):
    path = tmp_path / "edited.zarr"
    shutil.copytree(whole, path)
    root = json.loads((path / "zarr.json").read_text())
    for wrong in ("x", [1], {"a": 1}, 3):
        summary = json.loads(root["attributes"]["summary"])
        *above, name = part.split(".")
        table = summary
        for one in above:
            table = table[one]
        if type(table[name]) is type(wrong) or (isinstance(table[name], float) and wrong == 3):
            continue
        table[name] = wrong
        attrs = {**root["attributes"], "summary": json.dumps(summary)}
        (path / "zarr.json").write_text(json.dumps({**root, "attributes": attrs}))
        found = here("show", path)
        assert found.returncode == 2 and f"'{part}'" in found.stderr and one_sentence(found.stderr), (part, wrong, found.stderr)


def test_the_summary_of_a_run_is_whole(whole):
    from tehl_taichi.store.reader import Reader

    attrs = Reader.open(whole).attrs
    assert attributes.invalid_attribute(attrs, True) == ""
    short = ('{"scene": "gear", "version": "1", "wall_s": 1, "compile_s": 1, "steps": 3, "grid": {}, "cells": {}, "hertz": {}, '
             '"left_out": []}')
    assert "'steady' is missing" in attributes.invalid_attribute({**attrs, "summary": short}, True)


@pytest.mark.parametrize("key, name", [("rheology.law", "mine"), ("oil.viscosity", "cameron"), ("fatigue.criterion", "ellipse"),
                                       ("feature.shape", "plateau")])
def test_what_is_not_installed_is_no_damage(tmp_path, key, name):
    """A store with a law of its own names the law where something would be computed."""
    path = store(tmp_path / "a.zarr").path
    root = json.loads((path / "zarr.json").read_text())
    data, (section, entry) = json.loads(root["attributes"]["scene"]), key.split(".")
    (data[section][0] if section == "feature" else data[section])[entry] = name
    root["attributes"]["scene"] = json.dumps(data)
    (path / "zarr.json").write_text(json.dumps(root))
    found = here("resume", path)
    assert found.returncode == 2 and f"needs {key} = '{name}', which is not installed here; known: " in found.stderr
    assert "damaged" not in found.stderr
    assert integrity.missing_choice(json.dumps(data))
    assert integrity.missing_choice(json.dumps(tehl.scene("gear").to_dict())) == ""


def test_the_plan_of_a_study_with_an_edited_attribute(tmp_path):
    sweeping.run(plan(GEAR, {"srr": [0.1, 0.2]}), tmp_path / "s.zarr", workers=1, work=made_up)
    file = tmp_path / "s.zarr" / "zarr.json"
    root = json.loads(file.read_text())
    told = json.loads(root["attributes"]["study"])
    plans = [*WRONG, *(json.dumps({**told, name: wrong}) for name in told for wrong in (None, 3, "x", [], [1], {"a": 1}))]
    for wrong in plans:
        file.write_text(json.dumps({**root, "attributes": {"study": wrong}}))
        found = here("show", tmp_path / "s.zarr")
        assert found.returncode in (0, 2) and (found.returncode == 0 or one_sentence(found.stderr)), (wrong, found.stderr)
    told["scene"]["rheology"]["law"] = "mine"
    file.write_text(json.dumps({**root, "attributes": {"study": json.dumps(told)}}))
    assert "needs rheology.law = 'mine'" in here("show", tmp_path / "s.zarr").stderr


def test_records_of_cases_that_were_edited_are_left_out(tmp_path):
    sweeping.run(plan(GEAR, {"srr": [0.1, 0.2]}), tmp_path / "s.zarr", workers=1, work=made_up)
    file = tmp_path / "s.zarr" / "cases.jsonl"
    lines = [json.loads(line) for line in file.read_text().splitlines()]
    assert len(lines) == 2
    for wrong in ("null", "3", "[]", '{"case": "0"}', '{"case": 0, "status": "odd"}', '{"case": true}', "{"):
        file.write_text(f"{json.dumps(lines[0])}\n{wrong}\n")
        assert [one["case"] for one in case_records.read(tmp_path / "s.zarr")] == [0]
        assert here("show", tmp_path / "s.zarr").returncode == 0


@pytest.mark.parametrize("words, said", [
    ("run gear --x-min -4", "No such option: --x-min; did you mean --set grid.x_min=...?"),
    ("sweep gear --table x.csv", "No such option: --table; did you mean --set fatigue.table=... or --set oil.table=...?"),
    ("run --lenght 4", "No such option: --lenght (Possible options: --height, --set)"),
    ("show s.zarr --x-min 3", "No such option: --x-min ")])
def test_keys_of_a_scene_typed_as_options_are_named(words, said):
    done = here(*words.split())
    assert done.returncode == 2
    assert said in re.sub(r"[\s│]+", " ", done.stderr + done.stdout)


def test_an_error_of_python_without_plugins_names_none():
    import tehl_cli.entry

    import tehl_taichi.values.plugins  # noqa: F401  as every command loads it

    assert tehl_cli.entry._sentence(OverflowError("too large")) == "too large"


@pytest.mark.parametrize("words, said", [
    ("run gear --dry-run --load 0", "--load 0 is out of range"),
    ("run gear --dry-run --load 0N/mm", "--load 0N/mm is out of range: a contact needs a load"),
    ("run gear --dry-run --set contact.load=0.0kN/m", "--set contact.load=0.0kN/m is out of range: a contact needs a load"),
    ("run gear --dry-run --hertz-pressure 0", "--hertz-pressure 0 is out of range: a contact needs a load"),
    ("sweep mtm --dry-run --over load=0,9", "load = 0 is out of range"),
    ("run gear --dry-run --set contact.moes_M=0", "contact.moes_M=0 is out of range"),
    ("run gear --dry-run --torsion-limit 0", "--torsion-limit 0 is out of range; allowed: more than 0"),
    ("fatigue a.zarr --bending-limit 0MPa", "--bending-limit 0 MPa is out"), ("fatigue a.zarr --inclusion 0", "more than 0"),
    ("bearing 6206 --scan a.csv --pixel 0", "--pixel = 0 m is out of range; allowed: more than 0 m"),
    ("new a.toml --scan a.csv --pixel-y 0", "--pixel-y = 0 m is out of"), ("bearing 6206 --balls 0", "allowed: 3 to 1000")])
def test_a_zero_is_no_missing_value(tmp_path, monkeypatch, words, said):
    monkeypatch.chdir(tmp_path)
    Path("a.csv").write_text("0,1\n1,2\n")
    done = here(*words.split())
    assert done.returncode == 2 and said in " ".join(done.stderr.split())


@pytest.mark.parametrize("command", ["resume", "zoom --factor 0", "zoom --factor auto"])
def test_threads_are_checked_where_nothing_is_left_to_compute(tmp_path, command):
    made_results.run(tmp_path / "a.zarr")
    found = here(*command.split(), tmp_path / "a.zarr", "--threads", 0)
    assert (found.returncode, found.stderr) == (2, "tehl: threads = 0 is out of range; allowed: 1 to 1024\n")
    for call in (tehl.resume, tehl.zoom):
        with pytest.raises(tehl.RuntimeUnavailable, match="threads = -1 is out of range"):
            call(tmp_path / "a.zarr", threads=-1)


@pytest.mark.parametrize("option", ["--workers", "--threads"])
def test_processes_and_threads_are_checked_where_a_bearing_runs_nothing(tmp_path, option):
    found = here("bearing", "6206", "--no-run", option, 0, cwd=tmp_path)
    assert found.returncode == 2 and found.stderr.endswith(f"tehl: {option} = 0 is out of range; allowed: 1 to 1024\n")
    assert not any(tmp_path.iterdir())


def test_a_misspelt_grid_is_answered_with_the_nearest_one():
    assert "did you mean 'coarse'?" in here("run", "gear", "--dry-run", "--grid", "corse").stderr


def test_a_load_of_zero_is_refused_in_a_traction_curve():
    from tehl_taichi.runs.traction.traction_run import traction_plan

    with pytest.raises(tehl.SceneError, match="contact.load = 0 in all cases is out of range"):
        traction_plan(tehl.scene("mtm"), load=0)


def test_a_load_of_zero_beside_another_load_removes_none():
    for zero in (0.0, "0 N/mm", "-0.0 kN/m"):
        assert tehl.scene("gear").replace(load=zero, hertz_pressure=1e9).contact.hertz_pressure == 1e9
