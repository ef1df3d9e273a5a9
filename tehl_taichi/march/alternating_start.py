"""Steady state of a thermal film: pressure and temperature are solved alternately until neither changes."""

import math

import numpy as np

from tehl_taichi.heat.energy import LIGHT
from tehl_taichi.pressure import fields
from tehl_taichi.scene.timeline import step_cells

TRANSITS, STRIDE = 1.2, 3  # of the domain by the slower surface in the first steps towards the steady state; their length
SLOW, SLOW_STRIDE = 4, 8  # ratio of the speeds from which on the slower surface needs longer steps, and those
BLOCK = 6  # later blocks: this fraction of the columns
SETTLED = 0.05  # K
# K, that a single block may lie off the mean of its run. Blocks of scenes that settle flutter by up to 0.6 K; without a limit
# an oscillation passes: 603 deg C while blocks differed by 30 K, where a march in time gives 255
FLUTTER = 0.7
BLOCKS, USUAL = 40, 16  # at most; 8 to 12 are usual
LONGEST_RUN = 8  # blocks that are averaged
# Blocks without progress after which it will not settle, what is progress, and the change (K) from which on it counts: scenes
# that do not settle jump by as much (to 300 K) in the fortieth block as in the tenth; some that flutter by 0.8 K do settle
STUCK, PROGRESS, JUMP = 8, 0.95, 2.0


def time_step(levels):
    """Time step (s) on the cells of `levels`: that of the passage, or one cell of the faster surface."""
    scene, a = levels.scene, levels.scales.a
    if scene.transient:
        return step_cells(scene) * levels.dx * a / scene.reference.speed
    return levels.dx * a / max(scene.operation.u_a, scene.operation.u_b)


def find_steady(levels, heat, solve, T=None):
    """Find steady pressure and temperature alternately: a block of time steps at constant pressure, then the pressure by
    solve() -> Report.

    T: initial temperatures, from a coarser grid. The result is settled if the mean temperatures under load of two blocks, or of
    two series of 2 to 8 blocks, differ by less than SETTLED. (Material strips lie between nodes or on them: single moments
    differ by 0.2 K on 64 columns; blocks by up to 0.6 K if the surfaces slip fast, alternating about one mean.) A state with
    unconverged columns or limited temperatures is not settled. Returns the pressure's Report, with converged = False if it is
    not settled, and whether it took more than USUAL blocks.
    """
    heat.start(T)
    speeds = [body.speed for body in heat.bodies.each]
    moving = [speed for speed in speeds if speed]
    ratio = max(moving) / min(moving)
    first, later = (STRIDE, 1) if ratio < SLOW else (SLOW_STRIDE, SLOW_STRIDE // 2)
    cell = max(heat.dt, levels.dx * levels.scales.a / max(speeds))  # s; shorter steps would settle for less
    steps, dt = math.ceil(TRANSITS * levels.nx * ratio / first), first * cell
    means, changes = [heat.T], []
    while len(changes) < BLOCKS and not _stuck(changes):
        means = [_march(heat, steps, dt), *means[: 2 * LONGEST_RUN - 1]]
        changes.append(remaining_change(means, levels.get(fields.P) > LIGHT))
        report = solve()
        steps, dt = _whole_cells(levels.nx / BLOCK * (1 if ratio < SLOW else ratio) / later, later / ratio), later * cell
        if not report.converged or changes[-1] < SETTLED and heat.sound:
            break
    else:
        report.converged, heat.report.change = False, changes[-1]
    heat.bodies.warm_resting()
    return report, len(changes) > USUAL


def _stuck(changes):
    """Whether none of the last STUCK changes is smaller than JUMP, or than all before by PROGRESS."""
    return len(changes) > STUCK and min(changes[-STUCK:]) > max(JUMP, PROGRESS * min(changes[:-STUCK]))


def remaining_change(means, loaded):
    """Smallest difference (K) between the last series of blocks and the one before, over series of 1, 2, 3 ... blocks.

    (A flutter of three blocks, 0.5 K at the outlet of cold oil, would differ by 0.09 K for ever over series of 2, 4 and 8.)
    means: newest first. If a block differs from the mean of its series by more than FLUTTER, that difference counts.
    """
    loads = [T[:, loaded] for T in means]
    return min(_difference(loads[: 2 * n]) for n in range(1, min(LONGEST_RUN, len(loads) // 2) + 1))


def _difference(blocks):
    """Largest difference between the means of the newer and the older half of `blocks`, or of a block from the newer mean."""
    half = len(blocks) // 2
    mean = np.mean(blocks[:half], axis=0)
    flutter = max(float(np.abs(T - mean).max()) for T in blocks) if half > 1 else 0.0
    return flutter if flutter > FLUTTER else float(np.abs(mean - np.mean(blocks[half:], axis=0)).max())


def _whole_cells(steps, cells):
    """Number of steps near `steps`, of `cells` cells each, that together are nearly whole cells."""
    return max(1, round(max(1, round(steps * cells)) / cells))


def _march(heat, steps, dt):
    """March `steps` time steps at constant pressure; returns the mean temperatures over them."""
    total = 0.0
    for _ in range(steps):
        heat.begin(dt)
        heat.solve()
        heat.accept()
        total = total + heat.T
    return total / steps
