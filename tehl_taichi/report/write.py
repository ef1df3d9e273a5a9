"""From a folder to its page on the disk."""

from os import PathLike
from pathlib import Path
from typing import Any

from tehl_taichi.disk import user_files
from tehl_taichi.values.path_arguments import folder_of


def report(of: str | PathLike | Any, out: str | PathLike | None = None, *, force: bool = False, progress: Any = None,
           threads: int | None = None, **constants: Any) -> Path:
    """As :func:`tehl_taichi.report`."""
    from tehl_taichi.report import document, embed

    folder = folder_of(of)
    search = _renewed_search(folder, constants)
    out = Path(out) if out else default_page(folder, "-fatigue" if search else "")
    user_files.check(out, force, "html")
    embed.check_installed()
    page = search.page(progress, threads) if search else page_of(folder)
    user_files.text(out, document.rendered(page), force, kind="html")
    return out


def _renewed_search(folder, constants):
    """Search of the run in `folder` with these constants; None where that search is stored. Raises
    StoreError, SceneError."""
    if all(value is None for value in constants.values()):
        return None
    from tehl_taichi.report.renewed_search import RenewedSearch

    search = RenewedSearch(folder, constants)
    return None if search.is_answered else search


def default_page(folder, end=""):
    """The file of the page of `folder` by default; end: of its name."""
    folder = folder.absolute() if not folder.name else folder
    return folder.with_name(f"{folder.stem if folder.suffix else folder.name}{end}.html")


def page_of(folder):
    """The :class:`tehl_taichi.report.document.Page` of whatever lies in `folder`. Raises StoreError."""
    from tehl_taichi.report import bearing_page, cam_page, flank_page, run_page, study_page
    from tehl_taichi.runs.open_results import BEARING, CAM, FLANK, RUN, STUDY, kind

    pages = {RUN: run_page, STUDY: study_page, FLANK: flank_page, BEARING: bearing_page, CAM: cam_page}
    return pages[kind(folder)].of(folder)
