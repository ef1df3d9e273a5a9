"""Progress on stderr: a live line in a terminal, a plain line now and then elsewhere."""

import contextlib
import sys
import time


def say(text):
    """One line on stderr; a run goes on where nobody reads it."""
    with contextlib.suppress(BrokenPipeError):
        print(text, file=sys.stderr, flush=True)


class Live:
    """Context manager; call :meth:`step` after every accepted step."""

    EVERY = 5.0  # seconds between plain lines

    def __init__(self, total, done, quiet):
        self.total, self.done, self.quiet = total, max(done, 0), quiet
        self.bar = None

    def __enter__(self):
        self.last = time.perf_counter()
        if not self.quiet and self.total and sys.stderr.isatty():
            self._start_bar()
        return self

    def _start_bar(self):
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

        self.bar = Progress(TextColumn("step"), MofNCompleteColumn(), BarColumn(), TimeRemainingColumn(),
                            TextColumn("{task.description}"), console=Console(stderr=True))
        self.task = self.bar.add_task("", total=self.total, completed=self.done)
        self.bar.start()

    def __exit__(self, *_):
        if self.bar:
            self.bar.stop()

    def step(self, snapshot):
        """Show one accepted step."""
        self.done = snapshot.step
        if self.bar:
            self.bar.update(self.task, completed=self.done, description=_line(snapshot))
        elif not self.quiet and time.perf_counter() - self.last > self.EVERY:
            self.last = time.perf_counter()
            say(f"step {self.done}/{self.total}  {_line(snapshot)}")


def _line(snapshot):
    s = snapshot.scalars
    return (f"p_max {s['p_max_Pa'] / 1e9:.3f} GPa  h_min {s['h_min_m'] * 1e6:.4f} um  residual {s['residual']:.0e}  "
            f"cycles {s['cycles']:.0f}" + (f"  film {s['film_max_C']:.0f} °C" if "film_max_C" in s else ""))
