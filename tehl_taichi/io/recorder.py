"""A run into a store without a terminal, for suites and sweeps: resumable, finished ones are left as they are."""

import time
from pathlib import Path

from tehl_taichi.io.store import Store, StoreError
from tehl_taichi.simulation import march, total_steps

EVERY = 2.0  # s between the states that a run can go on from; a thermal one has 11 MB at 257x65x9, a tenth of a step's time


class Checkpoints:
    """Which snapshots to store with their state: one in EVERY seconds, and the last."""

    def __init__(self, total):
        self.total, self.last = total, time.monotonic()

    def of(self, snapshot):
        """The state of the newest snapshot if it is due, else None."""
        if snapshot.step < self.total and time.monotonic() - self.last < EVERY:
            return None
        self.last = time.monotonic()
        return snapshot.state


def record(scene, path, progress=None):
    """March `scene` into a store at `path`, from its last checkpoint if it exists. Returns the Store.

    progress: called with (done, total) steps. Raises StoreError if the store there is of another scene, NotConverged.
    """
    path = Path(path)
    if (path / "zarr.json").exists():
        saved = Store.open(path)
        if saved.scene != scene:
            raise StoreError(f"{path} holds a run of another scene; choose another folder or remove it")
    else:
        path.parent.mkdir(parents=True, exist_ok=True)
        saved = Store.create(path, scene, next(march(scene)), total_steps(scene) + 1)
    if not saved.finished:
        states = Checkpoints(total_steps(scene))
        for snapshot in march(scene, saved.go_back()):
            saved.append(snapshot, states.of(snapshot))
            if progress:
                progress(snapshot.step, total_steps(scene))
        saved.finish({})
    return saved
