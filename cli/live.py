"""Progress on stderr: a live line in a terminal, a plain line now and then elsewhere."""

import contextlib
import sys

from tehl_taichi.study.progress import PASSAGE, Lines, line


def say(text):
    """One line on stderr; a run goes on where nobody reads it."""
    with contextlib.suppress(BrokenPipeError):
        print(text, file=sys.stderr, flush=True)


class Live(Lines):
    """What the command line shows of a run, warnings alone if `quiet`; a context manager that ends the live line."""

    def __init__(self, quiet=False):
        super().__init__()
        self.quiet, self.bar = quiet, None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.bar:
            self.bar.stop()
            self.bar = None

    def say(self, text):
        if not self.quiet:
            say(text)

    def warn(self, sentence):
        say(f"warning: {sentence}")

    def stage(self, name, done, total):
        super().stage(name, done, total)
        if name != PASSAGE:
            self.__exit__()
        elif not self.bar and done < total and not self.quiet and sys.stderr.isatty():
            self._start_bar(done)

    def _start_bar(self, done):
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

        self.bar = Progress(TextColumn("step"), MofNCompleteColumn(), BarColumn(), TimeRemainingColumn(),
                            TextColumn("{task.description}"), console=Console(stderr=True))
        self.task = self.bar.add_task("", total=self.total, completed=done)
        self.bar.start()

    def step(self, snapshot):
        if self.bar:
            self.bar.update(self.task, completed=snapshot.step, description=line(snapshot))
        else:
            super().step(snapshot)
