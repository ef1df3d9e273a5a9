"""Aitken's relaxation of rounds that overshoot each other (at the outlet)."""

import numpy as np

LEAST_SHARE = 0.2  # of a round's change that is taken


class Relaxation:
    """The rounds of one step; :meth:`relaxed` after each that is to be relaxed."""

    def __init__(self):
        self.change, self.share = None, 1.0

    def relaxed(self, before, after):
        """Between the temperatures before and after a round: from the changes of the last two."""
        change = after - before
        if self.change is not None:
            bend = change - self.change
            share = -self.share * float(np.vdot(self.change, bend) / np.vdot(bend, bend))
            self.share = min(max(share, LEAST_SHARE), 1.0)
        self.change = change
        return before + self.share * change
