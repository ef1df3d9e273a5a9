"""Everything that tehl_taichi refuses or gives up is an Error: one or two sentences, and the exit code of the command line."""

import re

FAILED, BAD_INPUT, NOT_CONVERGED, INTERRUPTED = 1, 2, 3, 4


class Error(Exception):
    """Base of all errors raised on purpose; the message is for people, exit_code for the command line.

    >>> import tehl_taichi as tehl
    >>> for wrong in (lambda: tehl.scene("gear").replace(load=-5), lambda: tehl.open("nothing.zarr")):
    ...     try:
    ...         wrong()
    ...     except tehl.Error as error:
    ...         print(type(error).__name__, error.exit_code)
    SceneError 2
    StoreError 2
    """

    exit_code = FAILED


class SceneError(Error, ValueError):
    """The scene cannot be simulated as it is described."""

    exit_code = BAD_INPUT


class StoreError(Error):
    """The store cannot be used as asked; one sentence says why."""

    exit_code = BAD_INPUT


class RuntimeUnavailable(Error, RuntimeError):
    """What is asked of this process or machine (architecture, precision, threads) cannot be had."""

    exit_code = BAD_INPUT


class NotConverged(Error, RuntimeError):
    """A step did not converge; the message says where, why and what to try. Earlier snapshots are good."""

    exit_code = NOT_CONVERGED


class Interrupted(Error):
    """Stopped from outside in the middle of a run; the store can be resumed."""

    exit_code = INTERRUPTED


def extra(name):
    """How an optional part is installed, for the end of a sentence about what is missing."""
    return f"pip install 'tehl_taichi[{name}]' (in a checkout: pip install -e '.[{name}]')"


def brief(error, most=200):
    """Somebody else's error in one sentence: the first line that says something, without what a dump shows below it."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    text = " ".join(lines[0].split()) if lines else type(error).__name__
    return text if len(text) <= most else f"{text[:most].rsplit(' ', 1)[0]} ..."


def stopped(stop):
    """How a sentence about a KeyboardInterrupt begins: "interrupted" (Ctrl-C), or by which signal it was stopped, where that
    is its text (as the command line has it: "SIGTERM") or begins it ("stopped by SIGTERM after 2 steps")."""
    found = re.match(r"(?:stopped by )?(SIG[A-Z]+)\b", str(stop))
    return f"stopped by {found[1]}" if found else "interrupted"
