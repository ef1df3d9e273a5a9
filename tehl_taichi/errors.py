"""Errors of tehl_taichi: one or two sentences each, with the exit code of the command line."""

FAILED, BAD_INPUT, NOT_CONVERGED, INTERRUPTED = 1, 2, 3, 4


class Error(Exception):
    """Base of all errors that this package raises on purpose.

    Attributes
    ----------
    exit_code : int
        Exit code of the command line: 1 failed, 2 invalid input, 3 not converged, 4 interrupted.

    Examples
    --------
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
    """The scene or an argument is invalid; the message says the value, its unit and what is allowed."""

    exit_code = BAD_INPUT


class StoreError(Error):
    """The store cannot be used in this way; the message says why."""

    exit_code = BAD_INPUT


class RuntimeUnavailable(Error, RuntimeError):
    """This process or machine does not offer the requested architecture, precision or number of threads."""

    exit_code = BAD_INPUT


class NotConverged(Error, RuntimeError):
    """A step did not converge; the message says where, why and what to try. Earlier snapshots are valid."""

    exit_code = NOT_CONVERGED


class Interrupted(Error):
    """The run was stopped from outside; the store can be resumed."""

    exit_code = INTERRUPTED


class SignalInterrupt(KeyboardInterrupt):
    """A KeyboardInterrupt with the name of its signal, "" for Ctrl-C."""

    signal: str = ""


class UnknownName(Error, KeyError):
    """A run has no quantity of this name."""

    exit_code = BAD_INPUT
    __str__ = Exception.__str__  # KeyError would put it into quotes


def extra(name):
    """Command that installs an optional dependency, for the end of a message about a missing package."""
    return f"pip install 'tehl_taichi[{name}]' (in a checkout: pip install -e '.[{name}]')"


def brief(error, most=200):
    """Error of another library in one sentence: its first meaningful line, cut at `most` letters."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    text = " ".join(lines[0].split()) if lines else type(error).__name__
    return text if len(text) <= most else f"{text[:most].rsplit(' ', 1)[0]} ..."


def stopped(stop):
    """Beginning of a message about a KeyboardInterrupt: "interrupted" (Ctrl-C), or the name of its signal."""
    name = getattr(stop, "signal", "")
    return f"stopped by {name}" if name else "interrupted"


def interrupt(stop, more):
    """A KeyboardInterrupt with the signal of `stop` and a message; more: the end of the message."""
    made = SignalInterrupt(f"{stopped(stop)}{more}")
    made.signal = getattr(stop, "signal", "")
    return made
