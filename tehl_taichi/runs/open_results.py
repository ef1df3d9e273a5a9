"""Opening of any results folder: a run's store, a study, a flank, a bearing, a cam."""

import os
from functools import partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from tehl_taichi.errors import StoreError
from tehl_taichi.store import sets_of_runs
from tehl_taichi.store.sets_of_runs import BEARING, CAM, FLANK, STUDY
from tehl_taichi.values.path_arguments import folder_of

if TYPE_CHECKING:
    from tehl_taichi.runs.bearing.stored_bearing import Bearing
    from tehl_taichi.runs.cam.stored_cam import Cam
    from tehl_taichi.runs.flank.stored_flank import Flank
    from tehl_taichi.runs.stored_run import Run
    from tehl_taichi.runs.sweep.study_table import Study

RUN = "run"


def kind(path: str | PathLike) -> str:
    """Kind of the results at `path`: "study", "flank", "bearing", "cam", otherwise "run" (also for a damaged or missing
    one).
    """
    from tehl_taichi.runs.sweep.study_table import is_study

    if is_study(path):
        return STUDY
    return next((name for name, one in _contact_sets().items() if one.lies_in(path)), RUN)


def _contact_sets():
    """{kind: class} of results in a folder of their own."""
    from tehl_taichi.runs.bearing.stored_bearing import Bearing
    from tehl_taichi.runs.cam.stored_cam import Cam
    from tehl_taichi.runs.flank.stored_flank import Flank

    return {FLANK: Flank, BEARING: Bearing, CAM: Cam}


def open(path: str | PathLike) -> "Run | Study | Flank | Bearing | Cam":
    """Open results: see :func:`tehl_taichi.open`."""
    from tehl_taichi.runs.sweep.study_table import Study

    opened: dict = {STUDY: Study.open, RUN: partial(_run, stand_in=True),
                    **{name: one.open for name, one in _contact_sets().items()}}
    return opened[kind(path := folder_of(path))](path)


def open_run(path: str | PathLike) -> "Run":
    """Open the run in the store at `path`. Raises StoreError, which names the runs of a study, flank, bearing or cam."""
    if (found := kind(path)) == RUN:
        return _run(path)
    raise StoreError(sets_of_runs.refusal(path, found))


def _run(path, stand_in=False):
    from tehl_taichi.runs import single_run
    from tehl_taichi.store.integrity import ROOT

    try:
        return single_run.open(path, stand_in)
    except StoreError:
        if os.path.isdir(path) and not os.path.exists(Path(path) / ROOT):
            raise StoreError(f"{path} is not a run, study, flank, bearing or cam: it has none of {ROOT}, "
                             "flank.json, bearing.json and cam.json") from None
        raise
