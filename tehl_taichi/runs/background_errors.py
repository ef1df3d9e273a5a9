"""Coarse-grid runs in the background: in another process on idle cores during a long run; otherwise after the run, in its
process.

Default gear on one of two cores, s, medians of three in turn: 45.5 without error bars, 49.2 with them after the run, 43.1
during it. On both cores a background process takes longer than the same work after the run (67.5 against 59.7).
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

from tehl_taichi.engine import cores, runtime
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.runs.sweep import job

WATCH = 0.5  # s between looks at whether the run is still there
TELL = 1.0  # s between two words that the run waits for it
# nodes times steps from which on a run is long: the process loads its kernels first, some 4 s. A coarse case of a sweep in a
# warm process takes 5.0 s with a process beside it, and 3.8 s with coarse-grid runs after it, by existing kernels
LONG = 5e6


def idle_cores():
    """Number of idle cores: 0 in a worker of a study, because the other workers use them."""
    return 0 if job.is_worker() else cores.available() - runtime.ensure()["threads"]


def takes_long(scene):
    """Whether a run takes long."""
    return coarse_runs.heavy_work(scene) >= LONG


@contextlib.contextmanager
def coarse_grid_runs(scene):
    """Context manager for the coarse-grid runs of a scene: in the background if the run is long and a core is idle.

    Gives a function of `until` (the result of :func:`tehl_taichi.march.accuracy.coarse_runs.resolved`, once it is known). That
    function returns a function of notify(done, total), which returns the result of
    :func:`tehl_taichi.march.accuracy.coarse_runs.answers`: it waits for the background process, or runs them itself. The
    background process ends with the context.
    """
    if coarse_runs.has_coarse_runs(scene) and takes_long(scene) and idle_cores() > 0:
        with _in_background(scene) as with_until:
            yield with_until
    else:
        yield functools.partial(_afterwards, scene)


def _afterwards(scene, until):
    """Function of notify(done, total) that makes the coarse-grid runs in this process."""
    return functools.partial(coarse_runs.answers, scene, until=lambda: until)


@contextlib.contextmanager
def _in_background(scene):
    """Start the background process, and end it with the context; gives the function of `until`."""
    read, write = os.pipe()
    with open(write, "wb", 0) as word, _started(scene, read, min(idle_cores(), runtime.ensure()["threads"])) as process:
        os.close(read)
        try:
            yield functools.partial(_wait_for, process, word, scene)
        finally:
            process.kill()


def _started(scene, read, threads):
    """Start the process with at most as many threads as the run has; with more the run had to wait (8 of 16 cores)."""
    with tempfile.TemporaryFile() as scenes:
        pickle.dump((os.getpid(), read, scene, threads), scenes)
        scenes.seek(0)
        # a session of its own: Ctrl-C is for the run, which ends it
        return subprocess.Popen([sys.executable, "-c", "from tehl_taichi.runs.background_errors import serve; serve()"],
                                stdin=scenes,
                                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, start_new_session=True, pass_fds=(read,))


def _wait_for(process, word, scene, until):
    """Send `until` to the process, and return a function that waits for its result."""
    with contextlib.suppress(OSError):  # it died
        word.write(json.dumps(until).encode())
    word.close()
    return functools.partial(_ready, process, scene, until)


def _ready(process, scene, until, notify=lambda done, total: None):
    """Result of the process; if it died, computed here."""
    notify(0, 1)
    while (text := _output_of(process)) is None:
        notify(0, 1)
    if process.returncode:
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

    It reads from stdin the number of the run's process, the pipe for `until`, the scene and the number of threads, and writes
    its results to stdout.
    """
    run, pipe, scene, threads = pickle.load(sys.stdin.buffer)
    threading.Thread(target=_end_with, args=(run,), daemon=True).start()
    runtime.start(threads=threads)
    print(json.dumps(coarse_runs.answers(scene, until=functools.cache(functools.partial(_heard, pipe)))), flush=True)
    runtime.leave(0)


def _heard(pipe):
    with open(pipe, "rb") as words:
        return json.loads(words.read())


def _end_with(run):
    while os.getppid() == run:
        time.sleep(WATCH)
    os._exit(1)
