"""tehl_taichi: transient thermal elastohydrodynamic contacts with surface features, and the fatigue they cause.

Importing this package does not import taichi; the compiled parts load when a simulation starts.

>>> import tehl_taichi as tehl
>>> tehl.scene("gear").replace(srr=-0.12).operation.u_a < 8.5
True
"""

import os

# Waiting FFT or BLAS threads must sleep, not spin: a spinning pool stalls every other pool on a busy machine.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")
# the products here are small: threaded BLAS only costs (and stalls on a busy machine)
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# its banner would go to stdout, which belongs to `--json`
os.environ.setdefault("ENABLE_TAICHI_HEADER_PRINT", "0")

__version__ = "0.2.0"
__all__ = ["Error", "Lines", "Progress", "Run", "Scene", "__version__", "compare", "flank", "march", "open",
           "resume", "run", "scene", "simulate"]


def simulate(scene, precision=None):
    """All snapshots of `scene` as a list; long runs are better streamed with :func:`march` or `tehl run`."""
    return list(march(scene, precision=precision))


from tehl_taichi import flank, march, scene  # noqa: E402  callable: scene("gear"); after the settings above, which numpy reads
from tehl_taichi.errors import Error  # noqa: E402
from tehl_taichi.scene import Scene  # noqa: E402
from tehl_taichi.study import Lines, Progress, Run, compare, open, resume, run  # noqa: E402
