"""Aitken's relaxation for rounds that alternate about the solution (at the outlet)."""

import numpy as np

LEAST_SHARE = 0.2  # of a round's change that is taken


class Relaxation:
    """Relaxation of the rounds of one step; call :meth:`relaxed` after each round that needs it."""

    def __init__(self):
        self.change, self.share = None, 1.0

    def relaxed(self, before, after):
        """Relaxed temperatures between those before and after a round, from the changes of the last two rounds."""
        change = after - before
        if self.change is not None:
            bend = change - self.change
            share = -self.share * float(np.vdot(self.change, bend) / np.vdot(bend, bend))
            self.share = min(max(share, LEAST_SHARE), 1.0)
        self.change = change
        return before + self.share * change
