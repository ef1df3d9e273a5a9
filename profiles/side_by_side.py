"""Gain by several workers: the same sweep on 1, 2, 4 ... of them, one thread each."""

import tempfile
import time
from pathlib import Path

from tehl_taichi.engine import cores
from tehl_taichi.runs.sweep import sweeping, warm_cache
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.scene import scene

OVER = {"srr": "-0.3:0.3:8", "feature.height": "0.5e-6,1e-6"}  # 16 cases
QUICK = {"srr": "-0.3:0.3:2"}


def run(quick=False, most=None, progress=None):
    """Rows {"workers", "seconds", "cases_s", "speed_up"} of the sweep on 1, 2, 4 ... `most` workers (default: one a core):
    wall time with the start of the workers, the sum of the times of the cases, and how much faster than one worker."""
    nx, ny, steps, over = (64, 16, 4, QUICK) if quick else (128, 32, -1, OVER)
    small = scene("gear").replace(**{"thermal.on": False, "grid.nx": nx, "grid.ny": ny, "time.steps": steps})
    warm_cache.ensure_kernels(small)  # kernels are compiled and kept before the first measurement
    rows, workers = [], 1
    while workers <= (most or cores.available()):
        rows.append(_timed(plan(small, over), workers))
        rows[-1]["speed_up"] = rows[0]["seconds"] / rows[-1]["seconds"]
        if progress:
            progress(f"{workers} workers: {rows[-1]['seconds']:.1f} s, {rows[-1]['speed_up']:.2f} times as fast as one")
        workers *= 2
    return rows


def _timed(cases, workers):
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        study = sweeping.run(cases, Path(folder) / "study.zarr", workers=workers, threads_per_worker=1)
        seconds = time.perf_counter() - began
        return {"workers": workers, "seconds": seconds, "cases_s": sum(one["seconds"] for one in study.results())}


def chart(plt, rows):
    """Speed-up over the workers, and what would be ideal."""
    figure, ax = plt.subplots(figsize=(4.6, 3.8), constrained_layout=True)
    workers = [row["workers"] for row in rows]
    ax.plot(workers, [row["speed_up"] for row in rows], "o-", label="measured")
    ax.plot(workers, workers, ":", color="0.5", lw=0.8, label="ideal")
    ax.set(xlabel="workers", ylabel="speed-up over one worker", xticks=workers)
    ax.legend()
    return figure
