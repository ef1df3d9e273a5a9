"""Progress of a fatigue search: its consecutive passes are reported as one."""

from tehl_taichi.fatigue.depth_search import passes


class PassProgress:
    """Progress function of a search with `passes` consecutive passes.

    It is called with (done, total) parts of the present pass, and calls progress(done, total) in hundredths of a pass: with one
    total, never decreasing. progress: a function, or None.
    """

    EACH = 100

    def __init__(self, progress, passes):
        self.progress, self.total, self.through = progress, self.EACH * passes, 0
        self._report(0)

    @classmethod
    def of(cls, progress, scene, passage, early=None):
        """Progress of a :func:`tehl_taichi.fatigue.assessment.run`: stresses and search of every block of rows at every listed
        depth, then those below rows for the worst depth.
        """
        ladder = bool(scene.fatigue.depths)
        layers = 1 + len(scene.fatigue.listed)
        return cls(progress, 2 * layers * len(passage.row_blocks()) + (2 + passes(passage, early)) * ladder)

    def __call__(self, done, total):
        self._report(self.through + self.EACH * done // total)
        self.through += self.EACH * (done == total)

    def end(self):
        """Report the end, including parts that were not needed."""
        self._report(self.total)

    def _report(self, done):
        if self.progress:
            self.progress(done, self.total)
