"""Coarse-grid runs in the background: in another process beside a long run, with the time of the cores that nothing else
uses; otherwise after the run, in its process (docs/decisions/17).
"""

import contextlib
import functools
import json
import os
import pickle
import subprocess
import sys
import tempfile
import threading
import time

from tehl_taichi.disk import memory_limit
from tehl_taichi.engine import cores, runtime
from tehl_taichi.errors import are_options_typed, typed_options
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.runs.run_in_memory import run_in_bytes
from tehl_taichi.runs.sweep import job
from tehl_taichi.scene import memory_demand

WATCH = 0.5  # s between looks at whether the run is still there
TELL = 1.0  # s between two words that the run waits for it
# nodes times steps from which on a run is long: the process loads its kernels first, some 4 s. A coarse case of a sweep in a
# warm process takes 5.0 s with a process beside it, and 3.8 s with coarse-grid runs after it, by existing kernels
LONG = 5e6
FEW = 4  # cores: with all of more of them a run makes its coarse-grid runs itself as fast
WAITS = 0.25  # of its time, that a run waits for the process: on a machine with much other work it may never end
LOWEST = 19  # priority where the system has no better one
PROCESS, COARSE = 0.25e9, 0.25  # bytes of the process and its modules; its share of the memory of a run


def threads_beside(threads):
    """Number of threads for a process beside a run on so many: idle cores, at most as many as the run has (with more the run
    had to wait, 8 of 16 cores), or what it leaves of one of a FEW. 0 on a single core, and in a worker of a study, because
    the other workers use the cores.
    """
    there = cores.available()
    idle = there - threads
    if job.is_worker() or there == 1 or idle <= 0 and threads > FEW:
        return 0
    return min(max(idle, 1), threads)


def takes_long(scene):
    """Whether a run takes long."""
    return coarse_runs.heavy_work(scene) >= LONG


def has_room(scene):
    """Whether there is memory for the run and the process beside it: without, the system would end one of them."""
    needed = memory_demand.needed_bytes(scene) + run_in_bytes(scene)
    return (1 + COARSE) * needed + PROCESS <= memory_limit.SHARE * memory_limit.available()


@contextlib.contextmanager
def coarse_grid_runs(scene):
    """Context manager for the coarse-grid runs of a scene: in the background if the run is long and leaves time of a core and
    memory. Enter it before the steady start, which uses one core.

    Gives a function of `until` (the result of :func:`tehl_taichi.march.accuracy.coarse_runs.resolved`, once it is known). That
    function returns a function of notify(done, total), which returns the result of
    :func:`tehl_taichi.march.accuracy.coarse_runs.answers`: it waits for the background process, or runs them itself. The
    background process ends with the context.
    """
    threads = threads_beside(runtime.ensure()["threads"])
    if threads and coarse_runs.has_coarse_runs(scene) and takes_long(scene) and has_room(scene):
        with _in_background(scene, threads) as with_until:
            yield with_until
    else:
        yield functools.partial(_afterwards, scene)


def _afterwards(scene, until):
    """Function of notify(done, total) that makes the coarse-grid runs in this process."""
    return functools.partial(coarse_runs.answers, scene, until=lambda: until)


@contextlib.contextmanager
def _in_background(scene, threads):
    """Start the background process, and end it with the context; gives the function of `until`."""
    read, write = os.pipe()
    with open(write, "wb", 0) as word, _started(scene, read, threads) as process:
        os.close(read)
        try:
            yield functools.partial(_wait_for, process, word, scene, time.monotonic())
        finally:
            process.kill()


def _started(scene, read, threads):
    """Start the process with so many threads; read: end of the pipe for `until`."""
    with tempfile.TemporaryFile() as scenes:
        pickle.dump((os.getpid(), read, scene, threads, are_options_typed()), scenes)
        scenes.seek(0)
        # a session of its own: Ctrl-C is for the run, which ends it
        return subprocess.Popen([sys.executable, "-c", "from tehl_taichi.runs.background_errors import serve; serve()"],
                                stdin=scenes,
                                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, start_new_session=True, pass_fds=(read,))


def _wait_for(process, word, scene, began, until):
    """Send `until` to the process, which began at `began` (s), and return a function that waits for its result."""
    with contextlib.suppress(OSError):  # it died
        word.write(json.dumps(until).encode())
    word.close()
    return functools.partial(_ready, process, scene, began, until)


def _ready(process, scene, began, until, notify=lambda done, total: None):
    """Result of the process; if it died, or would take too long, computed here."""
    latest = (now := time.monotonic()) + WAITS * (now - began)
    notify(0, 1)
    while (text := _output_of(process)) is None and time.monotonic() < latest:
        notify(0, 1)
    if process.returncode != 0:  # None: it runs
        process.kill()
        return coarse_runs.answers(scene, notify, lambda: until)
    notify(1, 1)
    return json.loads(text)


def _output_of(process):
    """Output of a process that has ended; None while it runs."""
    try:
        return process.communicate(timeout=TELL)[0]
    except subprocess.TimeoutExpired:  # nothing is lost: the next call continues
        return None


def serve():
    """Main function of the background process.

    It reads from stdin the number of the run's process, the pipe for `until`, the scene, the number of threads and
    whether options are typed, and writes its results to stdout.
    """
    run, pipe, scene, threads, typed = pickle.load(sys.stdin.buffer)
    threading.Thread(target=_end_with, args=(run,), daemon=True).start()
    _give_way()
    runtime.start(threads=threads)
    with typed_options(typed):
        print(json.dumps(coarse_runs.answers(scene, until=functools.cache(functools.partial(_heard, pipe)))), flush=True)
    runtime.leave(0)


def _give_way():
    """Leave the cores to every other process that can use them."""
    if hasattr(os, "SCHED_IDLE"):
        with contextlib.suppress(OSError):
            return os.sched_setscheduler(0, os.SCHED_IDLE, os.sched_param(0))
    return os.nice(LOWEST) if hasattr(os, "nice") else None


def _heard(pipe):
    with open(pipe, "rb") as words:
        return json.loads(words.read())


def _end_with(run):
    while os.getppid() == run:
        time.sleep(WATCH)
    os._exit(1)
