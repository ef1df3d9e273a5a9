"""A run on disk, as Python sees it."""

from pathlib import Path


class Run:
    """A run and its store: what :func:`tehl_taichi.run`, :func:`tehl_taichi.open` and :func:`tehl_taichi.resume` give.

    store: the :class:`tehl_taichi.io.store.Store` behind it, whose `fields(n)` are the (nx+1, ny+1) arrays in SI of entry n.
    """

    def __init__(self, store):
        self.store = store

    @property
    def path(self) -> Path:
        """Folder of the store."""
        return self.store.path

    @property
    def scene(self):
        """The :class:`tehl_taichi.Scene` that it is of."""
        return self.store.scene

    @property
    def finished(self) -> bool:
        """Whether it reached the end that it was given, with its fatigue and its summary."""
        return self.store.finished

    @property
    def summary(self) -> dict:
        """The JSON object of `tehl run --json` (SI units in the names), {} of a run that is not finished."""
        return self.store.summary

    @property
    def warnings(self) -> list:
        """What is doubtful, a sentence each; of a run that is not finished: in its scene."""
        return self.store.warnings

    def rest(self, steps=None):
        """The scene with which :func:`tehl_taichi.resume` goes on: with `steps` more, or to the end that the run was given, of
        a finished run to the end of its passage. None where nothing is left."""
        from tehl_taichi.scene.route import continued

        if not self.finished and not steps:
            return self.scene
        found = continued(self.scene, self.store.last_step, steps)
        return found or (None if self.finished else self.scene)

    def __repr__(self):
        state = "finished" if self.finished else "not finished"
        return f"<tehl.Run {self.scene.name}: {self.store.last_step} steps, {state}, {self.path}>"
