"""The command line: in the process of the tests, and in one of its own (which loads the compiled kernels anew, seconds)."""

import contextlib
import io
import os
import subprocess
import sys
import warnings
from types import SimpleNamespace

CALL = (sys.executable, "-c", "from tehl_cli.entry import main; main()")


def process(*words, cwd=None):
    """`tehl` with these words in a process of its own: returncode, stdout, stderr."""
    return subprocess.run([*CALL, *map(str, words)], capture_output=True, text=True, cwd=cwd)


def here(*words, cwd=None):
    """The same in this process, on two threads."""
    from tehl_cli import entry

    from tehl_taichi.engine import runtime

    runtime.start(threads=2)
    out, err, argv, folder, told = io.StringIO(), io.StringIO(), sys.argv, os.getcwd(), warnings.showwarning
    sys.argv = ["tehl", *map(str, words)]
    try:
        os.chdir(cwd or folder)
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = entry._run()
    finally:
        os.chdir(folder)
        sys.argv, warnings.showwarning = argv, told
    return SimpleNamespace(returncode=code, stdout=out.getvalue(), stderr=err.getvalue())
