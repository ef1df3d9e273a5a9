"""Time of a step by stages and kernels, and its lower limit: stages by their calls, kernels by their launches.

The limit of a kernel is the time to copy the bytes that it must move (:mod:`tehl_taichi.profiles.traffic`), that of a
transform the time which it takes alone, both measured in the same process on one thread.
"""

import contextlib
import functools
import time

import numpy as np
from tehl_taichi.profiles import measure
from tehl_taichi.profiles.traffic import IN_S, bytes_of

from tehl_taichi.engine.taichi_patches import prebound
from tehl_taichi.engine.watched_calls import wrapped
from tehl_taichi.march.passage import march
from tehl_taichi.runs.time_budget import MARCHED
from tehl_taichi.scene import scene

# stage: the method or function that it is (below the package); a stage may contain others
STAGES = {"pressure: Newton": MARCHED["pressure"], "pressure: Krylov": "pressure.linear.solver:Krylov.solve",
          "pressure: deflection": "pressure.deflection:Bending.bend",
          "pressure: build": "pressure.linear.preconditioner:AdditiveLines.build",
          "temperatures": MARCHED["temperatures"], "temperatures: accept": "heat.temperatures:FilmHeat.accept",
          "guess": MARCHED["start values"], "snapshot": MARCHED["snapshots"]}

FULL, QUICK = (256, 64, 30), (64, 16, 4)  # columns, rows, steps


def run(nx, ny, steps, thermal):
    """(stages, kernels, numbers): rows {"what", "calls", "ms", "limit_ms"} per step (kernels: "MB" too); start, tracing and
    compiling kernels (or finding them in the cache), first step and step in s, rate of a copy in GB/s.

    To be called in a process of its own (:func:`tehl_taichi.profiles.measure.fresh`): kernels must be bound while watched.
    """
    watched = prebound.watch_launches(bytes_of)
    description = scene("gear").replace(**{"grid.nx": nx, "grid.ny": ny, "thermal.on": thermal, "time.steps": steps + 1})
    started = time.perf_counter()
    passage = march(description)
    next(passage)
    start = time.perf_counter() - started
    next(passage)
    first = time.perf_counter() - started - start
    watched.clear()
    with _timed(STAGES) as spent:
        started = time.perf_counter()
        list(passage)
        step = (time.perf_counter() - started) / steps
    rate = copy_rate((nx + 1) * (ny + 1) * 8 * len(IN_S))
    kernels = [{"what": name, "calls": count / steps, "ms": 1e3 * seconds / steps, "MB": moved / steps / 1e6,
                "limit_ms": 1e3 * moved / rate / steps}
               for name, (count, seconds, moved) in sorted(watched.items(), key=lambda item: -item[1][1])]
    stages = _stages(spent, steps)
    for stage, alone in transforms_alone(nx, ny).items():
        row = next(row for row in stages if row["what"] == stage)
        row["limit_ms"] = 1e3 * alone * row["calls"]
    numbers = {"start_s": start, "compile_s": prebound.binding_seconds(), "first_step_s": first, "step_s": step,
               "copy_GB_s": rate / 1e9}
    return stages, kernels, numbers


def copy_rate(size):
    """Bytes read and written in a second by a copy of `size` bytes in all on one thread."""
    source, target = np.ones(size // 16), np.empty(size // 16)
    return 2 * source.nbytes / measure.median(lambda: np.copyto(target, source), 100)


def transforms_alone(nx, ny):
    """{stage: seconds of one call} where nothing else has used the caches."""
    from tehl_taichi.engine.fftw import even_fast_length, pyfftw

    given = pyfftw.zeros_aligned((even_fast_length(2 * ny), even_fast_length(2 * nx)))
    waves = pyfftw.zeros_aligned((len(given), given.shape[1] // 2 + 1), complex)
    there, back = (pyfftw.FFTW(*pair, axes=(0, 1), direction=direction, flags=("FFTW_ESTIMATE",), threads=1)
                   for pair, direction in (((given, waves), "FFTW_FORWARD"), ((waves, given), "FFTW_BACKWARD")))

    def both():
        there.execute()
        back.execute()

    return {"pressure: deflection": measure.median(both, 50)}


def gaps(stages, kernels, count=5):
    """The largest times above their limit: [(what, ms to gain)], where the next factor must come from."""
    rows = [row for row in [*stages, *kernels] if "limit_ms" in row]
    return sorted(((row["what"], row["ms"] - row["limit_ms"]) for row in rows), key=lambda gap: -gap[1])[:count]


@contextlib.contextmanager
def _timed(stages):
    """{stage: [calls, seconds]} of what happens inside. cProfile of Python 3.12 loses calls around those of Taichi."""
    spent = {stage: [0, 0.0] for stage in stages}
    with wrapped(stages, lambda stage, function: _counted(function, spent[stage])):
        yield spent


def _counted(function, spent):
    @functools.wraps(function)
    def counted(*args, **options):
        started = time.perf_counter()
        try:
            return function(*args, **options)
        finally:
            spent[0] += 1
            spent[1] += time.perf_counter() - started

    return counted


def _stages(spent, steps):
    rows = [{"what": stage, "calls": calls / steps, "ms": 1e3 * seconds / steps}
            for stage, (calls, seconds) in spent.items() if calls]
    return sorted(rows, key=lambda row: -row["ms"])


def chart(plt, stages, kernels, step_s):
    """Bars of ms a step."""
    shown = kernels[:14]
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.6), constrained_layout=True)
    for ax, rows, title in zip(axes, (stages, shown), (f"stages (a step takes {1e3 * step_s:.0f} ms)", "kernels")):
        ax.barh([row["what"] for row in rows], [row["ms"] for row in rows])
        ax.barh([row["what"] for row in rows], [row.get("limit_ms", 0.0) for row in rows], height=0.35, label="limit")
        ax.set(xlabel="ms a step", title=title)
        ax.invert_yaxis()
    axes[1].legend()
    return figure
