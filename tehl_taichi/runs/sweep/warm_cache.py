"""Shared kernel cache: the first worker of a machine compiles the kernels, the others wait and load them.

Taichi stores compiled kernels when its process ends normally, which workers rarely do. So a short passage runs in a separate
process, once per kind of scene, version and machine (more exactly: kernel folder).
"""

import contextlib
import hashlib
import json
import os
import pickle
import subprocess
import sys

from tehl_taichi.commit import commit
from tehl_taichi.disk import files
from tehl_taichi.engine import runtime
from tehl_taichi.errors import Error

STEPS = 3  # the fewest with a fatigue search


def ensure_kernels(scene):
    """Make sure that the kernels of such a scene are in the cache; waits if another process is compiling them."""
    stamp = runtime.preferred_cache() / f"warm-{_kind(scene)}"
    if os.path.exists(stamp):
        return
    with contextlib.suppress(OSError):  # a read-only folder has no new kernels
        stamp.parent.mkdir(parents=True, exist_ok=True)
        with os.fdopen(files.open_plain(stamp.with_suffix(".lock"), os.O_RDWR | os.O_CREAT), "r+b") as lock:
            _wait_for(lock)
            if not os.path.exists(stamp):
                _compile(scene)
                files.append(stamp, b"")


def _kind(scene):
    """Short hash of the kernels of a scene: equal hashes, equal kernels."""
    kind = [commit(), scene.isothermal, scene.one_dimensional, scene.symmetric, scene.transient, scene.has_fatigue,
            scene.shear_law.law, scene.oil.viscosity, scene.numerics.precision, scene.contact.kind]
    return hashlib.sha256(json.dumps(kind).encode()).hexdigest()[:10]


def _wait_for(lock):
    with contextlib.suppress(ImportError):
        import fcntl

        fcntl.flock(lock, fcntl.LOCK_EX)


def _compile(scene):
    """Run a few steps of the scene in a process that ends normally; its result is ignored."""
    subprocess.run([sys.executable, "-c", "from tehl_taichi.runs.sweep.warm_cache import serve; serve()"],
                   input=pickle.dumps(scene),
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, "OMP_NUM_THREADS": "1"})


def serve():
    """Main function of that process; reads a scene from stdin."""
    from tehl_taichi.fatigue import assessment
    from tehl_taichi.march.passage import march

    scene = pickle.load(sys.stdin.buffer)
    runtime.start(threads=1)
    with contextlib.suppress(Error):
        short = scene.replace(**{"time.steps": STEPS}) if scene.transient else scene
        shots = list(march(short))
        if short.has_fatigue:
            assessment.run(short, shots)
