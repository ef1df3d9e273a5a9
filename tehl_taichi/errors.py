"""Errors of tehl_taichi: one or two sentences each, with the exit code of the command line."""

import contextlib
import re

FAILED, BAD_INPUT, NOT_CONVERGED, INTERRUPTED = 1, 2, 3, 4

# Options that are arguments or keys of a scene in Python; outside of whole commands, which stand in backquotes
ARGUMENTS = {"--out": "path", "--force": "force=True", "--pixel-y": "pixel_y", "--threads-per-worker": "threads_per_worker",
             "--thermal": "thermal.on=True", "--steady": "time.steady_only=True", "--grid": "grid.nx", "--map": "shown",
             "--ball-diameter": "dimensions: diameter", "--balls": "count", "--pitch-diameter": "pitch_diameter",
             **{f"--{name}": name for name in ("workers", "threads", "scheduler", "keep", "samples", "lay", "residual",
                                               "format", "over")}}
VALUES = ((re.compile(r"(--set [\w.]+=\S+) (?=--(?:set|grid) )"), r"\1, "),
          (re.compile(r"--grid (\d+)x(\d+)"), r"grid.nx=\1 and grid.ny=\2"), (re.compile(r"--grid (\d+)"), r"grid.nx=\1"),
          (re.compile(r"--zoom (\d+)"), r"zoom.factor=\1"), (re.compile(r"--precision (\w+)"), r"numerics.precision='\1'"),
          (re.compile(r"--(workers|threads) (\d+)"), r"\1=\2"), (re.compile(r"--set (?=[\w.]+=)"), ""))
COMMAND, OPTION = re.compile(r"(`[^`]*`)"), re.compile(r"--[a-z]+(?:-[a-z]+)*")
_typed = False


def are_options_typed():
    """Whether errors name the options of the command line: workers take this over from the process that started them."""
    return _typed


@contextlib.contextmanager
def typed_options(typed=True):
    """Errors raised within name the options of the command line, otherwise the arguments of Python."""
    global _typed
    before, _typed = _typed, typed
    try:
        yield
    finally:
        _typed = before


def for_reader(text):
    """The text with the options of the command line, or in Python with its arguments (see :func:`typed_options`)."""
    if _typed or not isinstance(text, str) or "--" not in text:
        return text
    parts = COMMAND.split(text)
    parts[::2] = map(_as_arguments, parts[::2])
    return "".join(parts)


def _as_arguments(text):
    for option, argument in VALUES:
        text = option.sub(argument, text)
    return OPTION.sub(lambda found: ARGUMENTS.get(found[0], found[0]), text)


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

    def __init__(self, *args):
        super().__init__(*map(for_reader, args))


class SceneError(Error, ValueError):
    """The scene or an argument is invalid; the message says the value, its unit and what is allowed."""

    exit_code = BAD_INPUT


class NoArithmetic(SceneError, TypeError):
    """A Quantity was used in place of its value."""


class StoreError(Error):
    """The store cannot be used in this way; the message says why."""

    exit_code = BAD_INPUT


class DiskError(StoreError):
    """The disk is full or fails; with free space the same command works."""

    exit_code = FAILED


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
