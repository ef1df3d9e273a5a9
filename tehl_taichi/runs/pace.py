"""Pace of the steps, and the remaining time of a passage as text."""

import time
from collections import deque

LAST = 20  # steps whose mean is the pace: those of a rough scan take twenty times as long once it is in the contact
FEWEST = 3  # steps needed for one


class Pace:
    """Clock of a passage; `at` marks the end of each step."""

    def __init__(self):
        self.passed: deque[tuple[int, float]] = deque(maxlen=LAST + 1)

    def at(self, done):
        """Mark that `done` steps are complete; a number that does not increase starts another passage."""
        if self.passed and done <= self.passed[-1][0]:
            self.passed.clear()
        self.passed.append((done, time.perf_counter()))

    def left(self, total):
        """Text of the remaining time of `total` steps; "" while it is unknown."""
        steps, seconds = (last - first for first, last in zip(self.passed[0], self.passed[-1])) if self.passed else (0, 0.0)
        rest = total - self.passed[-1][0] if self.passed else 0
        return f"{about(rest * seconds / steps)} left" if steps >= FEWEST and rest else ""


def about(seconds):
    """Text of an approximate time."""
    if seconds < 50:
        return f"about {max(seconds, 1):.0f} s"
    return f"about {seconds / 60:.0f} min" if seconds < 90 * 60 else f"about {seconds / 3600:.1f} h"
