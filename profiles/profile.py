"""Where the time of a step goes: stages by Python's profiler, kernels by their launches."""

import cProfile
import pstats
import time

from tehl_taichi.scene import scene

# (file, function) -> stage; a stage may contain others
STAGES = {("newton.py", "solve"): "pressure: Newton", ("krylov.py", "fgmres"): "pressure: Krylov",
          ("transforms.py", "apply"): "pressure: deflection", ("transforms.py", "run"): "pressure: transforms in all",
          ("preconditioner.py", "apply"): "pressure: preconditioner", ("preconditioner.py", "build"): "pressure: build",
          ("heat.py", "solve"): "temperatures", ("heat.py", "accept"): "temperatures: accept",
          ("simulation.py", "_predict"): "guess", ("snapshot.py", "take"): "snapshot"}


def run(nx, ny, thermal, steps):
    """(stages, kernels, numbers): rows {"what", "calls", "ms"} per step, and start, first step and step in s.

    To be called in a process of its own (:func:`tehl_taichi.profiles.measure.fresh`): kernels must be bound while watched.
    """
    from tehl_taichi import runtime
    from tehl_taichi.simulation import march

    launches = runtime.watch_launches()
    description = scene("gear").replace(**{"grid.nx": nx, "grid.ny": ny, "thermal.on": thermal, "time.steps": steps + 1})
    started = time.perf_counter()
    passage = march(description)
    next(passage)
    start = time.perf_counter() - started
    next(passage)
    first = time.perf_counter() - started - start
    launches.clear()
    profiler, started = cProfile.Profile(), time.perf_counter()
    profiler.runcall(lambda: list(passage))
    step = (time.perf_counter() - started) / steps
    kernels = [{"what": name, "calls": count / steps, "ms": 1e3 * seconds / steps}
               for name, (count, seconds) in sorted(launches.items(), key=lambda item: -item[1][1])]
    return _stages(profiler, steps), kernels, {"start_s": start, "first_step_s": first, "step_s": step}


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
        ax.set(xlabel="ms a step", title=title)
        ax.invert_yaxis()
    return figure
