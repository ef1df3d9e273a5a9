"""Workers that share phases of jobs: every job once, in the order of the phases, whoever comes or leaves."""

import numpy as np
import pytest

from tehl_taichi.engine import task_pool
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.task_pool import Team

JOBS, PHASES = 13, 400


@pytest.fixture(scope="module")
def tally(taichi_cpu):
    """A launch in which job j of phase n adds to row j what the neighbours held after phase n - 1."""
    @ti.kernel
    def count(sync: task_pool.Sync, held: ti.types.ndarray(dtype=ti.f64, ndim=2)):
        ti.loop_config(block_dim=1)
        for _ in range(ti.cast(sync[task_pool.COUNT], ti.i32)):
            ticket = task_pool.take(sync)
            stays = True
            while stays and task_pool.phase_of(ticket) != task_pool.NO_PHASE:
                n, j = task_pool.phase_of(ticket), task_pool.job_of(ticket)
                if j < JOBS:
                    old, new = n % 2, 1 - n % 2
                    held[new, j] = held[old, (j + 1) % JOBS] + 2 * held[old, (j + JOBS - 1) % JOBS] + n + j
                    held[new, j] %= 1000003.0
                    if task_pool.last_one(sync, JOBS):
                        task_pool.publish(sync, ticket, -1 if n == PHASES - 1 else n + 1)
                    ticket = task_pool.take(sync)
                else:
                    stays = task_pool.waited(sync, ticket)
                    if stays:
                        ticket = task_pool.take(sync)

    return count


def expected():
    held = np.zeros(JOBS)
    for n in range(PHASES):
        held = (np.roll(held, -1) + 2 * np.roll(held, 1) + n + np.arange(JOBS)) % 1000003
    return held


def counted(tally, team):
    held = np.zeros((2, JOBS))
    team.run(lambda: tally(team.sync, held))
    return held[PHASES % 2]


@pytest.mark.parametrize("size, patience", ((1, 10**6), (2, 10**6), (5, 10**4), (2, 0), (3, 3)))
def test_every_job_is_done_once_in_the_order_of_the_phases(tally, size, patience):
    """More workers than threads do not hang, and impatient ones may leave."""
    team = Team(size, patience)
    team.size = size
    for _ in range(20):
        assert (counted(tally, team) == expected()).all()


def test_after_a_worker_has_left_fewer_are_asked(taichi_cpu):
    team, asked, before = task_pool.Team(2), [], task_pool.crowding()
    team.size = 2

    def launch():
        asked.append(int(team.sync[task_pool.COUNT]))
        team.sync[task_pool.LEFT] = asked[-1] == 2 and len(asked) < 8

    for _ in range(18):
        team.run(launch)
    assert asked == [2, 1, 1, 1, 1, 2] + [1] * 8 + [2, 2, 2, 2]
    assert (task_pool.crowding() - before).tolist() == [18, 14]
