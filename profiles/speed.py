"""Speed: the project's targets, what is reached, and loops that any machine can be compared by, in one table."""

import os
import subprocess
import sys
import tempfile
import time

import numpy as np
from tehl_taichi.profiles import measure

from tehl_taichi.fatigue import findley
from tehl_taichi.scene import scene
from tehl_taichi.view.figures import palette

GRID, QUICK_GRID = (256, 64), (64, 16)
QUICK_STEPS = 4
PASSAGES = (("isothermal", 1, 10.0), ("isothermal", None, 4.0), ("thermal", 1, None), ("thermal", None, None))  # None: all


def run(quick=False, threads=4, progress=None):
    """Rows: dictionaries of what, seconds, target (s, None without), reference loops first. A passage also has its step in
    units of the first of them (convolutions): that figure compares between machines."""
    say = progress or (lambda text: None)
    nx, ny = QUICK_GRID if quick else GRID
    steps = QUICK_STEPS if quick else None
    rows = [*measure.fresh(1, references, nx, ny)]
    gear = scene("gear").replace(**{"grid.nx": nx, "grid.ny": ny})
    # targets hold for 256 x 64 cells
    for name, count, target in [one for one in PASSAGES if one[1] is None or not quick]:
        count = count or threads
        say(f"{name} passage, {nx} x {ny} cells, {count} threads")
        row = passage(f"{name} passage {nx}x{ny}, {count} threads", count, gear.replace(**{"thermal.on": name == "thermal"}),
                      steps, None if quick else target)
        rows.append({**row, "convolutions": 1e-3 * row["step_ms"] / rows[0]["seconds"]})
    if not quick:
        say(f"thermal passage, {2 * nx} x {2 * ny} cells, {threads} threads")
        rows.append(passage(f"thermal passage {2 * nx}x{2 * ny}, {threads} threads", threads,
                            gear.replace(**{"grid.nx": 2 * nx, "grid.ny": 2 * ny}), 12))  # of the inlet
    say("tehl run")
    rows += commands(nx, ny, threads, quick)
    rows.append(passage(f"isothermal passage {nx}x{ny}, 1 thread, linear solves in f64", 1,
                        gear.replace(**{"thermal.on": False, "numerics.precision": "f64"}), steps))
    for columns, target in ((64 if quick else 128, None), *(() if quick else ((256, 0.3), (512, 1.0)))):
        say(f"steady circular contact, {columns} columns, 1 thread")
        rows.append({"what": f"steady circular contact {columns} columns, 1 thread", "target": target,
                     "seconds": measure.fresh(1, measure.steady, circular(columns), 1 if quick else 3)})
    say("Findley search")
    points, moments = (500, 100) if quick else (257 * 65, 400)
    seconds, rate = measure.fresh(threads, search, points, moments)
    rows.append({"what": f"Findley search {points} points x {moments} moments, {threads} threads", "seconds": seconds,
                 "target": None if quick else 10.0, "planes_per_s_core": rate / threads})
    return rows


def passage(what, threads, description, steps, target=None):
    """Row of a passage in a process of its own; of a whole one after one that compiled its kernels."""
    if steps is None:
        measure.fresh(threads, measure.passage, description, 1)
    timing = measure.fresh(threads, measure.passage, description, steps)
    return {"what": what, "seconds": timing.passage_s, "target": target, "step_ms": 1e3 * timing.step_s,
            "newton": timing.newton, "cycles": timing.cycles, "memory_mb": timing.memory_mb}


def commands(nx, ny, threads, quick):
    """Whole commands, with the start of Python: until the first step is stored, without and with compiled kernels; passages
    with stresses and fatigue. Quick: the first step, with the kernels that this machine has."""
    base = ("--grid", f"{nx}x{ny}", "--threads", threads)
    first = (*base, "--steps", 1, "--no-fatigue")
    with tempfile.TemporaryDirectory() as folder:
        if quick:
            return [{"what": "first step of tehl run", "seconds": command(folder, *first, cache=None), "target": None}]
        found = [("first step of tehl run, nothing compiled", command(folder, *first), 10.0),
                 ("first step of tehl run, kernels compiled", command(folder, *first), 4.0)]
        for options, target in ((), None), (("--no-estimate-error",), 18.0), (("--isothermal", "--no-estimate-error"), 8.0):
            command(folder, *base, *options, "--steps", 3)  # its kernels
            found.append((" ".join(("tehl run", *options)) + f", {nx}x{ny}, {threads} threads",
                          float(np.median([command(folder, *base, *options) for _ in range(3)])), target))
    return [{"what": what, "seconds": value, "target": target} for what, value, target in found]


def command(folder, *words, cache="cache"):
    """Seconds of `tehl run gear` with these options; store and compiled kernels (cache: None: the usual ones) in `folder`."""
    words = ("run", "gear", "--quiet", "--force", "--out", f"{folder}/run.zarr", *map(str, words))
    call = [sys.executable, "-c", "from tehl_cli.main import main; main()", *words]
    started = time.perf_counter()
    cached = {"TEHL_CACHE": f"{folder}/{cache}"} if cache else {}
    subprocess.run(call, check=True, capture_output=True, env=os.environ | cached)
    return time.perf_counter() - started


def circular(columns):
    """Moes (200, 10) on half a domain of columns x columns/2 cells."""
    base = scene("ball-on-disc").replace(**{"grid.nx": columns, "grid.ny": columns // 2, "grid.x_min": -2.5,
                                            "grid.x_max": 1.5, "grid.y_max": 2.0})
    return base.replace(**{"oil.name": "moes-test-fluid", "contact.load": 0.0, "contact.moes_M": 200.0, "contact.moes_L": 10.0})


def references(nx, ny):
    """A plain FFT convolution of the deflection's size and a copy of 64 MB, one thread."""
    values, symbol = np.random.default_rng(0).standard_normal((2 * ny, 2 * nx)), np.ones((2 * ny, nx + 1))
    convolution = measure.median(lambda: np.fft.irfft2(np.fft.rfft2(values) * symbol, values.shape), 30)
    source, target = np.ones(2**23), np.empty(2**23)
    copy = measure.median(lambda: np.copyto(target, source), 10)
    return [{"what": f"reference: convolution {2 * nx}x{2 * ny} (numpy)", "seconds": convolution, "target": None},
            {"what": f"reference: copy, {2 * source.nbytes / copy / 1e9:.1f} GB/s", "seconds": copy, "target": None}]


def search(points, moments):
    """Median time of the Findley search of passing load histories, and points x planes decided x moments in a second."""
    rng, t = np.random.default_rng(1), np.linspace(-2, 2, moments)
    centre, width = rng.uniform(-0.3, 0.3, (points, 1)), rng.uniform(0.5, 1.0, (points, 1))
    pressure = 2e9 * np.sqrt(np.maximum(1 - ((t - centre) / width) ** 2, 0))
    history = np.zeros((points, moments, 6))
    for n, share in enumerate((-0.8, -0.7, -1.0, 0.05, 0.07, 0.03)):
        history[..., n] = share * pressure * (1 + 0.3 * np.sin(3 * t + n + centre * (n + 1)))
    decided = np.zeros(points)
    seconds = measure.median(lambda: findley.search(history, 0.3, decided=decided), 3)
    return seconds, decided.sum() * moments / seconds


def chart(plt, rows):
    """Bars of the times that have a target, in units of it; of all times where none has."""
    shown = [row for row in rows if row.get("target")]
    units = [row["target"] for row in shown] or [1.0] * len(rows)
    shown, label = (shown, "time / target") if shown else (rows, "time, s")
    figure, ax = plt.subplots(figsize=(8, 0.6 * len(shown) + 1.2), constrained_layout=True)
    ratios = [row["seconds"] / unit for row, unit in zip(shown, units)]
    beyond = [ratio > 1 and label == "time / target" for ratio in ratios]
    ax.barh([row["what"] for row in shown], ratios, color=[palette.ORANGE if one else palette.GREEN for one in beyond])
    if label == "time / target":
        ax.axvline(1, color=palette.BLACK, lw=0.8)
    ax.set(xlabel=label, xscale="log", title=measure.machine())
    ax.invert_yaxis()
    return figure
