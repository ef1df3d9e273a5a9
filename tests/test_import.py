"""What importing the package changes in the process of its user: five environment variables, and only those not yet set."""

import os
import subprocess
import sys

CODE = """
import locale, logging, os, signal, sys, threading, warnings
import numpy as np
def state():
    return [locale.setlocale(locale.LC_ALL), {s: signal.getsignal(s) for s in signal.valid_signals()}, list(warnings.filters),
            np.geterr(), np.get_printoptions(), threading.active_count(), sys.excepthook, logging.root.handlers[:],
            sys.getrecursionlimit(), list(sys.path), os.getcwd(), float(np.float64(1e-310) * 0.5)]
before, names = state(), dict(os.environ)
import tehl_taichi
assert state() == before
print(*sorted(key for key in os.environ if os.environ[key] != names.get(key)))
"""
OURS = ["ENABLE_TAICHI_HEADER_PRINT", "OMP_WAIT_POLICY", "OPENBLAS_NUM_THREADS", "TI_ENABLE_PYBUF", "TI_SKIP_VERSION_CHECK"]


def changed(**given):
    """Names of the environment variables that the import changes."""
    clean = {key: value for key, value in os.environ.items() if key not in OURS}
    return subprocess.run([sys.executable, "-c", CODE], env={**clean, **given}, capture_output=True, text=True,
                          check=True).stdout.split()


def test_an_import_changes_nothing_but_unset_variables():
    assert changed() == OURS
    assert changed(OPENBLAS_NUM_THREADS="4") == [name for name in OURS if name != "OPENBLAS_NUM_THREADS"]
