"""One word that opens everything: a run's store, a study, a flank."""

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from tehl_taichi.errors import StoreError
from tehl_taichi.values.path_arguments import folder_of

if TYPE_CHECKING:
    from tehl_taichi.runs.flank.stored_flank import Flank
    from tehl_taichi.runs.stored_run import Run
    from tehl_taichi.runs.sweep.study_table import Study

RUN, STUDY, FLANK = "run", "study", "flank"
INSIDE = {STUDY: ("table.csv", "cases/NUMBER.zarr"), FLANK: ("flank.csv", "POSITION.zarr")}  # table, stores of its runs


def kind(path: str | PathLike) -> str:
    """What lies at `path`: "study", "flank", or else "run", whether it is a good one or none at all."""
    from tehl_taichi.runs.flank.stored_flank import is_flank
    from tehl_taichi.runs.sweep.study_table import is_study

    return STUDY if is_study(path) else FLANK if is_flank(path) else RUN


def open(path: str | PathLike) -> "Run | Study | Flank":
    """As :func:`tehl_taichi.open`."""
    from tehl_taichi.runs.flank.stored_flank import Flank
    from tehl_taichi.runs.sweep.study_table import Study

    found = kind(path := folder_of(path))
    return Study.open(path) if found == STUDY else Flank.open(path) if found == FLANK else _run(path)


def open_run(path: str | PathLike) -> "Run":
    """The run in the store at `path`. Raises StoreError, which says of a study or a flank where its runs lie."""
    if (found := kind(path)) == RUN:
        return _run(path)
    table, store = (Path(path) / part for part in INSIDE[found])
    raise StoreError(f"{path} is a {found}: its table is {table}; use the store of one of its runs, {store}")


def _run(path):
    from tehl_taichi.runs import single_run
    from tehl_taichi.store.integrity import ROOT

    try:
        return single_run.open(path)
    except StoreError:
        if Path(path).is_dir() and not (Path(path) / ROOT).exists():
            raise StoreError(f"{path} is not a run, study or flank: it has neither {ROOT} nor flank.json") from None
        raise
