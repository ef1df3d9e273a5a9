"""Runs on crowded and on small machines: they end, with the bits of an undisturbed run."""

import os
import signal
import subprocess
import sys
import time

import pytest

from tehl_taichi.engine import cores

pytestmark = [pytest.mark.slow, pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="affinity is Linux's")]
PATIENCE = 300  # s that a run is given beside seven others; alone it takes four
RUN = """
import hashlib, os, subprocess, sys
from pathlib import Path
from tehl_taichi.engine import cores, runtime, task_pool as workers
{before}
runtime.start(threads={threads})
from tehl_taichi.march.passage import march
from tehl_taichi.scene import scene
bits, hogs = hashlib.sha256(), []
for shot in march(scene("gear").replace(**{{"grid.nx": 64, "grid.ny": 16, "time.steps": 2, "thermal.on": False}})):
    for field in shot.fields.values():
        bits.update(field.tobytes())
    if shot.step == 0:
        {then}
for hog in hogs:
    hog.kill()
print(bits.hexdigest(), runtime.ensure()["threads"], workers.Team(5).size)
"""
ONE_CORE = f"os.sched_setaffinity(0, {{{cores.allowed()[0]}}})"
HALF = "cores.GROUPS, cores.OWN = Path({groups!r}), Path({own!r})"
HOGS = "hogs = [subprocess.Popen([sys.executable, '-c', 'while True: pass']) for _ in range(2 * len(cores.allowed()))]"
NICE = "; [os.setpriority(os.PRIO_PROCESS, int(task), 19) for task in os.listdir('/proc/self/task')]"


def begun(before="", then="pass", threads=None):
    return subprocess.Popen([sys.executable, "-c", RUN.format(before=before, then=then, threads=threads)], text=True,
                            stdout=subprocess.PIPE)


def ended(run):
    """(bits, threads, workers) of a run, which must not take for ever."""
    try:
        bits, threads, team = run.communicate(timeout=PATIENCE)[0].split()
    finally:
        run.kill()
    return bits, int(threads), int(team)


@pytest.fixture(scope="module")
def undisturbed():
    return ended(begun(threads=1))[0]


@pytest.mark.parametrize("then", (HOGS, HOGS + NICE))
def test_beside_others_on_all_cores(undisturbed, then):
    """Also with the least right to them (every thread: each has its own)."""
    assert ended(begun(then=then))[0] == undisturbed


@pytest.mark.parametrize("threads", (None, 4))
def test_on_one_core(undisturbed, threads):
    """With more threads asked for, workers still are as many as cores."""
    assert ended(begun(ONE_CORE, threads=threads)) == (undisturbed, threads or 1, 1)


@pytest.mark.parametrize("threads", (None, 4))
def test_in_a_container_with_half_a_core(undisturbed, tmp_path, threads):
    (tmp_path / "cpu.max").write_text("50000 100000\n")
    (tmp_path / "own").write_text("0::/\n")
    half = HALF.format(groups=str(tmp_path), own=str(tmp_path / "own"))
    assert ended(begun(half, threads=threads)) == (undisturbed, threads or 1, 1)


def test_stopped_and_gone_on_with_all_the_time(undisturbed):
    """As a control group does to a process that has used up its share: all of its threads stand still half of the time."""
    run = begun()
    while run.poll() is None:
        for what in (signal.SIGSTOP, signal.SIGCONT):
            run.send_signal(what)
            time.sleep(0.05)
    assert ended(run)[0] == undisturbed


def test_eight_at_once(undisturbed):
    runs = [begun() for _ in range(8)]
    assert {ended(run)[0] for run in runs} == {undisturbed}
