"""tehl_taichi: transient thermal elastohydrodynamic contacts with surface features, and the fatigue they cause.

Importing this package does not import taichi; the compiled parts load when a simulation starts.

>>> import tehl_taichi as tehl
>>> tehl.scene("gear").replace(srr=-0.12).operation.u_a < 8.5
True
"""

import os
from typing import TYPE_CHECKING

# Waiting FFT or BLAS threads must sleep, not spin: a spinning pool stalls every other pool on a busy machine.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")
# the products here are small: threaded BLAS only costs (and stalls on a busy machine)
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# its banner would go to stdout, which belongs to `--json`
os.environ.setdefault("ENABLE_TAICHI_HEADER_PRINT", "0")
# in a notebook every launch would look for what its kernel printed: ours print nothing
os.environ.setdefault("TI_ENABLE_PYBUF", "0")

__version__ = "0.8.0"
__all__ = ["Error", "Interrupted", "Lines", "NotConverged", "Progress", "Run", "RuntimeUnavailable", "Scene", "SceneError",
           "StoreError", "__version__", "animate", "compare", "crack", "export", "fatigue", "flank", "march", "open", "report",
           "resume", "run", "scene", "simulate", "sweep"]

# after the settings above, which numpy reads
from tehl_taichi.called import offered  # noqa: E402
from tehl_taichi.errors import Error, Interrupted, NotConverged, RuntimeUnavailable, SceneError, StoreError  # noqa: E402

if TYPE_CHECKING:
    from tehl_taichi.crack import crack
    from tehl_taichi.export import export
    from tehl_taichi.fatigue import fatigue
    from tehl_taichi.figures import animate
    from tehl_taichi.flank import flank
    from tehl_taichi.io.found import find as scene
    from tehl_taichi.march import march, simulate
    from tehl_taichi.report import report
    from tehl_taichi.results.opened import open
    from tehl_taichi.scene import Scene
    from tehl_taichi.study.compare import compare
    from tehl_taichi.study.many import sweep
    from tehl_taichi.study.progress import Lines, Progress
    from tehl_taichi.study.single import resume, run
    from tehl_taichi.study.stored_run import Run
else:  # the command line asks for a few of them only: 0.3 s of its start
    __getattr__ = offered(__name__, {
        "animate": "figures", "simulate": "march", "Scene": "scene", "compare": "study.compare", "sweep": "study.many",
        "Lines": "study.progress", "Progress": "study.progress", "open": "results.opened", "resume": "study.single",
        "run": "study.single", "Run": "study.stored_run"}, ("crack", "export", "fatigue", "flank", "march", "report", "scene"))
