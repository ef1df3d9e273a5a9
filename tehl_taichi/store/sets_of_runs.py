"""Results that hold runs (studies, flanks, bearings, cams): their tables, and where the stores of their runs lie."""

from pathlib import Path

from tehl_taichi.disk.links import ROOT, marks_of

STUDY, FLANK, BEARING, CAM = "study", "flank", "bearing", "cam"
INSIDE = {STUDY: ("table.csv", "cases/NUMBER.zarr"), FLANK: ("flank.csv", "POSITION.zarr"),
          BEARING: ("bearing.csv", "NAME-inner.zarr"), CAM: ("cam.csv", "ANGLE.zarr")}  # table, stores of its runs


def kind_of(path, attributes=None):
    """Kind of the results in the folder `path` that are no run; "" for others. attributes: of a zarr group there."""
    if isinstance(attributes, dict) and STUDY in attributes:
        return STUDY
    return next((Path(mark).stem for mark in marks_of(Path(path)) if mark != ROOT), "")


def refusal(path, kind):
    """Message about the results of this kind at `path`, where a run is needed."""
    table, store = (Path(path) / part for part in INSIDE[kind])
    return f"{path} is a {kind}: its table is {table}; use the store of one of its runs, {store}"
