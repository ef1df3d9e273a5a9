"""Where the time of a step goes, and what it must at least take: stages by Python's profiler, kernels by their launches.

The limit of a kernel is the time to copy the bytes that it must move (:mod:`tehl_taichi.profiles.traffic`), that of a
transform the time which it takes alone, both measured in the same process on one thread.
"""

import cProfile
import pstats
import time

import numpy as np
from tehl_taichi.profiles import measure
from tehl_taichi.profiles.traffic import IN_S, bytes_of

from tehl_taichi.scene import scene

# (file, function) -> stage; a stage may contain others
STAGES = {("newton.py", "solve"): "pressure: Newton", ("krylov.py", "solve"): "pressure: Krylov",
          ("bending.py", "bend"): "pressure: deflection", ("preconditioner.py", "build"): "pressure: build",
          ("temperatures.py", "solve"): "temperatures", ("temperatures.py", "accept"): "temperatures: accept",
          ("passage.py", "_predict"): "guess", ("snapshot.py", "take"): "snapshot"}


def run(nx, ny, thermal, steps):
    """(stages, kernels, numbers): rows {"what", "calls", "ms", "limit_ms"} per step (kernels: "MB" too); start, tracing and
    compiling kernels (or finding them in the cache), first step and step in s, rate of a copy in GB/s.

    To be called in a process of its own (:func:`tehl_taichi.profiles.measure.fresh`): kernels must be bound while watched.
    """
    from tehl_taichi.engine import launches
    from tehl_taichi.march.passage import march

    watched = launches.watch_launches(bytes_of)
    description = scene("gear").replace(**{"grid.nx": nx, "grid.ny": ny, "thermal.on": thermal, "time.steps": steps + 1})
    started = time.perf_counter()
    passage = march(description)
    next(passage)
    start = time.perf_counter() - started
    next(passage)
    first = time.perf_counter() - started - start
    watched.clear()
    profiler, started = cProfile.Profile(), time.perf_counter()
    profiler.runcall(lambda: list(passage))
    step = (time.perf_counter() - started) / steps
    rate = copy_rate((nx + 1) * (ny + 1) * 8 * len(IN_S))
    kernels = [{"what": name, "calls": count / steps, "ms": 1e3 * seconds / steps, "MB": moved / steps / 1e6,
                "limit_ms": 1e3 * moved / rate / steps}
               for name, (count, seconds, moved) in sorted(watched.items(), key=lambda item: -item[1][1])]
    stages = _stages(profiler, steps)
    for stage, alone in transforms_alone(nx, ny).items():
        row = next(row for row in stages if row["what"] == stage)
        row["limit_ms"] = 1e3 * alone * row["calls"]
    numbers = {"start_s": start, "compile_s": launches.binding_seconds(), "first_step_s": first, "step_s": step,
               "copy_GB_s": rate / 1e9}
    return stages, kernels, numbers


def copy_rate(size):
    """Bytes read and written in a second by a copy of `size` bytes in all on one thread."""
    source, target = np.ones(size // 16), np.empty(size // 16)
    return 2 * source.nbytes / measure.median(lambda: np.copyto(target, source), 100)


def transforms_alone(nx, ny):
    """{stage: seconds of one call} where nothing else has used the caches."""
    from tehl_taichi.pressure.deflection import Deflection

    deflection = Deflection(nx, ny, 4 / nx, 2 / ny, 1.0, True)
    return {"pressure: deflection": measure.median(deflection.deflect, 50)}


def gaps(stages, kernels, count=5):
    """The largest times above their limit: [(what, ms to gain)], where the next factor must come from."""
    rows = [row for row in [*stages, *kernels] if "limit_ms" in row]
    return sorted(((row["what"], row["ms"] - row["limit_ms"]) for row in rows), key=lambda gap: -gap[1])[:count]


def _stages(profiler, steps):
    rows = {}
    for (path, _, name), (_, calls, _, cumulative, _) in pstats.Stats(profiler).stats.items():
        stage = STAGES.get((path.rsplit("/", 1)[-1], name))
        if stage:
            rows[stage] = {"what": stage, "calls": calls / steps, "ms": 1e3 * cumulative / steps}
    return sorted(rows.values(), key=lambda row: -row["ms"])


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
