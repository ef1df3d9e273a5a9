"""Workers of one kernel that share the jobs of consecutive phases: no launch and no sleeping thread in between.

A ticket is (round, phase, job) in one number, taken by an atomic addition. The worker that finishes the last job of a phase
decides the next one (serially, alone) and publishes the next round; the others wait for it, spinning. No worker waits for a
worker without a job: one that starts late or never is not missed, so any number of workers finishes. A worker that has waited
too long (another lost its core in the middle of a job) leaves the kernel; the other finishes alone. Jobs do not depend on the
worker, and sums are added in their order: the bits are equal for any number of workers.
"""

import numpy as np

from tehl_taichi.engine import cores, runtime
from tehl_taichi.engine.language import ti

JOB_BITS, PHASE_BITS = 20, 10  # of a ticket
NO_PHASE = (1 << PHASE_BITS) - 1  # behind the last phase: everybody leaves
TICKET, DONE, LEFT, COUNT, PATIENCE = 0, 16, 32, 48, 49  # entries of `sync`, those that change on cache lines of their own
LONG = 100_000  # polls, of 10 to 50 ns; the longest jobs take 0.2 ms
FIRST_PAUSE, LONGEST_PAUSE = 4, 4096  # solves on one worker after one that a worker has left

Sync = ti.types.ndarray(dtype=ti.i64, ndim=1)


@ti.func
def take(sync: ti.template()):
    return ti.atomic_add(sync[TICKET], ti.cast(1, ti.i64))


@ti.func
def phase_of(ticket):
    return ti.cast((ticket >> JOB_BITS) & NO_PHASE, ti.i32)


@ti.func
def job_of(ticket):
    return ti.cast(ticket & ((1 << JOB_BITS) - 1), ti.i32)


@ti.func
def last_one(sync: ti.template(), jobs):
    """Count a finished job; returns whether it was the last of `jobs`. If so, no other worker works until :func:`publish`."""
    return ti.atomic_add(sync[DONE], ti.cast(1, ti.i64)) == jobs - 1


@ti.func
def publish(sync: ti.template(), ticket, phase):
    """Begin `phase` after that of `ticket`; a negative phase ends the kernel."""
    ti.atomic_and(sync[DONE], ti.cast(0, ti.i64))
    ticket_of_phase = ((ticket >> (JOB_BITS + PHASE_BITS)) + 1) << PHASE_BITS
    ticket_of_phase |= ti.cast(NO_PHASE if phase < 0 else phase, ti.i64)
    ti.atomic_max(sync[TICKET], ticket_of_phase << JOB_BITS)  # larger than any ticket before


@ti.func
def waited(sync: ti.template(), ticket):
    """Wait for the phase after that of `ticket`; returns False if the wait was too long."""
    polls, patience = ti.cast(0, ti.i64), sync[PATIENCE]
    while polls < patience and (ti.atomic_or(sync[TICKET], ti.cast(0, ti.i64)) >> JOB_BITS) == (ticket >> JOB_BITS):
        polls += 1
    if polls >= patience:
        ti.atomic_add(sync[LEFT], ti.cast(1, ti.i64))
    return polls < patience


_launches = np.zeros(2, int)  # of teams of several, and those of them that fewer finished


def crowding():
    """Array of two: launches by several workers in this process so far, and those that fewer workers finished, or were started
    with, because one had lost its core to another process.
    """
    return _launches.copy()


def team_size(jobs):
    """Number of workers for phases of at most `jobs` jobs: at most the threads of the engine."""
    return max(1, min(jobs, runtime.ensure()["threads"], cores.available()))


class Team:
    """Number of workers, adapted from launch to launch, at most :func:`team_size`; `sync` is the argument for kernels."""

    def __init__(self, jobs, patience=LONG):
        self.size = team_size(jobs)
        memory = np.zeros(64 + 8, np.int64)
        shift = -memory.ctypes.data // 8 % 8  # cache lines have 64 bytes
        self.sync = memory[shift : shift + 64]
        self.sync[PATIENCE] = patience
        self.alone, self.pause = 0, FIRST_PAUSE

    def run(self, launch, phase=0):
        """Launch from `phase` on. After a launch that a worker has left, the next launches have one worker, more of them each
        time.
        """
        self.sync[[TICKET, DONE, LEFT]] = phase << JOB_BITS, 0, 0
        self.sync[COUNT] = 1 if self.alone else self.size
        launch()
        if self.size > 1:
            _launches[:] += 1, self.alone > 0 or self.sync[LEFT] > 0
        if self.alone:
            self.alone -= 1
        elif self.sync[LEFT]:
            self.alone, self.pause = self.pause, min(2 * self.pause, LONGEST_PAUSE)
        else:
            self.pause = FIRST_PAUSE
