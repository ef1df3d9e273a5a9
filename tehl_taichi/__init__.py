"""tehl_taichi: transient thermal elastohydrodynamic contacts with surface features, and the fatigue they cause.

Importing this package does not import taichi; the compiled parts load when a simulation starts.

>>> import tehl_taichi as tehl
>>> tehl.scene("gear").replace(srr=-0.12).operation.u_a < 8.5
True
"""

import importlib
import os
import sys
import warnings
from types import ModuleType
from typing import TYPE_CHECKING

# Waiting FFT or BLAS threads must sleep, not spin: a spinning pool stalls every other pool on a busy machine.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")
# the products here are small: threaded BLAS only costs (and stalls on a busy machine)
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# its banner would go to stdout, which belongs to `--json`
os.environ.setdefault("ENABLE_TAICHI_HEADER_PRINT", "0")
# in a notebook every launch would look for what its kernel printed: ours print nothing
os.environ.setdefault("TI_ENABLE_PYBUF", "0")
# a thread would ask its makers for a newer version at every start of a day, from users' machines, and be cut off at a short end
os.environ.setdefault("TI_SKIP_VERSION_CHECK", "ON")

__version__ = "0.9.0"  # the only place; CITATION.cff repeats it, which a test compares
__released__ = "2026-11-27"

# after the settings above, which numpy reads
from tehl_taichi.api import (  # noqa: E402
    FUNCTIONS,
    animate,
    bearing,
    cam,
    compare,
    crack,
    export,
    fatigue,
    flank,
    march,
    report,
    resume,
    run,
    scene,
    simulate,
    stresses,
    sweep,
    traction,
    zoom,
)
from tehl_taichi.api import open as open
from tehl_taichi.errors import Error, Interrupted, NotConverged, RuntimeUnavailable, SceneError, StoreError, UnknownName  # noqa: E402

if TYPE_CHECKING:
    from tehl_taichi.crack.analysis import CrackResult
    from tehl_taichi.fatigue.search_result import SearchResult
    from tehl_taichi.march.snapshot import Snapshot
    from tehl_taichi.runs.bearing.rolling_bearing import RollingBearing
    from tehl_taichi.runs.bearing.stored_bearing import Bearing
    from tehl_taichi.runs.cam.stored_cam import Cam
    from tehl_taichi.runs.compare import Comparison
    from tehl_taichi.runs.compare_places import PlaceComparison
    from tehl_taichi.runs.flank.stored_flank import Flank
    from tehl_taichi.runs.progress import Lines, Progress
    from tehl_taichi.runs.stored_run import Run
    from tehl_taichi.runs.sweep.study_table import Study
    from tehl_taichi.runs.traction.traction_rows import Traction
    from tehl_taichi.scene.description import Scene
    from tehl_taichi.scene.feature import Feature
    from tehl_taichi.scene.gear_pair import GearPair
    from tehl_taichi.scene.oil import Oil
    from tehl_taichi.scene.sections import (
        Body,
        Contact,
        Fatigue,
        Grid,
        Numerics,
        Operation,
        Output,
        Rheology,
        Thermal,
        Time,
        Zoom,
    )
    from tehl_taichi.values.estimate import Quantity

# classes and the modules that hold them, loaded when they are used: the command line needs a few of them only
CLASSES = {"Scene": "scene.description", "Feature": "scene.feature", "Oil": "scene.oil", "GearPair": "scene.gear_pair",
           **dict.fromkeys(("Body", "Contact", "Fatigue", "Grid", "Numerics", "Operation", "Output", "Rheology", "Thermal",
                            "Time", "Zoom"), "scene.sections"),
           "Run": "runs.stored_run", "Study": "runs.sweep.study_table", "Flank": "runs.flank.stored_flank",
           "Traction": "runs.traction.traction_rows", "Cam": "runs.cam.stored_cam",
           "Bearing": "runs.bearing.stored_bearing", "RollingBearing": "runs.bearing.rolling_bearing",
           "Comparison": "runs.compare", "PlaceComparison": "runs.compare_places",
           "Snapshot": "march.snapshot", "SearchResult": "fatigue.search_result", "CrackResult": "crack.analysis",
           "Lines": "runs.progress", "Progress": "runs.progress", "Quantity": "values.estimate"}
OLD_NAMES = {"FatigueResult": "SearchResult"}  # to 0.8
# not `open`: `from tehl_taichi import *` leaves the builtin alone
__all__ = ["Bearing", "Body", "Cam", "Comparison", "Contact", "CrackResult", "Error", "Fatigue", "Feature", "Flank", "GearPair",
           "Grid", "Interrupted", "Lines", "NotConverged", "Numerics", "Oil", "Operation", "Output", "PlaceComparison",
           "Progress", "Quantity", "Rheology", "RollingBearing", "Run", "RuntimeUnavailable", "Scene", "SceneError",
           "SearchResult", "Snapshot", "StoreError", "Study", "Thermal", "Time", "Traction", "UnknownName", "Zoom",
           "__version__", "animate", "bearing", "cam", "compare", "crack", "export", "fatigue", "flank", "march", "report",
           "resume", "run", "scene", "simulate", "stresses", "sweep", "traction", "zoom"]


def __getattr__(name):
    if name in OLD_NAMES:
        warnings.warn(f"tehl.{name} is tehl.{OLD_NAMES[name]} from version 0.9 on", DeprecationWarning, stacklevel=2)
        name = OLD_NAMES[name]
    if name not in CLASSES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(f"{__name__}.{CLASSES[name]}"), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted([*__all__, "open"])


class _Package(ModuleType):
    """Module type that keeps the function `tehl_taichi.march` when the folder `march` is imported."""

    def __setattr__(self, name, value):
        if not (name in FUNCTIONS and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
