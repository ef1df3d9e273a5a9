"""Scaling: time and memory per node and step against grid and threads, and what more threads would gain."""

from math import ceil

from tehl_taichi.profiles import measure

from tehl_taichi.pressure.linear import convolution
from tehl_taichi.scene import scene

COLUMNS, QUICK_COLUMNS = (64, 128, 256, 512, 1024, 2048), (64, 128)
LARGE, FEW = 1024, 4  # columns from which on so few steps are enough
ALONE = 1024  # columns up to which one thread is timed, too
ROUNDS = 2  # of all counts of threads, the faster counts: machines that others use, too, have slow minutes
CORES = (1, 2, 4, 8, 16, 32, 64)  # of the model
MARKS = [125 * 2**n for n in range(12)]  # ns, on the axis


def run(quick=False, threads=4, thermal=False, progress=None):
    """Rows: grid, threads, ms a step, ns per node and step, speed-up over one thread, Krylov a step, MB; every grid on 1, 2,
    4 ... `threads` (strong scaling; four times the nodes on four times the threads is weak scaling), the finest on all."""
    columns = QUICK_COLUMNS if quick else COLUMNS
    counts = sorted({threads, *(1 << n for n in range(threads.bit_length()) if 1 << n <= threads)})
    rows = [row for nx in columns for row in _fastest(nx, counts if nx <= ALONE else [threads], thermal, quick, progress)]
    alone = {row["nx"]: row["step_ms"] for row in rows if row["threads"] == 1}
    return [{**row, "speed_up": alone[row["nx"]] / row["step_ms"] if row["nx"] in alone else None} for row in rows]


def _fastest(nx, counts, thermal, quick, progress):
    """The fastest of ROUNDS measurements for every count of threads, all counts in turn."""
    steps, rounds = FEW if quick or nx >= LARGE else 12, 1 if quick or len(counts) == 1 else ROUNDS
    found = [row(nx, count, thermal, steps, progress) for _ in range(rounds) for count in counts]
    return [min((one for one in found if one["threads"] == count), key=lambda one: one["step_ms"]) for count in counts]


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


def modelled(speed_up, at, jobs, cores):
    """Speed-up on `cores` of a step of equal jobs and a serial part, from the `speed_up` on `at` cores (0 < it <= at).

    Bound by the jobs of a phase, pairs of blocks of rows, and by what is serial; not by memory, which cores share.
    """
    share = ceil(jobs / at) / jobs
    serial = min(1.0, max(0.0, (1 / speed_up - share) / (1 - share))) if share < 1 else 1.0
    return 1 / (serial + (1 - serial) * ceil(jobs / cores) / jobs)


def chart(plt, rows):
    """ns per node and step over the grid; speed-up over the threads, measured and beyond them by the model."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), constrained_layout=True)
    most = max(row["threads"] for row in rows)
    for count in sorted({row["threads"] for row in rows}):
        grids = [row for row in rows if row["threads"] == count]
        name = f"{count} thread{'s'[:count - 1]}"
        left.loglog([row["nx"] for row in grids], [row["node_ns"] for row in grids], "o-", label=name)
    columns = sorted({row["nx"] for row in rows})
    left.set(xlabel="columns", ylabel="ns per node and step", xticks=columns, xticklabels=columns)
    shown = [mark for mark in MARKS if left.get_ylim()[0] <= mark <= left.get_ylim()[1]]
    left.set(yticks=shown, yticklabels=shown)
    left.minorticks_off()
    left.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    for nx in sorted({row["nx"] for row in rows if row["speed_up"]}):
        _speed_up(right, most, [row for row in rows if row["nx"] == nx])
    right.plot(CORES, CORES, ":", color="0.5", lw=0.8)
    right.set(xlabel="threads (lines: model)", ylabel="speed-up over one thread", xscale="log", yscale="log", xticks=CORES,
              xticklabels=CORES, yticks=CORES, yticklabels=CORES, ylim=(0.7, CORES[-1]))
    right.minorticks_off()
    right.legend(title="columns", loc="upper left")
    return figure


def _pairs(row):
    """Jobs that the deflection of a row's grid has along x."""
    return convolution.transform_sizes([(row["nx"], row["ny"])], [])[0].pairs


def _speed_up(ax, most, rows):
    """Measured points of one grid, and the model's line through the last of them."""
    points = ax.plot([row["threads"] for row in rows], [row["speed_up"] for row in rows], "o", label=str(rows[0]["nx"]))
    last, jobs = max(rows, key=lambda row: row["threads"]), _pairs(rows[0])
    if most > 1:
        ax.plot(CORES, [modelled(last["speed_up"], most, jobs, cores) for cores in CORES], lw=0.9, color=points[0].get_color())
