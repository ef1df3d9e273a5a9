"""A run into a store without a terminal, for suites and sweeps: resumable, finished ones are left as they are."""

from pathlib import Path

from tehl_taichi.io.store import Store, StoreError
from tehl_taichi.simulation import march, total_steps


def record(scene, path, progress=None):
    """March `scene` into a store at `path`, from its last committed step if it exists. Returns the Store.

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
        for snapshot in march(scene, saved.last_state()):
            saved.append(snapshot)
            if progress:
                progress(snapshot.step, total_steps(scene))
        saved.finish({})
    return saved
