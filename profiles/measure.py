"""Shared parts of the suites: timings of a passage, fresh processes with a given number of threads, results as files."""

import json
import multiprocessing
import os
import platform
import resource
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tehl_taichi.disk import user_files
from tehl_taichi.engine import runtime
from tehl_taichi.march.passage import march, total_steps
from tehl_taichi.runs.sweep import pool
from tehl_taichi.store.json_values import plain

# of runs whose suite works out fatigue and errors itself, for all grids and loads together
BARE = {"fatigue.on": False, "numerics.estimate_error": False}


@dataclass(frozen=True)
class Timing:
    """Times of one passage: steady start, median step and whole passage in s, Newton and Krylov a step, MB of memory."""

    start_s: float
    step_s: float
    passage_s: float
    newton: float
    cycles: float
    memory_mb: float


def fresh(threads, function, *args):
    """function(*args) in a new process whose Taichi runs on `threads` threads, or on the card that TEHL_ARCH names."""
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, mp_context=spawn, initializer=runtime.start, initargs=(None, threads)) as process:
        return process.submit(function, *args).result()


def passage(description, steps=None):
    """Timing of `steps` steps after two for warming up, the others taken to be like them; of all steps without a number."""
    whole = total_steps(description)
    run = march(description.replace(**{"time.steps": steps + 2}) if steps else description)
    started = time.perf_counter()
    next(run)
    start_s, shots, seconds = time.perf_counter() - started, [], []
    for _ in range(steps + 2 if steps else whole):
        started = time.perf_counter()
        shots.append(next(run).scalars)
        seconds.append(time.perf_counter() - started)
    step = float(np.median(seconds[2:]))
    newton, cycles = (float(np.mean([shot[key] for shot in shots[2:]])) for key in ("newton", "cycles"))
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return Timing(start_s, step, start_s + (whole * step if steps else sum(seconds)), newton, cycles, memory)


def side_by_side(work, jobs, workers=1, threads=None):
    """Generator of (number of the job, work(*job) or :class:`tehl_taichi.runs.sweep.pool.LostJob`), in the order in which they
    end; workers: processes, each on `threads` threads (None: all that are left)."""
    workers, threads = pool.sizes(workers, threads)
    return pool.results(_worked, [(work, threads, job) for job in jobs], workers=workers)


def _worked(job):
    work, threads, job = job
    runtime.start_or_join(threads=threads)
    return work(*job)


def steady(description, repeats):
    """Median time (s) of the steady solution after one for warming up."""
    return median(lambda: next(march(description.replace(**{"time.steady_only": True}))), repeats)


def median(function, repeats):
    """Median time (s) of a number of calls after one warm-up call."""
    seconds = []
    for _ in range(repeats + 1):
        started = time.perf_counter()
        function()
        seconds.append(time.perf_counter() - started)
    return float(np.median(seconds[1:]))


def markdown(columns, rows):
    """Lines of a Markdown table of texts."""
    return [f"| {' | '.join(line)} |" for line in (columns, ["---"] * len(columns), *rows)]


def chart_of_rows(plt, names, height=0.35):
    """(figure, axes, places) of a chart with a named row for each number; height of a row in inches."""
    figure, ax = plt.subplots(figsize=(8, height * len(names) + 1.4), constrained_layout=True)
    ax.set_yticks(at := np.arange(len(names)), names)
    ax.invert_yaxis()
    return figure, ax, at


def machine():
    """One line that says where figures come from."""
    name = platform.processor() or platform.machine()
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        name = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{name}, {os.cpu_count()} cores, {time.strftime('%Y-%m-%d')}"


def result(rows, **more):
    """JSON object of a suite: machine, rows (dictionaries) and further counts."""
    return plain({"program": user_files.PROGRAM, "machine": machine(), **more, "rows": rows})


def save(folder, name, found):
    """A :func:`result` as NAME.json, in place of an earlier one; returns the path. Raises StoreError."""
    path = Path(folder) / f"{name}.json"
    user_files.text(path, json.dumps(found, indent=1, allow_nan=False), force=True)
    return path


def pyplot():
    """matplotlib's pyplot without a screen, in the colours of all figures, or None where it is not installed."""
    try:
        import matplotlib
    except ImportError:
        return None
    from matplotlib import cycler

    from tehl_taichi.view.figures import palette

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rc("axes", prop_cycle=cycler(color=palette.LINES))
    return plt
