"""One whole run into a store: steady start, passage, stresses and fatigue, error bars, summary; resuming of a run."""

import contextlib
import functools
import json
import time
from os import PathLike
from pathlib import Path

from tehl_taichi.engine import runtime
from tehl_taichi.engine.taichi_patches.prebound import binding_seconds
from tehl_taichi.errors import StoreError, for_reader, interrupt
from tehl_taichi.fatigue.pressure_alone import WITHOUT, searched, why_none
from tehl_taichi.runs import run_in_stage
from tehl_taichi.runs.progress import ERRORS, PASSAGE, STEADY, Progress, progress_of
from tehl_taichi.runs.provenance import provenance
from tehl_taichi.runs.run_in_memory import run_in_bytes
from tehl_taichi.runs.stored_run import Run, check_steps
from tehl_taichi.runs.summary.film_warnings import MOST_FRICTION
from tehl_taichi.scene import Scene, memory_demand, zoom_room
from tehl_taichi.scene.scene_warnings import preview
from tehl_taichi.scene.timeline import most_steps, total_steps
from tehl_taichi.store.integrity import is_store
from tehl_taichi.store.json_values import plain
from tehl_taichi.store.load_scene import find
from tehl_taichi.store.store import Store
from tehl_taichi.store.store_draft import CaseDraft, StoreDraft
from tehl_taichi.values.checks import flag
from tehl_taichi.values.coded_text import unknown_of
from tehl_taichi.values.coded_warning import texts
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.escape import typed
from tehl_taichi.values.path_arguments import folder_of, path_of


def run(scene: Scene | str | PathLike, path: str | PathLike | None = None, *, force: bool = False, threads: int | None = None,
        arch: str | None = None, progress: Progress | None = None) -> Run:
    """Run a scene: see :func:`tehl_taichi.run`."""
    flag("force", force)
    return into_new_store(find(scene), path, force, threads, arch, progress)


def into_new_store(scene, path, force=False, threads=None, arch=None, progress=None, case=False, attrs=()):
    """Run as :func:`run`; case: the store is part of a study or a flank and lies inside it; attrs: more attributes of it."""
    began, progress = time.perf_counter(), progress_of(progress)
    runtime.check(arch, threads)
    path = None if path is None else path_of("path", path)
    _check_memory(scene)
    place = (CaseDraft(path) if case else StoreDraft(path, force) if path is not None
             else StoreDraft.fresh(Path("runs"), scene.name))
    with place, _stoppable(place.path, place):
        runtime.start_or_join(arch, threads)
        return _begin(scene, place, _Clock(began), progress, dict(attrs))


def check(scene, path=None, force=False, threads=None, arch=None):
    """Raise the errors of :func:`run` that come before its first result, without writing anything."""
    runtime.check(arch, threads)
    _check_memory(scene)
    if path is not None:
        StoreDraft.check(path_of("path", path), force)


def _check_memory(scene):
    """Raise SceneError if a run of the scene needs more memory than is available."""
    memory_demand.check(scene, run_in_bytes(scene))


def open(path: str | PathLike, stand_in: bool = False) -> Run:
    """Open the run in the store at `path`: finished, running or interrupted. Raises StoreError without a store, or for a
    damaged one.

    stand_in: also open a run whose law is not installed here, to show and plot it.
    """
    return Run(Store.open(folder_of(path), stand_in))


def resume(path: str | PathLike, *, steps: int | None = None, threads: int | None = None,
           progress: Progress | None = None) -> Run:
    """Resume a run: see :func:`tehl_taichi.resume`."""
    began = time.perf_counter()
    check_steps(steps)
    runtime.check_number(threads)
    before, progress = open(path), progress_of(progress)
    path = before.path
    rest = before.rest(steps)
    if rest is None:
        return before
    runtime.check(threads=threads)
    return continued(path, rest, threads, began, progress)


def run_or_resume(scene: Scene, path: str | PathLike, *, threads: int | None = None, progress: Progress | None = None) -> Run:
    """Finished run of `scene` in the store at `path`: the existing one, resumed, or run now.

    Raises StoreError if the store has another scene, and the errors of :func:`run` and :func:`resume`.
    """
    if not is_store(path):
        return into_new_store(scene, path, threads=threads, progress=progress, case=True)
    there = open(path)
    check_version(path, there)
    if there.scene != scene:
        raise StoreError(f"{path} holds a run of another scene; choose another folder or remove it")
    return there if there.finished else resume(path, threads=threads, progress=progress)


def check_version(path, run):
    """Refuse a run of another version as part of a new result. Raises StoreError."""
    if run.store.other_version:
        raise StoreError(f"{path} was {run.store.other_version}: results of two versions are not mixed; choose another folder "
                         "or remove it")


def continued(path, scene, threads, began, progress):
    """Continue the store at `path` to the end of `scene`."""
    from tehl_taichi.runs import background_errors

    _check_memory(scene)
    with _stoppable(path), Store.write(path) as saved:
        steady = {name: saved.needed(name) for name in ("steady_error", "steady_unknown")}
        steady |= {name: saved.known(name) for name in ("steady_parts", "steady_domain", "steady_unknown_codes",
                                                   "steady_contact_alone")}
        runtime.start_or_join(threads=threads)
        state = saved.go_back()
        clock = _Clock(began, _spent(saved))
        longer = saved.extended(scene) if scene != saved.scene else contextlib.nullcontext()
        with longer, background_errors.coarse_grid_runs(scene) as coarse_answers_until:
            return _finish(saved, state, steady, clock, progress, coarse_answers_until)


def _spent(saved):
    """Seconds spent on a store: as recorded at its end, else the sum of its steps with the steady start."""
    return saved.summary.get("wall_s", float(saved.scalar("wall_s").sum()))


def _begin(scene, place, clock, progress, attrs):
    """Compute the steady start into a new store, then everything after it."""
    from tehl_taichi.runs import background_errors

    _announce(scene, progress)
    if not runtime.has_kernels():
        progress.say("compiling kernels, once for this version: up to a minute; later runs load them")
    with background_errors.coarse_grid_runs(scene) as coarse_answers_until:
        first, steady = _steady_start(scene, progress)
        with Store.create(place, scene, first, most_steps(scene) + 1, {**_attributes(scene, steady), **attrs}) as saved:
            return _finish(saved, saved.go_back(), steady, clock, progress, coarse_answers_until)


def _steady_start(scene, progress):
    """(first snapshot, its results for the summary)."""
    from tehl_taichi.march.passage import march

    progress.stage(STEADY, 0, 1)
    first = next(march(scene))
    progress.stage(STEADY, 1, 1)
    if first.unsettled:
        progress.warn(f"{for_reader(first.unsettled)}; the passage starts from an unsteady state")
    return first, {"steady_error": plain(first.error), "steady_parts": plain(first.parts),
                   "steady_domain": first.domain.values(), "steady_contact_alone": plain(_contact_alone(scene, first)),
                   **{f"steady_{name}": values for name, values in unknown_of(first.unknown).items()}}


def _attributes(scene, steady):
    """Attributes of a new store."""
    return {**texts(scene.typed_warnings), **{name: json.dumps(value) for name, value in steady.items()}, **provenance(scene)}


def _contact_alone(scene, first):
    """{surface: fatigue of its smooth body under the steady start}; without shear if the film has more than any oil."""
    from tehl_taichi.march.accuracy import contact_alone_bars

    too_much = first.scalars["friction_coefficient"] > MOST_FRICTION
    return contact_alone_bars.searches(scene.replace(**WITHOUT) if too_much else scene, first)


def _announce(scene, progress):
    for sentence in (*(f"left out: {what}" for what in scene.left_out(cut=False)), *preview(scene)):
        progress.say(sentence)
    for sentence in scene.warnings():
        progress.warn(sentence)


def _finish(saved, state, steady, clock, progress, coarse_answers_until):
    """Compute everything from the last stored state to the summary; coarse_answers_until: see
    :func:`tehl_taichi.runs.background_errors.coarse_grid_runs`.
    """
    from tehl_taichi.march.accuracy import coarse_runs
    from tehl_taichi.march.accuracy.domain_error import DomainError
    from tehl_taichi.runs.summary.summary import summarise

    saved.kept_states = _kept_states(saved.scene, state)
    run_in = _march(saved, state, progress)
    until = _resolved(saved)
    coarse_answers = coarse_answers_until(until)
    found = _fatigue(saved, until, progress)
    steel = _run_in_part(saved.scene, run_in) if run_in else {}
    sure = {name: one for name, one in _with_contact_alone(found, steady).items() if not why_none(one)}
    domain = DomainError.from_values(steady["steady_domain"]).of_passage(saved.scene, saved)
    notify = functools.partial(progress.stage, ERRORS)
    passage = coarse_runs.errors(saved.scene, saved, sure, lambda: coarse_answers(notify), domain, steel.get("run_in"))
    arrays = {}
    if saved.scene.zooms and len(saved) >= zoom_room.FEWEST:
        from tehl_taichi.runs import zoomed_run

        passage, finer, arrays = zoomed_run.refined(saved, passage, found if sure else None, domain, progress)
        found = finer or found
    searches = _with_contact_alone(found, steady)
    arrays |= _steel_arrays(run_in, searches) if run_in else {}
    extra = {**clock.times(), **steady, **passage, **steel, "passage_sides": domain.sides}
    summary = summarise(saved, extra, searches)  # adds the error bars, by which a body decides
    saved.finish(summary, {**(found.decided().to_arrays() if found else {}), **arrays})
    return Run(saved)


class _Clock:
    """Clock of a run (s) with the time of earlier parts (`spent`), the time for kernels, and launches that lost a worker; made
    when Taichi is started.
    """

    def __init__(self, began, spent=0.0):
        from tehl_taichi.engine.task_pool import crowding

        self.began, self.bound, self.crowding = began - spent, binding_seconds, crowding
        self.before = binding_seconds(), crowding()

    def times(self):
        bound, crowded = self.before
        return {"wall_s": time.perf_counter() - self.began, "compile_s": self.bound() - bound,
                "crowding": (self.crowding() - crowded).tolist()}


def _march(saved, state, progress):
    """March every step that the store lacks; with run-in every passage. Returns the RunInState (else None)."""
    once = functools.partial(_march_once, saved, progress)
    if not (saved.scene.runs_in and saved.scene.time.steps):
        return once(state)
    from tehl_taichi.runs import run_in_passages

    return run_in_passages.march(saved, state, progress, once)


def _run_in_part(scene, run_in):
    """Part {"run_in": its numbers} of the summary."""
    from tehl_taichi.plastic import run_in_numbers

    return {"run_in": run_in_numbers.numbers(scene, run_in)}


def _steel_arrays(run_in, found):
    """Arrays of the run-in; found: {surface: summary}, which get a note on whether steel still yields."""
    from tehl_taichi.plastic import run_in_numbers

    for name, new in run_in.records[-1]["new_by_surface"].items():
        if part := searched(found.get(name, {})).get("von_mises"):
            part["yields"] = new > 0
    return run_in_numbers.arrays(run_in)


def _march_once(saved, progress, state, changes=()):
    from tehl_taichi.runs.recorder import march_on

    total = total_steps(saved.scene)
    progress.begin(saved.scene)

    def notify(snapshot):
        progress.stage(PASSAGE, snapshot.step, total)
        progress.step(snapshot)

    progress.stage(PASSAGE, saved.last_step, total)
    march_on(saved, state, notify, changes)


def _searched(saved):
    """Whether the run has a fatigue search."""
    return saved.scene.has_fatigue and saved.steps >= 3


def _resolved(saved):
    """Position (a) up to which the index is searched separately, if the grid does not resolve later pressures; else None."""
    from tehl_taichi.march.accuracy import coarse_runs

    return coarse_runs.resolved(saved.scene, saved, saved.scalar) if _searched(saved) else None


def _fatigue(saved, until, progress):
    """Search the fatigue: the SearchResult of the run, or None."""
    from tehl_taichi.runs.stored_fatigue import assessed

    if not _searched(saved):
        return None
    progress.say("stresses and Findley search")
    return assessed(saved, saved.scene, progress, until)


def _kept_states(scene, state):
    """KeptStates of a march from this state; None if no window needs them for its temperatures, or if run-in repeats the
    march.
    """
    if not scene.zooms or scene.isothermal or scene.runs_in:
        return None
    from tehl_taichi.march.zoom.kept_states import KeptStates

    return KeptStates(state)


def _with_contact_alone(found, steady):
    """{surface: summary} of a SearchResult (or None), with the numbers of the smooth body of the steady start (none for runs
    before 0.9). An index of the pressure alone keeps its own numbers.
    """
    searches, alone = found.summaries if found else {}, steady["steady_contact_alone"]
    for name in searches.keys() & alone.keys():
        if not why_none(searches[name]):
            searches[name]["contact_alone"] = alone[name]
    return searches


@contextlib.contextmanager
def _stoppable(path, place=None):
    """Context manager: Ctrl-C (or another signal) inside it reports what is stored at `path`."""
    try:
        yield
    except KeyboardInterrupt as stop:
        if place and not place.published:
            raise interrupt(stop, " before anything was stored") from None
        raise interrupt(stop, _what_is_left(path)) from None


def _what_is_left(path):
    try:
        left = open(path)
    except StoreError:
        return f"; {path} can no longer be read"
    if left.finished and not left.store.seeks_window:
        return f"; {path} is finished"
    missing = "; the window that it needs is missing" if left.finished else _missing_words(left)
    return f" after {number_of(left.store.last_step, 'step')}{missing}; resume with: tehl resume {typed(path)}"


def _missing_words(left):
    """Text of the missing part of a passage."""
    if running := run_in_stage.words(left.store):
        return running
    if left.store.last_step < total_steps(left.scene):
        return ""
    return ", the whole passage; stresses and errors are missing" if left.scene.has_fatigue else ""
