"""Progress on stderr: a bar and curves in a terminal, otherwise plain lines."""

import contextlib
import sys
import time
from typing import Any

from tehl_cli.stdout import put

from tehl_taichi.runs.progress import LATE, PASSAGE, STEADY, Lines, line


def say(text):
    """Print one line on stderr; a run continues if that is closed."""
    with contextlib.suppress(BrokenPipeError):
        put(text, file=sys.stderr)


LOADING, SOLVING = "loading", "steady contact: loading kernels (new ones are compiled), then solving"


class StatusLine:
    """Status text in the last line of a terminal, until the next text; on: whether stderr is a terminal."""

    def __init__(self, on):
        self.on, self.text = on, ""

    def show(self, text):
        """Replace the text; an empty text removes the line."""
        if self.on and (text or self.text):
            with contextlib.suppress(OSError):  # a terminal that was closed
                sys.stderr.write(f"\r\x1b[K{text}")
                sys.stderr.flush()
        self.text = text

    @contextlib.contextmanager
    def away(self):
        """Remove the line while something else is printed."""
        text = self.text
        self.show("")
        yield
        self.show(text)


class Live(Lines):
    """Progress of a run in the terminal: only warnings if `quiet`, a bar without curves if not `curves`.

    A context manager that ends them. A status line shows the activity before the first step; the last picture of a passage
    stays.
    """

    DRAWN = 0.5  # s at least between two pictures
    SHARE = 0.005  # of the time at most for drawing

    def __init__(self, quiet=False, curves=True):
        super().__init__()
        self.quiet, self.due, self.shown = quiet, 0.0, ""
        self.bar: Any = None
        self.curves: Any = None
        self.shows_curves = curves and not quiet and sys.stdout.isatty() and sys.stderr.isatty()
        self.status = StatusLine(not quiet and sys.stderr.isatty())

    def __enter__(self):
        self.status.show(LOADING)
        return self

    def __exit__(self, *_):
        self.status.show("")
        self._end_bar()

    def _end_bar(self):
        if self.bar:
            with contextlib.suppress(OSError):  # a terminal that was closed: the reason for the end is still to be printed
                self.bar.stop()
            self.bar = None

    def say(self, text):
        if not self.quiet:
            with self.status.away():
                say(text)

    def warn(self, sentence):
        with self.status.away():
            say(f"warning: {sentence}")

    def stage(self, name, done, total):
        self.status.show(SOLVING if name == STEADY and done < total else "")
        if name != self.shown:
            self._end_bar()
            self.shown = name
        if not self.bar and done < total and name in (PASSAGE, *LATE) and not self.quiet and sys.stderr.isatty():
            self._start_bar(name, done, total)
        if name == PASSAGE or not self.bar:
            super().stage(name, done, total)
        else:
            self._when_due(lambda: self.bar.show(done), done == total)

    def _start_bar(self, name, done, total):
        from tehl_cli.live_curves import Curves, CurvesBar

        self.curves, self.due = Curves(), 0.0
        self.bar = CurvesBar(self.curves, total, done, "step" if name == PASSAGE else name)
        self.bar.start()

    def step(self, snapshot):
        if not self.bar:
            return super().step(snapshot)
        self.beyond_steel(snapshot)
        self._when_due(lambda: self._draw(snapshot), snapshot.step == self.total)

    def _when_due(self, draw, last):
        """Draw unless the last picture is very recent; last: draw in any case."""
        if (began := time.perf_counter()) >= self.due or last:
            draw()
            done = time.perf_counter()
            self.due = done + max(self.DRAWN, (done - began) / self.SHARE)

    def _draw(self, snapshot):
        if self.shows_curves:
            self.curves.take(snapshot)
        self.bar.show(snapshot.step, line(snapshot))
