"""Every command that README.md and docs/*.md show runs through the command line.

In a form that takes a second where the real one takes long (SHORT says which): a coarse grid and no step in time for `run`,
the plan alone for `sweep`, one position at rest for `flank`, loads alone for `bearing`, a coarse
grid for `traction`, one step for `resume`, two frames for `animate`. The suites of `bench` are stopped where they would begin
to compute: tests/profiles/test_bench_commands.py lets them compute.
"""

import re
import shlex
import shutil
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from commands import here

import tehl_taichi as tehl
from tehl_taichi.errors import Error

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
SMALL = "--grid 64x16 --isothermal --no-fatigue --no-estimate-error --quiet"
SHORT = {"run": f"{SMALL} --steps 0 --force --out made.zarr", "sweep": "--dry-run --out plan.zarr",
         "flank": "--grid 64 --isothermal --steady --no-figure", "bearing": "--no-run --no-figure",
         "traction": "--grid 64x16 --isothermal --no-figure --workers 1",
         "roller": "--no-run --no-figure", "cam": "--grid 64 --isothermal --no-figure --workers 1",
         "resume": "--steps 1 --quiet", "zoom": "--factor 0 --quiet", "animate": "--frames 2 --dpi 40 --force",
         "plot": "--dpi 40 --force",
         "crack": "--dpi 40", "fatigue": "--dpi 40", "compare": "--force",
         "report": "--force", "export": "--force"}
AT_REST = "--isothermal --steps 0 --no-fatigue --no-estimate-error --quiet --force --set time.steady_only=true"
FENCED = re.compile(r"^```\w*\n(.*?)^```", re.M | re.S)
FILLED = {"STORE": "runs/gear-1.zarr", "STUDY": "runs/heights.zarr", "NEW": "new.zarr", "NAME": "dent", "N": "1",
          "K": "0.3", "COMMAND": "run"}
WITH = {"mp4": shutil.which("ffmpeg"), "netcdf": find_spec("xarray"), "--scheduler": find_spec("distributed")}  # what they need
SUITES = {"accuracy": "accuracy.run", "speed": "speed.run", "scaling": "scaling.run", "stability": "stability.run",
          "conclusions": "conclusions.run", "verdict": "verdict.run", "cracks": "cracks.run", "zoom": "zoom.run",
          "sweep": "side_by_side.run", "profile": "measure.fresh"}


def commands_of(page):
    """Whole commands of a page, in its order, as words; those of which the text shows a part only are left out."""
    text = page.read_text(encoding="utf-8")
    lines = [line.partition("  #")[0] for block in FENCED.findall(text) for line in block.splitlines() if line[:5] == "tehl "]
    lines += [" ".join(one.split()) for one in re.findall(r"`(tehl [^`]+)`", FENCED.sub("", text))]
    for line in dict.fromkeys(lines):
        words = shlex.split(line)[1:]
        part = "…" in line or " ... " in line or words[-1] == "--set" or words[1:] == ["--json"]
        if len(words) > 1 and not part:
            yield from alternatives([FILLED.get(word, word) for word in words])


def alternatives(words):
    """One command for each of csv|netcdf|vtk."""
    several = [word.split("|") for word in words if "|" in word]
    return [[choice if "|" in word else word for word in words] for choice in several[0]] if several else [words]


SHOWN = list({tuple(words): (page.name, words) for page in PAGES for words in commands_of(page)}.values())


def test_the_pages_show_commands():
    assert len(SHOWN) > 60 and {words[0] for _, words in SHOWN} >= {"run", "plot", "sweep", "flank", "bench", "crack", "export"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory, taichi_cpu):
    """What the pages have made before: four runs, a study, a flank, a scan with its scene, a table of positions."""
    import made_results

    place = tmp_path_factory.mktemp("pages")
    coarse = SMALL.replace(" --no-fatigue", "").replace("64x16", "32x8")  # few points to search, and half of the moments
    run = ("run", "gear", *coarse.split(), "--set", "time.courant=2")
    assert here(*run, "--out", "runs/gear-1.zarr", cwd=place).returncode == 0
    shutil.copytree(place / "runs" / "gear-1.zarr", place / "runs" / "gear.zarr")
    deep = ("--steps", 3, "--set", "fatigue.depths=[40e-6]", "--out", "runs/furrow.zarr")
    assert here(*run, *deep, cwd=place).returncode == 0
    glass = ("run", "ball-on-glass", *SMALL.split(), "--steps", 0, "--out", "runs/glass.zarr")
    assert here(*glass, cwd=place).returncode == 0
    shutil.copytree(place / "runs" / "glass.zarr", place / "runs" / "ball-on-glass-1.zarr")
    made_results.flank(place / "runs" / "fzg-c-1")
    _study(place)
    heights = 1e-1 * np.sin(np.arange(60) / 9.0)[:, None] * np.cos(np.arange(80) / 7.0)
    np.savetxt(place / "scan.csv", heights, delimiter=",")
    (place / "case.csv").write_text("depth_mm,hardness_HV\n0,700\n1.5,400\n")
    np.savetxt(place / "profile.csv", 1e-1 * np.sin(np.arange(300) / 40.0))
    (place / "cam.csv").write_text("angle_deg,load_N_per_mm,R_mm,u_a_m_s,u_b_m_s\n0,150,12,3,1\n")
    pair = tehl.flank("fzg-c", at=["C"], steady=True, changes={"grid.nx": 64, "thermal.on": False}, folder=place / "one")
    p = pair.positions[0]
    (place / "table.csv").write_text("x_pl_mm,R_a_mm,R_b_mm,u_a_m_s,u_b_m_s,load_N_per_mm\n"
                                     f"0,{1e3 * p.rho_a},{1e3 * p.rho_b},{p.u_a},{p.u_b},{1e-3 * p.load}\n")
    return place


def _study(place):
    from tehl_taichi.runs.sweep import sweeping
    from tehl_taichi.runs.sweep.plan import plan

    def work(job, progress=None):
        summary = {"steady": {"h_c_m": 1e-7 * (2 + job.scene.operation.srr)}, "fatigue": {"Fi_max": 0.5}}
        return {"status": "converged", "reason": "", "summary": summary, "seconds": 1.0}

    scene = tehl.scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16})
    for name in ("heights", "gear-sweep-0a1b2c"):
        sweeping.run(plan(scene, {"srr": [-0.1, 0.1]}), place / "runs" / f"{name}.zarr", workers=1, keep="summary", work=work)
    (place / "study.toml").write_text('scene = "gear"\n[over]\nsrr = [-0.1, 0.1]\n')


def shortened(words, folder):
    """The command in the form that takes a second, with the files that its page has made before."""
    if words[0] == "new":
        (folder / words[1]).unlink(missing_ok=True)
    for name, file in (("my.toml", ""), ("my_flank.toml", "scan.csv"), ("my_profile.toml", "profile.csv")):
        if name in words[1:2] and words[0] != "new" and not (folder / name).exists():
            scan = ("--scan", file, "--unit", "um", "--pixel", "1.8e-6") if file else ()
            assert here("new", name, *scan, cwd=folder).returncode == 0
    if "my_flank.zarr" in words and words[0] != "run" and not (folder / "my_flank.zarr").exists():
        shutil.copytree(folder / "runs" / "gear-1.zarr", folder / "my_flank.zarr")
    if "oil.alpha_40=18e-9,22e-9,26e-9" in words:  # of a scene file whose [oil] is a data sheet
        words = [*words, "--set", "oil.nu_40=220e-6", "--set", "oil.nu_100=19e-6", "--set", "oil.rho_15=890"]
    if words[:1] == ["run"] and "--target-error" in words:
        return with_options(words, AT_REST.split())
    if words == ["compare", FILLED["STORE"], FILLED["STORE"]]:
        words = ["compare", FILLED["STORE"], "runs/gear.zarr"]
    return [*with_options(words, SHORT.get(words[0], "").split()), *(("--at", "C") if words[:2] == ["flank", "fzg-c"] else ())]


def with_options(words, more):
    """The words with more options, in place of those of the same names and their values."""
    names = {word for word in more if word[:2] == "--"} - {"--set"}
    kept = [word for before, word in zip(["", *words], words)
            if word not in names and (before not in names or word[:2] == "--")]
    return [*kept, *more]


def marked():
    """The commands but those of bench; of each that draws for seconds the first is quick, the others are slow."""
    seen = set()
    for page, words in SHOWN:
        drawn = words[0] if words[0] in ("plot", "crack", "animate") else "figures" if "--figures" in words else ""
        sized = words[0] == "run" and "--target-error" in words  # kernels of its grid; tests/cli/test_cli.py chooses one
        slow = (pytest.mark.slow,) if drawn in seen or sized else ()
        seen |= {drawn} - {""}
        if words[0] != "bench":
            yield pytest.param(words, marks=slow, id=f"{page}: {' '.join(words)}")


@pytest.mark.parametrize("words", marked())
def test_a_command_of_the_pages_runs(words, folder, monkeypatch, without_library):
    opened = []
    monkeypatch.setattr("typer.launch", lambda url: opened.append(url) or True)
    found = here(*shortened(words, folder), cwd=folder)
    lacking = [need for word, need in WITH.items() if any(word in one for one in words) and not need]
    assert found.returncode == (2 if lacking else 0), found.stderr
    assert found.stdout or lacking or words[0] in ("run", "resume", "flank")
    assert bool(opened) == ("--open" in words)


@pytest.mark.parametrize("words", [words for _, words in SHOWN if words[0] == "bench"], ids=" ".join)
def test_a_suite_of_the_pages_begins(words, tmp_path, monkeypatch):
    """With the options that the page gives it."""
    def begun(*args, **options):
        raise Error("it would compute now")

    for place in (*SUITES.values(), "confirmed_starts.confirm", "zoomed_conclusions.run"):
        monkeypatch.setattr(f"tehl_taichi.profiles.{place}", begun)
    monkeypatch.setattr("tehl_taichi.engine.runtime.start", lambda **settings: None)
    monkeypatch.setattr("tehl_taichi.profiles.stability_scenes.cases", lambda thermal=False: {})
    drawn = {"random 0 line": tehl.scene("smooth-line")}
    monkeypatch.setattr("tehl_taichi.profiles.stability_scenes.random_cases", lambda count, seed: drawn)
    found = here(*words, "--out", tmp_path)
    assert found.returncode == 1 and found.stderr.endswith("tehl: it would compute now\n")
