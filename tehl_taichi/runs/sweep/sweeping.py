"""Sweep: many runs of one scene with changes, written case by case into a study, in parallel, resumable."""

import os
from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from tehl_taichi.runs.sweep import case, pool
from tehl_taichi.runs.sweep.job import LostJob
from tehl_taichi.runs.sweep.plan import plan as planned
from tehl_taichi.runs.sweep.study_table import CASES, Study
from tehl_taichi.scene import Scene
from tehl_taichi.store.load_scene import find
from tehl_taichi.store.store_draft import check_room, writable_folder
from tehl_taichi.values.checks import callback, choice
from tehl_taichi.values.path_arguments import path_of

KEEP = ("stores", "summary")


def sweep(scene: Scene | str | PathLike, over: Mapping, path: str | PathLike | None = None, *, samples: int | None = None,
          seed: int | None = None, workers: int | None = None, threads_per_worker: int | None = None, scheduler: Any = None,
          keep: str = "stores", progress: Callable | None = None) -> Study:
    """Run a sweep: see :func:`tehl_taichi.sweep`."""
    return run(planned(find(scene), over, samples, seed), path, workers=workers, threads_per_worker=threads_per_worker,
               scheduler=scheduler, keep=keep, progress=progress)


def run(plan, path=None, *, workers=None, threads_per_worker=None, scheduler=None, keep="stores", progress=None, say_line=None,
        work=None):
    """Run the cases of `plan` without a result in its study at `path`; see :func:`sweep`. work: function that runs a
    :class:`tehl_taichi.runs.sweep.case.CaseJob` (default: :func:`tehl_taichi.runs.sweep.case.run_case`).
    """
    callback("progress", progress)
    check_settings(workers, threads_per_worker, scheduler, keep)
    refused = plan.refused()
    path = path_of("path", path) if path is not None else default_path(plan)
    check_place(plan, path, keep)
    with Study.write(path, plan) as study:
        _report_refused(study, refused)
        todo = study.open_cases
        workers, threads = pool.sizes(workers, threads_per_worker, scheduler, max(1, len(todo)))
        if progress:
            progress(study, None)
        jobs = (_job(study, number, keep, threads, shared=workers != 1) for number in todo)
        found = pool.results(work or case.run_case, jobs, workers=workers, scheduler=scheduler, say_line=say_line)
        with pool.ended(found, study.path / CASES):
            for place, answer in found if todo else ():
                _keep(study, todo[place], answer, keep, progress)
    return study


def check_settings(workers=None, threads_per_worker=None, scheduler=None, keep="stores", connect=True):
    """Check the settings of a sweep; returns (processes, threads of each), see :func:`tehl_taichi.runs.sweep.pool.sizes`.
    Raises SceneError and RuntimeUnavailable. connect: also check that the scheduler answers.
    """
    choice("--keep", keep, KEEP)
    workers, threads = pool.sizes(workers, threads_per_worker, scheduler)
    if connect or scheduler is None:
        pool.check(workers, threads, scheduler)
    return workers, threads


def check_place(plan, path, keep="stores"):
    """Raise StoreError if the study of `plan` cannot be written at `path`; DiskError without room for its stores."""
    Study.check(path, plan)
    folder = writable_folder(path)
    if keep == "stores":
        check_room(folder)


def default_path(plan):
    """Default path, equal for equal sweeps, so that a repeated command resumes its sweep."""
    return Path("runs") / f"{plan.name}.zarr"


def _job(study, number, keep, threads, shared):
    store = str(study.store_of(number).absolute()) if keep == "stores" else None
    return case.CaseJob(study.plan.case(number), store, threads, shared)


def _report_refused(study, refused):
    done = set(study.open_cases)
    for number, reason in refused.items():
        if number in done:
            study.add({"case": number, "changes": study.plan.changes(number), "status": "refused", "reason": reason,
                       "store": None, "seconds": 0.0, "summary": None})


def _keep(study, number, answer, keep, progress):
    if isinstance(answer, LostJob):
        answer = {"status": "failed", "reason": answer.reason, "summary": None, "seconds": 0.0}
    store = study.store_of(number)
    there = keep == "stores" and os.path.exists(store)
    record = {"case": number, "changes": study.plan.changes(number), **answer,
              "store": str(store.relative_to(study.path)) if there else None}
    study.add(record)
    if progress:
        progress(study, record)
