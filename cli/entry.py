"""Entry point of `tehl`: signals, pipes and encodings are set up before anything heavy is imported."""

import _thread
import atexit
import codecs
import contextlib
import gc
import io
import os
import signal
import sys
import threading
import time
import traceback
import warnings

CLOCK: dict[str, float] = {}  # "began": the command
STOPS: list[str] = []  # names of the signals that came, "" for Ctrl-C
FAILED, INTERRUPTED = 1, 4  # as in tehl_taichi.errors, which takes longer to import than a hasty Ctrl-C
AGAIN = 0.01  # s until a dropped stop comes again: by then the callback that dropped it has ended
SELDOM = 50_000, 20, 100  # new objects between searches for garbage, of which imports and kernels make hardly any: 700, 10, 10
PLAIN = {"±": "+-", "µ": "u", "μ": "u", "°": "deg ", "σ": "sigma", "τ": "tau", "κ": "kappa", "η": "eta", "ζ": "zeta",
         "₁": "1", "²": "^2", "³": "^3", "−": "-", "–": "-", "×": "x", "·": "-", "…": "...", "≤": "<=", "≥": ">=", "→": "->"}


def main():
    """Run the command line; exit codes: 0 done, 2 bad input, 3 not converged, 4 interrupted, 1 other errors."""
    end = {"code": FAILED}
    atexit.register(_leave, end)  # the first that is registered is the last that is called
    try:
        _open_closed_streams()
        _stop_as_ctrl_c_does()
        _print_in_any_encoding()
        code = _run()
        sys.stdout.flush()
    except KeyboardInterrupt as stop:
        _ignore_stops()
        name = getattr(stop, "signal", "")
        _print_last(f"{f'stopped by {name}' if name else 'interrupted'}; all stored data are kept")
        code = INTERRUPTED
    except BrokenPipeError:  # as in `tehl show STORE | head`: the reader has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        code = 0
    _ignore_stops()
    end["code"] = code
    sys.exit(code)


def _leave(end):
    """End the process; after kernel launches at once, because Python and Taichi free their memory slowly."""
    if "tehl_taichi.engine.runtime" in sys.modules:
        sys.modules["tehl_taichi.engine.runtime"].leave(end["code"])


def _run():
    """Exit code of the command in sys.argv."""
    CLOCK["began"] = time.perf_counter()
    debug = "--debug" in sys.argv
    if debug:
        sys.argv.remove("--debug")
    warnings.showwarning = lambda message, *_: print(_in_a_line(f"warning: {message}", True), file=sys.stderr)
    gc.set_threshold(*SELDOM)
    try:
        _use_plugins()
        from tehl_cli.main import app

        app()
    except SystemExit as stop:
        return _code(stop)
    except BrokenPipeError:
        raise
    except Exception as error:  # noqa: BLE001  every failure ends in one sentence
        if STOPS and not hasattr(error, "exit_code"):  # made of a stop, as C code does while it is imported
            raise _by(STOPS[-1]) from error
        if debug:
            traceback.print_exc()
        else:
            _print_last(_sentence(error))
        return getattr(error, "exit_code", FAILED)
    return 0


def _use_plugins():
    """Load the plugins of scene files in sys.argv before any registry is read."""
    files = [word.rpartition("=")[2] for word in sys.argv[1:] if word.lower().endswith(".toml")]
    if files:
        from tehl_taichi.values import plugins

        for name in files:
            plugins.use_plugins_of(name)


def _sentence(error):
    """Message of an error: system errors (a full disk) without their number; the type's name if there is no message."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    if hasattr(error, "exit_code"):
        return str(error)
    from tehl_taichi.values.escape import one_line

    return (one_line(error) or type(error).__name__) + _plugins_hint()


def _plugins_hint():
    """Text naming the plugin files that may have caused an unexpected error, "" without plugins."""
    own = sys.modules.get("tehl_taichi.values.plugins")
    if own is None or not (files := [module.__file__ for module in own.loaded_modules()]):
        return ""
    return (f". The cause may lie in {', '.join(files)}: functions of laws run in kernels and use only what "
            "tehl_taichi.engine.pointwise offers; `tehl doctor` computes their known values")


def _print_last(sentence):
    """Print the last message; errors of a closed terminal do not change the exit code."""
    with contextlib.suppress(OSError):
        print(_in_a_line(f"tehl: {sentence}"), file=sys.stderr)


def _in_a_line(text, foreign=False):
    """Text with non-printing letters (escape sequences in names) spelled; foreign: colours of another library are removed."""
    from tehl_taichi.values.escape import one_line, printable

    return printable(one_line(text) if foreign else text)


def _code(stop):
    """Exit code of a SystemExit; corrects the codes of terminal libraries for a broken pipe and for Ctrl-C."""
    if isinstance(stop.__context__, BrokenPipeError):
        raise BrokenPipeError
    if stop.code == 128 + signal.SIGINT:
        raise _by(_signal_of(stop))
    return stop.code or 0


def _signal_of(error):
    """Name of the signal of the KeyboardInterrupt behind an error, "" for Ctrl-C."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__context__
    return getattr(error, "signal", "")


class _Stopped(KeyboardInterrupt):
    """A stop by the signal with this name, "" for Ctrl-C."""

    signal: str


def _by(name):
    made = _Stopped()
    made.signal = name
    return made


def _stop_as_ctrl_c_does():
    """Let `kill` and a closed terminal stop a run like Ctrl-C, with the signal's name; signals that the caller ignores (nohup)
    stay ignored.
    """
    usual = {signal.SIGINT: signal.default_int_handler, signal.SIGTERM: signal.SIG_DFL, signal.SIGHUP: signal.SIG_DFL}
    for number, handler in usual.items():
        with contextlib.suppress(ValueError):  # not the main thread
            if signal.getsignal(number) == handler:
                signal.signal(number, _stop)
    sys.unraisablehook = _stop_again


def _ignore_stops():
    """Let further stops change nothing once the exit code is known: Python's own end dies of them. SIGQUIT ends it anyway."""
    with contextlib.suppress(ValueError):  # not the main thread
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)


def _stop(number, _):
    STOPS.append("" if number == signal.SIGINT else signal.Signals(number).name)
    raise _by(STOPS[-1])


def _stop_again(dropped):
    """Raise a stop again that Python dropped (in the callback of a weak reference, during an import)."""
    if not isinstance(dropped.exc_value, KeyboardInterrupt):
        return sys.__unraisablehook__(dropped)
    number = getattr(signal, getattr(dropped.exc_value, "signal", "") or "SIGINT")
    again = threading.Timer(AGAIN, _thread.interrupt_main, [number])
    again.daemon = True
    again.start()


def _open_closed_streams():
    """Lead the standard streams that the caller closed (`>&-`, services) nowhere; a result file would get their numbers."""
    while (number := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(number, True)
    os.close(number)
    for number, name in ((1, "stdout"), (2, "stderr")):
        if getattr(sys, name) is None:
            setattr(sys, name, io.TextIOWrapper(io.BufferedWriter(io.FileIO(number, "w", closefd=False)), "utf-8"))


def _print_in_any_encoding():
    """Spell letters that the terminal's encoding does not have."""
    codecs.register_error("spelled", _spelled)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="spelled")


def _spelled(error):
    return "".join(PLAIN.get(letter, "?") for letter in error.object[error.start : error.end]), error.end
