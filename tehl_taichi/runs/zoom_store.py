"""Addition of a fine window to a finished run: of a given factor, or as fine as needed."""

import time
from os import PathLike

from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.runs import single_run
from tehl_taichi.runs.progress import Progress, progress_of
from tehl_taichi.runs.stored_run import Run
from tehl_taichi.scene import refinement, zoom_room
from tehl_taichi.values.escape import typed
from tehl_taichi.values.quantity import AUTO


def zoom(path: str | PathLike, factor: int | str = 4, *, threads: int | None = None, progress: Progress | None = None) -> Run:
    """Add a window: see :func:`tehl_taichi.zoom`."""
    from tehl_taichi.engine import runtime

    runtime.check_number(threads)
    if factor == AUTO:
        return _zoom_as_needed(path, threads, progress_of(progress))
    began = time.perf_counter()
    before, progress = single_run.open(path), progress_of(progress)
    scene = before.scene.replace(**{"zoom.factor": factor})
    _check(before, factor)
    if scene == before.scene:
        progress.say(f"{before.path} has {f'its window of factor {factor}' if factor else 'no window'} already")
        return before
    runtime.check(threads=threads)
    return single_run.continued(before.path, scene, threads, began, progress)


def _check(before, factor):
    """Refuse a run that cannot have a window of this factor. Raises SceneError, StoreError."""
    if not before.finished:
        raise StoreError(f"{before.path} is not finished: use tehl resume {typed(before.path)} first")
    if factor and (why := zoom_room.why_none(before.scene)):
        raise SceneError(f"{before.path} cannot have a window: {why}")


def _zoom_as_needed(path, threads, progress):
    """Try windows in turn until the error of the largest pressure is known; return the Run, without a window if it needs
    none."""
    from tehl_taichi.runs import zoom_need

    done = single_run.open(path)
    _check(done, AUTO)
    for factor in zoom_need.factors(done):
        if why := refinement.no_window(done.scene, factor):
            progress.say(f"no window: {why}")
            break
        progress.say(f"{zoom_need.reason(done)}: a window of factor {factor}")
        done = zoom(path, factor, threads=threads, progress=progress)
        if zoom_need.settled(done):
            break
    else:
        if not done.scene.zooms:
            progress.say("this grid resolves the passage: no window is needed")
    return done
