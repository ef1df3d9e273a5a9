"""Parts of a time step: a part that does not converge is halved, and doubled again after a while."""

# Of a step that does not converge: it is taken in halves down to this part. With 1/16 the asperity of 100 um stops at 1.12 a on
# 128 columns, where it touches
SMALLEST = 1 / 64
# Parts that are taken before twice as much is tried again, and twice as many where that fails: on a rough surface whole steps
# fail one after the other, each at four times the work of its two halves
FIRST_PAUSE, LONGEST_PAUSE = 2, 128


class Substeps:
    """Parts 1, 1/2, 1/4 ... of the steps of a march.

    part: largest size to try next; left: number of parts before it grows; pause: that number after the next failure; failing:
    the last one failed.
    """

    def __init__(self, part=1.0, left=0, pause=FIRST_PAUSE, failing=False):
        self.part, self.left, self.pause, self.failing = float(part), int(left), int(pause), bool(failing)

    @classmethod
    def of(cls, state):
        """Substeps of a saved state, if it has them."""
        return cls(*state["parts"]) if "parts" in state else cls()

    def state(self):
        """State from which a march continues."""
        return {"parts": [self.part, self.left, self.pause, self.failing]}

    def next(self, done):
        """Next part of the step to try, after `done` of it."""
        return min(1.0 - done, self.part)

    def accept(self, part):
        """Accept `part` of a step, which converged; a smaller last part of a step does not change the size."""
        whole, self.failing = part == self.part, False
        if whole and not self.left:
            self.pause = max(FIRST_PAUSE, self.pause // 2)
        self.left = max(0, self.left - 1)
        if whole and not self.left:
            self.part = min(1.0, 2 * self.part)

    def hold(self, heat):
        """Allow another try of the smallest part, with a few columns of a film (or None) held without temperatures. Returns
        False if that does not help.
        """
        if not (heat and heat.hold()):
            return False
        self.part = SMALLEST
        return True

    def reject(self, part):
        """Reject `part` of a step, which did not converge. Returns whether half of it is worth a try."""
        if not self.failing:
            self.left, self.pause = self.pause, min(2 * self.pause, LONGEST_PAUSE)
        self.part, self.failing = part / 2, True
        return self.part >= SMALLEST
