"""Scaling: time and memory per node and step against grid and threads."""

from tehl_taichi.profiles import measure

from tehl_taichi.scene import scene

COLUMNS, QUICK_COLUMNS = (64, 128, 256, 512, 1024, 2048), (64, 128)
LARGE, FEW = 1024, 4  # columns from which on so few steps are enough


def run(quick=False, threads=4, thermal=False, progress=None):
    """Rows: grid, threads, ms a step, ns per node and step, Krylov a step, MB; grids on all threads, then (strong scaling) the
    default grid on 1, 2, ... threads and (weak scaling) half its columns on a quarter of the threads."""
    columns = QUICK_COLUMNS if quick else COLUMNS
    counts = [1 << n for n in range(threads.bit_length()) if 1 << n <= threads]
    middle = 128 if quick else 256
    jobs = [(nx, threads) for nx in columns] + [(middle, count) for count in counts if count < threads]
    jobs += [(middle // 2, threads // 4)] if threads >= 4 else []
    return [row(nx, count, thermal, FEW if quick or nx >= LARGE else 12, progress) for nx, count in jobs]


def row(nx, threads, thermal, steps, progress=None):
    """One measurement in a process of its own."""
    ny = nx // 4
    if progress:
        progress(f"{nx} x {ny} cells, {threads} threads")
    description = scene("gear").replace(**{"grid.nx": nx, "grid.ny": ny, "thermal.on": thermal})
    timing = measure.fresh(threads, measure.passage, description, steps)
    nodes = (nx + 1) * (ny + 1) * (description.thermal.nodes if thermal else 1)
    return {"nx": nx, "ny": ny, "threads": threads, "step_ms": 1e3 * timing.step_s, "node_ns": 1e9 * timing.step_s / nodes,
            "newton": timing.newton, "cycles": timing.cycles, "memory_mb": timing.memory_mb,
            "node_B": 1e6 * timing.memory_mb / nodes}


def chart(plt, rows):
    """ns per node and step over the grid, ms a step over the threads."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), constrained_layout=True)
    most = max(row["threads"] for row in rows)
    grids = [row for row in rows if row["threads"] == most]
    left.loglog([row["nx"] for row in grids], [row["node_ns"] for row in grids], "o-")
    left.set(xlabel="columns", ylabel="ns per node and step", title=f"{most} threads")
    size = max(row["nx"] for row in rows if row["threads"] < most) if len(rows) > len(grids) else grids[-1]["nx"]
    same = sorted((row for row in rows if row["nx"] == size), key=lambda row: row["threads"])
    right.plot([row["threads"] for row in same], [row["step_ms"] for row in same], "o-")
    right.set(xlabel="threads", ylabel="ms a step", title=f"{size} columns", ylim=(0, None))
    return figure
