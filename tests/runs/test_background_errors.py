"""Coarse-grid runs beside their run: the same answers, the time that the run leaves, and nothing left behind."""

import contextlib
import importlib
import os
import signal
import subprocess
import sys
import time

import pytest

from tehl_taichi.disk import memory_limit
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.runs import background_errors, single_run
from tehl_taichi.runs.sweep import job
from tehl_taichi.scene import memory_demand, scene

SHORT = scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 4, "fatigue.depths": (),
                                 "numerics.estimate_error": True})


@pytest.fixture(autouse=True)
def no_worker(monkeypatch):
    """A sweep in the process of the tests leaves it a worker."""
    monkeypatch.setattr(job, "_lane", [])


@pytest.fixture
def idle_core(taichi_cpu, monkeypatch):
    """As many as this process uses: kernels are compiled for a number of threads."""
    monkeypatch.setattr(background_errors.cores, "available", lambda: background_errors.runtime.ensure()["threads"] + 2)
    monkeypatch.setattr(background_errors, "LONG", 0.0)
    monkeypatch.setattr(background_errors, "WAITS", float("inf"))  # a short run would not wait until their kernels are there


@pytest.fixture
def nowhere(monkeypatch):
    """No companions in this process."""
    def refused(*_):
        raise AssertionError("worked out here")

    monkeypatch.setattr(coarse_runs, "answers", refused)


@pytest.mark.slow
def test_they_tell_what_they_tell_after_the_run(idle_core, monkeypatch):
    here, parts = coarse_runs.answers(SHORT), []
    monkeypatch.setattr(coarse_runs, "answers", None)
    with background_errors.coarse_grid_runs(SHORT) as told:
        there = told(None)(lambda *part: parts.append(part))
    assert [one.keys() for one in there] == [one.keys() for one in here]
    assert list(dict.fromkeys(parts)) == [(0, 1), (1, 1)] and parts[-1] == (1, 1)
    values, expected = there[-1]["values"], here[-1]["values"]
    assert values.keys() == expected.keys() and {n: one["value"] for n, one in values.items()} == {
        n: one["value"] for n, one in expected.items()}
    own = {name: coarse_runs.GridReading(**one) for name, one in expected.items()}
    assert coarse_runs.judged(there, own) == coarse_runs.judged(here, own)


def test_they_hear_up_to_where_the_run_is_resolved(idle_core, nowhere):
    passing = SHORT.replace(**{"time.steps": -1, "time.x_end": -0.2})
    with background_errors.coarse_grid_runs(passing) as told:
        there = told(-0.5)()
    found = there[-1]["values"]
    assert 0 < found["a:resolved_Fi_max"]["value"] < found["a:Fi_max"]["value"]


@pytest.mark.parametrize("cores,threads,expected", [(1, 1, 0), (2, 1, 1), (2, 2, 1), (4, 4, 1), (4, 3, 1), (8, 8, 0),
                                                    (16, 8, 8), (16, 12, 4), (16, 2, 2)])
def test_they_have_idle_cores_or_what_a_run_leaves_of_a_few(monkeypatch, cores, threads, expected):
    monkeypatch.setattr(background_errors.cores, "available", lambda: cores)
    assert background_errors.threads_beside(threads) == expected
    monkeypatch.setattr(job, "_lane", ["a lane"])
    assert background_errors.threads_beside(threads) == 0


@pytest.mark.parametrize("threads", (0, 1, 7))
def test_they_are_beside_the_run_with_threads_of_their_own(taichi_cpu, monkeypatch, threads):
    given = []
    monkeypatch.setattr(background_errors, "LONG", 0.0)
    monkeypatch.setattr(background_errors, "threads_beside", lambda _: threads)
    monkeypatch.setattr(background_errors, "_started", lambda scene, pipe, count: given.append(count) or sleeper())
    with background_errors.coarse_grid_runs(SHORT) as told:
        assert given == [threads] * (threads > 0)
        assert (told(None).func is coarse_runs.answers) == (not threads)


def no_process(*_):
    pytest.fail("a process")


def sleeper(*_):
    return subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"], stdout=subprocess.PIPE)


def test_only_long_runs_have_them_beside():
    gear = scene("gear")
    assert background_errors.takes_long(gear) and not background_errors.takes_long(gear.replace(**{"thermal.on": False}))
    assert background_errors.takes_long(gear.replace(**{"thermal.on": False, "grid.nx": 512,
                                                        "grid.ny": 128})) and not background_errors.takes_long(SHORT)


def test_who_wants_none_has_no_process(idle_core, monkeypatch):
    monkeypatch.setattr(background_errors, "_started", no_process)
    with background_errors.coarse_grid_runs(SHORT.replace(**{"numerics.estimate_error": False})) as told:
        assert told(None).func is coarse_runs.answers


def test_without_memory_for_both_they_are_after_the_run(idle_core, monkeypatch):
    """A run in little memory must not be ended by the system because of them."""
    needed, steel = 0.25e9 + 1.25 * memory_demand.needed_bytes(SHORT), SHORT.replace(**{
        "time.run_in": 2, "time.steps": -1, "bodies.a.yield_stress": 2.2e9})
    for there, beside in ((needed / 0.94, True), (needed / 0.96, False)):
        monkeypatch.setattr(memory_limit, "available", lambda there=there: there)
        assert background_errors.has_room(SHORT) == beside and not background_errors.has_room(steel)
        monkeypatch.setattr(background_errors, "_started", sleeper if beside else no_process)
        with background_errors.coarse_grid_runs(SHORT) as told:
            assert (told(None).func is coarse_runs.answers) != beside


def test_they_end_with_their_run(idle_core, nowhere, monkeypatch):
    processes, started = [], background_errors._started
    monkeypatch.setattr(background_errors, "_started", lambda *of: processes.append(started(*of)) or processes[0])
    with pytest.raises(KeyboardInterrupt), background_errors.coarse_grid_runs(SHORT):
        raise KeyboardInterrupt
    assert processes[0].returncode == -signal.SIGKILL


def test_where_they_die_they_are_worked_out_here(idle_core, monkeypatch):
    monkeypatch.setattr(background_errors, "_started", lambda *_: subprocess.Popen(
        [sys.executable, "-c", "print('[half an ans'); raise SystemExit(1)"], stdout=subprocess.PIPE))
    monkeypatch.setattr(coarse_runs, "answers", lambda one, notify, until: [one.name, until()])
    with background_errors.coarse_grid_runs(SHORT) as told:
        assert told(0.25)() == ["gear", 0.25]


def test_who_waits_too_long_works_them_out_itself(idle_core, monkeypatch):
    """On a machine whose cores are all used by other work the process would never end."""
    processes = []
    monkeypatch.setattr(background_errors, "_started", lambda *_: processes.append(sleeper()) or processes[0])
    monkeypatch.setattr(background_errors, "TELL", 0.01)
    monkeypatch.setattr(background_errors, "WAITS", 0.25)
    monkeypatch.setattr(coarse_runs, "answers", lambda one, notify, until: [one.name, until()])
    with background_errors.coarse_grid_runs(SHORT) as told:
        time.sleep(0.2)
        began = time.monotonic()
        assert told(0.25)() == ["gear", 0.25] and processes[0].wait() == -signal.SIGKILL
        assert 0.05 <= time.monotonic() - began < 5.0


def test_they_begin_before_the_steady_start_and_end_with_it(taichi_cpu, monkeypatch, tmp_path):
    """A run leaves a core idle before its first step."""
    seen, processes = [], []
    monkeypatch.setattr(background_errors, "LONG", 0.0)
    monkeypatch.setattr(background_errors, "threads_beside", lambda _: 1)
    monkeypatch.setattr(background_errors, "_started", lambda *_: processes.append(sleeper()) or processes[0])

    def start(*_):
        seen.append([process.poll() for process in processes])
        raise KeyboardInterrupt

    monkeypatch.setattr(importlib.import_module("tehl_taichi.march.passage"), "march", start)
    with pytest.raises(KeyboardInterrupt):
        single_run.run(SHORT, tmp_path / "stopped.zarr")
    assert seen == [[None]] and processes[0].returncode == -signal.SIGKILL


@pytest.mark.skipif(not hasattr(os, "SCHED_IDLE"), reason="this system has no such priority")
def test_they_give_way_to_other_work(idle_core):
    with background_errors.coarse_grid_runs(SHORT):
        deadline = time.monotonic() + 30
        while not (given := ways_of(os.getpid())) and time.monotonic() < deadline:
            time.sleep(0.05)
        assert set(given) == {os.SCHED_IDLE}
    assert os.sched_getscheduler(0) == os.SCHED_OTHER


def ways_of(parent):
    """Priorities of the processes of `parent` that have chosen one."""
    children = subprocess.run(["pgrep", "-P", str(parent)], capture_output=True, text=True).stdout.split()
    found = []
    for child in children:
        with contextlib.suppress(ProcessLookupError):
            found.append(os.sched_getscheduler(int(child)))
    return [way for way in found if way != os.SCHED_OTHER]


LONG = ("import sys, time; from tehl_taichi.engine import runtime; from tehl_taichi.runs import background_errors as beside; "
        "from tehl_taichi.scene import scene; runtime.start(threads=1); beside.cores.available = lambda: 2; "
        "one = scene('gear').replace(**{'grid.nx': 512, 'grid.ny': 128, 'numerics.estimate_error': True}); "
        "found = beside._started(one, 0, 1); print(found.pid, flush=True); time.sleep(100)")


def test_they_end_where_their_run_is_killed(taichi_cpu):
    with subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True) as run:
        found = int(run.stdout.readline())
        assert alive(found)
        run.kill()
    deadline = time.monotonic() + 30
    while alive(found) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not alive(found)


def alive(process):
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return open(f"/proc/{process}/stat").read().rsplit(")", 1)[1].split()[0] != "Z" if os.path.exists("/proc") else True
