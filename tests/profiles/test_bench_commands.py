"""Every suite of `tehl bench` through the command line: its table, its `--json`, its files and its picture.

Fast: in this process, where a suite would start others, on its smallest grids. Slow: `--quick` as it is typed.
"""

import json
import math
from pathlib import Path

import pytest
from commands import here, process
from tehl_cli import bench_page
from tehl_taichi.profiles import (
    accuracy,
    conclusions,
    confirmed_starts,
    coverage,
    cracks,
    measure,
    profile,
    scaling,
    side_by_side,
    speed,
    stability,
    stability_scenes,
    verdict,
    zoom,
)

from tehl_taichi.runs.sweep import sweeping, warm_cache
from tehl_taichi.scene import SceneError, scene

ROOT = Path(__file__).parents[2]
PNG = b"\x89PNG\r\n\x1a\n"


@pytest.fixture(autouse=True)
def wide(monkeypatch, taichi_cpu):
    """Tables are not broken, and what would run in a new process runs in this one."""
    monkeypatch.setenv("COLUMNS", "400")


@pytest.fixture
def direct(monkeypatch):
    monkeypatch.setattr(measure, "fresh", lambda threads, function, *args: function(*args))


def once(monkeypatch, suite, name="run"):
    """The suite computes the first time and gives the same again."""
    kept, work = [], getattr(suite, name)

    def run(*args, **options):
        if not kept:
            kept.append(work(*args, **options))
            kept[0] = kept[0] if isinstance(kept[0], (list, tuple)) else list(kept[0])
        return kept[0]

    monkeypatch.setattr(suite, name, run)


def done(folder, name, *words):
    """(what is printed, what the file holds) of a suite that was run twice, with a table and with `--json`."""
    table = here("bench", *words, "--out", folder)
    assert table.returncode == 0, table.stderr
    image = (folder / f"{name}.png").read_bytes()
    assert image.startswith(PNG) and len(image) > 5000
    (folder / f"{name}.png").unlink()
    refused = here("bench", *words, "--out", folder)
    assert refused.returncode == 2 and f"{name}.json exists already" in refused.stderr and not refused.stdout
    found = here("bench", *words, "--out", folder, "--json", "--force")
    assert found.returncode == 0, found.stderr
    printed, kept = json.loads(found.stdout), json.loads((folder / f"{name}.json").read_text())
    assert printed == kept and kept["rows"] and kept["machine"] == measure.machine()
    assert (folder / f"{name}.png").exists()
    return table.stdout, kept


def lines_with(text, *words):
    """Rows of a table that hold all of these cells."""
    cells = [[cell.strip() for cell in line.split("│")] for line in text.splitlines()]
    return [row for row in cells if all(word in row for word in words)]


@pytest.mark.slow
def test_profile(tmp_path, monkeypatch):
    """In a process of its own: kernels must be bound while they are watched."""
    once(monkeypatch, measure, "fresh")
    text, found = done(tmp_path, "profile", "profile", "--quick", "--isothermal", "--threads", 2)
    stages, kernels = ([row for row in found["rows"] if row["kind"] == kind] for kind in ("stage", "kernel"))
    assert {"linear_solve", "trust", "laws", "residual"} <= {row["what"] for row in kernels}
    for row in found["rows"]:
        assert all(type(value) in (str, float, int) for value in row.values()), row
        assert lines_with(text, row["what"], f"{row['calls']:.1f}", f"{row['ms']:.2f}"), row
    nodes = (profile.QUICK[0] + 1) * (profile.QUICK[1] + 1)
    trusted = next(row for row in kernels if row["what"] == "trust")
    assert 1e6 * trusted["MB"] / trusted["calls"] > nodes * (8 * 4 + 8)  # four guesses, what they missed (f32), the pressure
    assert 0 < found["compile_s"] < found["start_s"] + found["first_step_s"] + 1
    times = [row["ms"] for row in stages]
    assert times == sorted(times, reverse=True) and 0 < times[0] <= 1.05e3 * found["step_s"]
    assert sum(row["ms"] for row in kernels) < 1e3 * found["step_s"]
    assert "energy" not in {row["what"] for row in kernels}
    assert {"pressure: Newton", "pressure: deflection"} <= {row["what"] for row in stages}
    limits = {row["what"]: row["limit_ms"] for row in found["rows"] if "limit_ms" in row}
    assert {"pressure: deflection", "linearise"} <= limits.keys() and min(limits.values()) > 0
    assert len(profile.gaps(stages, kernels, 3)) == 3


def test_a_suite_replaces_its_table_in_the_page_and_nothing_else(tmp_path, monkeypatch):
    row = {"nx": 64, "ny": 16, "threads": 1, "step_ms": 7.13, "speed_up": 1.0, "node_ns": 6450.0, "newton": 2.0, "cycles": 15.5,
           "memory_mb": 180.0, "node_B": None}  # as test_scaling computes them
    monkeypatch.setattr(scaling, "run", lambda *_: [row, {**row, "threads": 2}])
    words = ("bench", "scaling", "--quick", "--threads", 2, "--write", "--out", tmp_path / "out")
    refused = here(*words, cwd=tmp_path)
    assert refused.returncode == 2 and "cannot read docs/performance.md" in refused.stderr and not (tmp_path / "out").exists()
    page = tmp_path / "docs" / "performance.md"
    page.parent.mkdir()
    before = (ROOT / "docs" / "performance.md").read_text(encoding="utf-8")
    page.write_text(before.replace("<!-- bench: scaling -->", ""), encoding="utf-8")
    refused = here(*words, cwd=tmp_path)
    assert refused.returncode == 2 and "has no table of this suite: <!-- bench: scaling -->" in refused.stderr
    page.write_text(before, encoding="utf-8")
    done = here(*words, cwd=tmp_path)
    assert done.returncode == 0 and "wrote docs/performance.md" in done.stderr, done.stderr
    (head, old, tail), (new_head, new, new_tail) = (parted(text) for text in (before, page.read_text(encoding="utf-8")))
    assert (head, tail) == (new_head, new_tail) and old != new
    assert new.startswith("\n`tehl bench scaling --quick --threads 2`, version ") and "commit" in new
    titles, _, *lines = (line for line in new.splitlines() if line.startswith("|"))
    assert titles.startswith("| nx | ny | threads | step_ms |")
    assert lines == [f"| 64 | 16 | {threads} | 7.1 | 1.00 | 6450 | 2.0 | 15.5 | 180 |  |" for threads in (1, 2)]


def test_a_single_scene_replaces_its_rows_of_the_verdict_table_alone(tmp_path, monkeypatch):
    def rows(name, *_):
        return [verdict.VerdictRow(name, "case", 0.5, 0.6, 2e-5, {"Fi_surface": 0.01, "Fi_below": 0.02}, "a", (4e8, 4e8))]

    monkeypatch.setattr(verdict, "rows", rows)
    page, marks = tmp_path / "docs" / "strength.md", ("<!-- bench: verdict -->", "<!-- bench end -->")
    page.parent.mkdir()
    old = "| 1.5 µm dent | as it is | b | 0.73 | 1.2 | 177 | 400 |\n| 1.5 µm dent | case profile | | | | | |\n"
    page.write_text(f"before\n{marks[0]}\n\n| scene | variant |\n|---|---|\n{old}{marks[1]}\nafter", encoding="utf-8")
    words = ("bench", "verdict", "--write", "--out", tmp_path / "out", "--force")
    refused = here(*words, "--only", "ball", cwd=tmp_path)
    assert refused.returncode == 2 and "--only = 'ball' is not known" in refused.stderr
    for name in ("dent", "rough-pair", "dent:case"):
        done = here(*words, "--only", name, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
    lines = page.read_text(encoding="utf-8").splitlines()
    assert (lines[0], lines[-1]) == ("before", "after") and "Other rows are of an earlier command." in " ".join(lines)
    assert [line for line in lines if line.startswith("| 1.5 µm dent") or "ground" in line] == [
        "| 1.5 µm dent | as it is | b | 0.73 | 1.2 | 177 | 400 |",
        "| 1.5 µm dent | case profile | a | 0.500 ± 0.010 | 0.600 ± 0.020 | 20 | 400 |",
        "| ground flanks, 99th percentile | case profile | a | 0.500 ± 0.010 | 0.600 ± 0.020 | 20 | 400 |"]


def parted(text):
    """What stands before, in and behind the table of the suite `scaling` in the page."""
    head, rest = text.split("<!-- bench: scaling -->")
    old, tail = rest.split("<!-- bench end -->", 1)
    return head, old, tail


@pytest.mark.parametrize("name", ["accuracy", "coverage", "stability", "speed", "scaling", "profile", "verdict", "zoom"])
def test_the_page_has_a_place_for_every_suite_that_writes_one(name, monkeypatch):
    monkeypatch.chdir(ROOT)
    bench_page.check(name)


def test_scaling(tmp_path, monkeypatch, direct):
    once(monkeypatch, scaling)
    text, found = done(tmp_path, "scaling", "scaling", "--quick", "--threads", 2)
    assert [(row["nx"], row["threads"]) for row in found["rows"]] == [(nx, n) for nx in scaling.QUICK_COLUMNS for n in (1, 2)]
    for row in found["rows"]:
        assert row["node_ns"] == pytest.approx(1e6 * row["step_ms"] / ((row["nx"] + 1) * (row["ny"] + 1)))
        assert lines_with(text, str(row["nx"]), str(row["threads"]), f"{row['step_ms']:.1f}", f"{row['speed_up']:.2f}",
                          f"{row['node_ns']:.0f}", f"{row['memory_mb']:.0f}")


def test_speed(tmp_path, monkeypatch, direct):
    once(monkeypatch, speed)
    monkeypatch.setattr(speed, "command", lambda *words, **options: 1.5)  # a process of its own
    monkeypatch.setattr(speed, "PASSAGES", (("isothermal", None, None),))
    assert speed.circular(64).contact.kind == "point" and speed.circular(64).grid.nx == 64
    line = scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16, "time.steady_only": True})
    monkeypatch.setattr(speed, "circular", lambda columns: line)  # whose kernels the passages have compiled
    text, found = done(tmp_path, "speed", "speed", "--quick", "--threads", 2)
    names = [row["what"].split(",")[0].split(":")[0] for row in found["rows"]]
    assert names == ["reference", "reference", "isothermal passage 64x16", "first step of tehl run", "isothermal passage 64x16",
                     "steady circular contact 64 columns", "Findley search 500 points x 100 moments"]
    for row in found["rows"]:
        line, = lines_with(text, row["what"])
        assert f"{row['seconds']:.3f}" in line and row["seconds"] > 0 and row["target"] is None
        assert "step_ms" not in row or any(f"step {row['step_ms']:.1f} ms" in cell for cell in line)


def test_speed_with_targets_is_drawn_in_units_of_them():
    plt = pytest.importorskip("matplotlib.pyplot")
    rows = [{"what": "a", "seconds": 2.0, "target": 4.0}, {"what": "b", "seconds": 3.0, "target": 1.0},
            {"what": "c", "seconds": 9.0, "target": None}]
    ax = speed.chart(plt, rows).axes[0]
    assert [bar.get_width() for bar in ax.patches] == [0.5, 3.0] and ax.get_xlabel() == "time / target"
    assert ax.patches[0].get_facecolor() != ax.patches[1].get_facecolor()
    ax = speed.chart(plt, rows[2:]).axes[0]
    assert [bar.get_width() for bar in ax.patches] == [9.0] and ax.get_xlabel() == "time, s"


def test_stability(tmp_path, monkeypatch):
    once(monkeypatch, stability)
    small = scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16, "time.steps": 2})
    drawn, rough = {"drawn 2 5": small, "drawn": SceneError("no")}, {"rough drawn": small.replace(height=1e-6)}
    monkeypatch.setattr(stability_scenes, "random_cases", lambda count, seed: drawn if (count, seed) == (2, 5) else {})
    monkeypatch.setattr(stability_scenes, "rough_cases", lambda count, seed: rough if (count, seed) == (1, 5) else {})
    words = ("stability", "--quick", "--match", "drawn", "--random", 2, "--rough", 1, "--seed", 5, "--threads", 2)
    text, found = done(tmp_path, "stability", *words)
    verdicts = {row["name"]: row["verdict"] for row in found["rows"]}
    assert verdicts.pop("drawn 2 5") == verdicts.pop("rough drawn") == "converged"
    assert verdicts == {"drawn": "refused"}
    assert found["converged"] + found["refused"] + found["stopped"] == len(found["rows"]) and found["failed"] == 0
    for row in found["rows"]:
        assert lines_with(text, row["name"], row["verdict"], str(row["steps"]), f"{row['newton']:.1f}", f"{row['seconds']:.1f}")


def test_stability_ends_with_1_where_a_scene_fails(tmp_path, monkeypatch):
    bad = stability.CaseOutcome("bad one", "failed", "NaN at step 3", 3, 1.0, 5.0, 0.1)
    monkeypatch.setattr(stability, "run", lambda *words: [bad])
    monkeypatch.setattr(stability_scenes, "random_cases", lambda count, seed: {"bad one": scene("gear")})
    found = here("bench", "stability", "--match", "bad", "--out", tmp_path, "--json")
    assert found.returncode == 1 and json.loads(found.stdout)["failed"] == 1 and (tmp_path / "stability.png").exists()


def test_starts(tmp_path, monkeypatch):
    once(monkeypatch, confirmed_starts, "confirm")
    monkeypatch.setattr(stability, "starts", lambda chosen: dict(list(chosen.items())[:1]))
    monkeypatch.setattr(confirmed_starts, "_start", lambda description: (1e-6 * (1 + 1.0 / description.grid.nx), 100.0, False))
    text, found = done(tmp_path, "starts", "stability", "--confirm", "--quick", "--random", 0)
    row, = found["rows"]
    assert row["finer_film"] == pytest.approx(0.5 / row["columns"] / (1 + 1.0 / row["columns"])) and found["holds"] == 1
    assert lines_with(text, row["name"], str(row["columns"]), "0.00", f"{100 * row['finer_film']:.2f}")


@pytest.mark.slow
def test_sweep(tmp_path, monkeypatch):
    """On the two threads of this process in place of one of a new one."""
    once(monkeypatch, side_by_side)
    run = sweeping.run
    monkeypatch.setattr(sweeping, "run", lambda *words, **options: run(*words, **{**options, "threads_per_worker": 2}))
    monkeypatch.setattr(warm_cache, "ensure_kernels", lambda description: None)
    text, found = done(tmp_path, "sweep", "sweep", "--quick", "--workers", 1)
    row, = found["rows"]
    assert row["speed_up"] == 1.0 and 0 < row["cases_s"] <= row["seconds"]
    assert lines_with(text, "1", f"{row['seconds']:.1f}", f"{row['cases_s']:.1f}", "1.00")


def test_accuracy(tmp_path, monkeypatch, direct):
    monkeypatch.setattr(accuracy, "QUICK", {"steady line": (64, 128, 256)})
    monkeypatch.setattr(accuracy, "settings", lambda columns, names, say: [])
    monkeypatch.setattr(coverage, "QUICK", {"line, Moes": (1, (64,))})
    once(monkeypatch, accuracy)
    words = ("bench", "accuracy", "--quick", "--threads", 2, "--out", tmp_path)
    text = here(*words)
    assert text.returncode == 0, text.stderr
    again = here(*words, "--judge", "--only", "coverage", "--json", "--force")
    found = {"errors": json.loads((tmp_path / "accuracy.json").read_text())["rows"], **json.loads(again.stdout)}
    for name in ("accuracy", "coverage"):
        assert (tmp_path / f"{name}.png").read_bytes().startswith(PNG)
    for row in found["errors"]:
        shown = lines_with(text.stdout, row["family"], str(row["columns"]), f"{row['seconds']:.2f}")
        assert math.isfinite(row["error"]) and shown
    held = {row["quantity"]: row for row in found["coverage"]}
    assert held["all"]["bars"] == sum(row["bars"] for name, row in held.items() if name != "all")
    for name, row in held.items():
        known = (f"{100 * row['hold']:.1f}", f"{row['bar']:.2g}", f"{row['error']:.2g}") if row["bars"] else ()
        assert lines_with(text.stdout, name, str(row["bars"]), str(row["null"]), *known)
    as_json = here(*words, "--only", "errors", "--json", "--force")
    assert json.loads(as_json.stdout)["errors"] == found["errors"] and "│" not in as_json.stdout


def test_accuracy_judges_only_what_is_there(tmp_path):
    refused = here("bench", "accuracy", "--judge", "--only", "exits", "--threads", 2, "--out", tmp_path)
    assert refused.returncode == 2 and "exits.json" in refused.stderr and list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_verdict(tmp_path, monkeypatch):
    once(monkeypatch, verdict)
    monkeypatch.setattr(verdict, "QUICK", {"grid.nx": 32, "grid.ny": 8})
    text, found = done(tmp_path, "verdict", "verdict", "--quick", "--threads", 2)
    assert [row["variant"] for row in found["rows"]] == list(verdict.VARIANTS) and "case profile" in text
    assert "run-in" in found["note"] and "| residual stress" in (tmp_path / "verdict.md").read_text()


@pytest.mark.slow
def test_conclusions(tmp_path, monkeypatch):
    once(monkeypatch, conclusions)
    monkeypatch.setattr(conclusions, "SLIPS", (-0.12,))
    monkeypatch.setattr(conclusions, "QUICK_GRIDS", ((32, 8),))
    text, found = done(tmp_path, "conclusions", "conclusions", "--quick", "--threads", 2)
    cases = [(row["case"], row["body"]) for row in found["rows"]]
    assert cases == [(f"{kind}, SRR -0.12", body) for kind in conclusions.DECIDE for body in "ab"]
    assert {one["verdict"] for one in found["verdicts"]} <= {"follows", "does not follow", "not decided"}
    for row in found["rows"]:
        line = lines_with(text, row["case"])["ab".index(row["body"])]
        value, error = row["findley_stress_Pa"]["all; whole"]
        assert error is None and any(cell.startswith(f"{value / 1e6:.0f} (") for cell in line)
    assert "| follows |" not in text and (tmp_path / "conclusions.md").read_text().count("| asperity") >= 1


def test_cracks(tmp_path, monkeypatch):
    once(monkeypatch, cracks)
    monkeypatch.setattr(cracks, "SLIPS", {"dedendum": -0.12})
    monkeypatch.setattr(cracks, "QUICK_GRIDS", ((32, 8),))
    monkeypatch.setattr(cracks, "QUICK_CONDITIONS", {"": {"length": 20e-6}, "oil 0.3": {"length": 20e-6, "oil": 0.3}})
    text, found = done(tmp_path, "cracks", "cracks", "--quick", "--threads", 2)
    assert [(row["case"].rsplit(", ", 1)[-1], row["side"]) for row in found["rows"]] == [
        (name, side) for name in ("dedendum", "oil 0.3") for side in ("entry", "exit")]
    for row in found["rows"]:
        shown = [line for line in lines_with(text, row["case"], row["side"])]
        assert len(shown) == 1
        if row["numbers"]:
            assert any(cell.startswith(f"{row['numbers']['sigma1'][0] / 1e6:.0f} ± ?") for cell in shown[0])


def test_zoom(tmp_path, monkeypatch):
    once(monkeypatch, zoom)
    work = zoom.cases
    monkeypatch.setattr(zoom, "cases", lambda quick: {
        name: one.replace(**{"fatigue.surfaces": "a", "time.x_end": 0.2, "numerics.estimate_error": False})
        for name, one in work(quick).items()})
    text, found = done(tmp_path, "zoom", "zoom", "--quick", "--threads", 2)
    # no temperatures; cells longer than the material length
    at_points = ["p_max", "h_min", "h_middle", "Fi a, surface", "Fi a, below"]
    assert [row["number"] for row in found["rows"]] == at_points
    for row in found["rows"]:
        assert row["off"] == pytest.approx(abs(row["zoom"] / row["fine"] - 1))
        assert row["holds"] is (None if row["number"] == "h_middle" else True)  # only numbers of a summary have bars
    line, = lines_with(text, found["rows"][0]["case"])
    shown = [f"{row['fine']:.4g}: {row['zoom']:.4g} ({100 * row['off']:.2f})" for row in found["rows"]]
    assert all(cell in line for cell in shown[:3]) and not any(cell in line for cell in shown[3:])  # averaged ones alone
    for row in found["rows"][0], found["rows"][2]:
        assert row["off"] < 0.005 < abs(row["coarse"] / row["fine"] - 1)


QUICK = {"profile": 1, "scaling": 1, "speed": 1, "stability": 1, "sweep": None, "accuracy": 1, "conclusions": 1, "cracks": 1,
         "zoom": 1, "verdict": 1}


@pytest.mark.slow
@pytest.mark.parametrize("suite", QUICK)
def test_quick_as_it_is_typed(suite, tmp_path):
    threads = ("--threads", QUICK[suite]) if QUICK[suite] else ("--workers", 1)
    run = process("bench", suite, "--quick", *threads, "--out", "here", cwd=tmp_path)
    assert run.returncode == 0 and "│" in run.stdout, run.stderr
    names = {path.name for path in (tmp_path / "here").iterdir()}
    assert {f"{suite}.json", f"{suite}.png"} <= names and [path.name for path in tmp_path.iterdir()] == ["here"]


def test_every_suite_is_tested():
    from tehl_cli.main import app
    from typer.main import get_command

    assert set(get_command(app).commands["bench"].commands) == set(QUICK)


@pytest.mark.parametrize("words, said", [
    (("speed", "--threads", -3), "'-3'; input should be"), (("speed", "--threads", 0), "'0'; input should be"),
    (("profile", "--isothermal", "--threads", -1), "'-1'; input should be"),
    (("zoom", "--threads", 0), "'0'; input should be"),
    (("verdict", "--workers", 0), "'0'; input should be"), (("accuracy", "--seed", -1), "'-1'; input should be"),
    (("stability", "--random", -5), "'-5'; input should be"), (("stability", "--seed", -1), "'-1'; input should be"),
    (("stability", "--match", "nothing", "--random", 0), "--match 'nothing' is in the name of no scene"),
    (("stability", "--match", "nothing", "--starts", "--random", 0), "of no scene with temperatures")])
def test_numbers_and_names_without_work_are_refused(words, said, tmp_path):
    found = here("bench", words[0], "--quick", *words[1:], "--out", tmp_path / "out")
    assert found.returncode == 2 and said in " ".join(found.stderr.replace("│", " ").split()), found.stderr
    assert not (tmp_path / "out").exists()
