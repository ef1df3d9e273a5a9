"""Addition of a fine window to a run: of a given factor, or as fine as needed; a search for it is resumed."""

import time
from os import PathLike

from tehl_taichi.engine import runtime
from tehl_taichi.errors import Error, Interrupted, SceneError, StoreError
from tehl_taichi.runs import single_run
from tehl_taichi.runs.progress import Progress, progress_of
from tehl_taichi.runs.stored_run import Run, check_steps
from tehl_taichi.scene import Scene, refinement, zoom_room
from tehl_taichi.store.integrity import EXTENDED, SEEKS
from tehl_taichi.store.store import Store
from tehl_taichi.values.escape import typed
from tehl_taichi.values.quantity import AUTO


def zoom(path: str | PathLike, factor: int | str = 4, *, threads: int | None = None, progress: Progress | None = None) -> Run:
    """Add a window: see :func:`tehl_taichi.zoom`."""
    runtime.check_number(threads)
    before, progress = single_run.open(path), progress_of(progress)
    _check(before, factor)
    if factor == AUTO:
        return _with_needed_window(before, threads, progress)
    return _noted(_with_window(before, factor, threads, progress), None)


def run(scene: Scene, path: str | PathLike | None = None, *, threads: int | None = None, progress: Progress | None = None,
        force: bool = False, arch: str | None = None) -> Run:
    """Run a scene and add the window that it needs, as `tehl run --zoom auto` does; arguments: of :func:`tehl_taichi.run`."""
    done = single_run.into_new_store(scene, path, force, threads, arch, progress, attrs={SEEKS: True})
    return _with_needed_window(done, threads, progress_of(progress))


def resume(path: str | PathLike, *, steps: int | None = None, threads: int | None = None, progress: Progress | None = None
           ) -> Run:
    """Resume a run, and its search for the window that it needs: see :func:`tehl_taichi.resume`."""
    check_steps(steps)
    runtime.check_number(threads)
    done = single_run.open(path)
    if steps or not (done.finished and done.store.seeks_window):  # else only its window is missing
        done = single_run.resume(path, steps=steps, threads=threads, progress=progress)
    return _with_needed_window(done, threads, progress_of(progress)) if done.store.seeks_window else done


def _check(before, factor):
    """Refuse a run that cannot have a window of this factor. Raises SceneError, StoreError."""
    if factor != AUTO:
        before.scene.replace(**{"zoom.factor": factor})
    if not before.finished:
        raise StoreError(f"{before.path} is not finished: use tehl resume {typed(before.path)} first")
    if factor and (why := zoom_room.why_none(before.scene)):
        raise SceneError(f"{before.path} cannot have a window: {why}")


def _with_window(before, factor, threads, progress):
    """The Run with a window of this factor."""
    began, scene = time.perf_counter(), before.scene.replace(**{"zoom.factor": factor})
    if scene == before.scene:
        progress.say(f"{before.path} has {f'its window of factor {factor}' if factor else 'no window'} already")
        return before
    runtime.check(threads=threads)
    return single_run.continued(before.path, scene, threads, began, progress)


def _with_needed_window(done, threads, progress):
    """Try windows in turn until the error of the largest pressure is known; return the Run, without a window if it needs
    none. The store notes the search, so that an interrupted one is resumed.
    """
    from tehl_taichi.runs import zoom_need

    if zoom_room.why_none(done.scene):  # a part too short for a window
        return _at_the_end(done)
    for factor in _factors_left(done):
        if why := refinement.no_window(done.scene, factor):
            progress.say(f"no window: {why}")
            break
        progress.say(f"{zoom_need.reason(done)}: a window of factor {factor}")
        done = _with_noted_window(done, factor, threads, progress)
        if zoom_need.settled(done):
            break
    else:
        if not done.scene.zooms:
            progress.say("this grid resolves the passage: no window is needed")
    return _at_the_end(done)


def _with_noted_window(done, factor, threads, progress):
    """The Run with a window of this factor; only an interruption leaves the search open."""
    done = _noted(done, True)
    try:
        return _with_window(done, factor, threads, progress)
    except Interrupted:
        raise
    except Error:
        _at_the_end(done)
        raise


def _factors_left(done):
    """Factors of windows to try, of a resumed search those after its last window."""
    from tehl_taichi.runs import zoom_need

    if not (done.store.seeks_window and done.scene.zooms):
        return zoom_need.factors(done)
    return () if zoom_need.settled(done) else [one for one in zoom_need.FACTORS if one > done.scene.zoom.factor]


def _at_the_end(done):
    """The run, whose store seeks a window again only if its passage is extended."""
    return _noted(done, EXTENDED if done.rest() is not None else None)


def _noted(done, state):
    """The run with a note on the state of its search for a window."""
    if done.store.window_search == state:
        return done
    with Store.write(done.path) as saved:
        saved.note_search(state)
    return single_run.open(done.path)
