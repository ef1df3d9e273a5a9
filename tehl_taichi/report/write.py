"""Writing of the page of a folder."""

from os import PathLike
from pathlib import Path
from typing import Any

from tehl_taichi.disk import user_files
from tehl_taichi.errors import SceneError
from tehl_taichi.runs.open_results import BEARING, CAM, FLANK, RUN, STUDY, kind
from tehl_taichi.runs.open_results import open as opened
from tehl_taichi.values.checks import callback, flag
from tehl_taichi.values.file_ending import ending
from tehl_taichi.values.path_arguments import folder_of, path_of

OTHERS = ".pdf", ".png", ".svg", ".gif", ".mp4", ".nc", ".csv", ".json", ".md", ".txt", ".docx"  # endings of other formats


def report(of: str | PathLike | Any, out: str | PathLike | None = None, *, force: bool = False, progress: Any = None,
           threads: int | None = None, pages: bool = False, **constants: Any) -> Path:
    """Write a page: see :func:`tehl_taichi.report`."""
    from tehl_taichi.report import document, embed

    flag("force", force)
    flag("pages", pages)
    callback("progress", progress, "stage")
    folder = folder_of(of)
    search = _renewed_search(folder, constants)
    target = _page_file(out) if out else default_page(folder, "-fatigue" if search else "")
    user_files.check(target, force, "html")
    embed.check_installed()
    if pages:
        _position_pages(folder, force)
    page = search.page(progress, threads) if search else page_of(folder, target)
    user_files.text(target, document.render(page), force, kind="html")
    return target


def _page_file(out):
    """Path of a page that the caller names. Raises SceneError for the ending of another format."""
    path = path_of("out", out)
    if (end := ending(path)) in OTHERS:
        raise SceneError(f"out = {path} ends in {end}, and a report is a page of HTML; allowed: the ending .html, or none")
    return path


def _renewed_search(folder, constants):
    """New search of the run in `folder` with these constants; None if the stored search has them. Raises StoreError,
    SceneError.
    """
    if all(value is None for value in constants.values()):
        return None
    from tehl_taichi.report.renewed_search import RenewedSearch

    search = RenewedSearch(folder, constants)
    return None if search.is_answered else search


def _position_pages(folder, force):
    """Write the pages of the positions of a flank or a cam. Raises SceneError for other results."""
    from tehl_taichi.report import document, position_pages, run_page

    if (which := kind(folder)) not in (FLANK, CAM):
        raise SceneError(f"pages of positions exist of a flank or a cam, and {folder} is a {which}")
    position_pages.write(opened(folder), force, lambda store, path: user_files.text(
        path, document.render(run_page.page(store)), force, kind="html", of=folder))


def default_page(folder, end=""):
    """Default file of the page of `folder`; end: of its name."""
    folder = folder.absolute() if not folder.name else folder
    return folder.with_name(f"{folder.stem if folder.suffix else folder.name}{end}.html")


def page_of(folder, out=None):
    """The :class:`tehl_taichi.report.document.Page` of the results in `folder`; out: its file, base of its links. Raises
    StoreError.
    """
    from tehl_taichi.report import bearing_page, cam_page, flank_page, run_page, study_page

    pages = {RUN: run_page, STUDY: study_page, FLANK: flank_page, BEARING: bearing_page, CAM: cam_page}
    which = kind(folder)
    return pages[which].of(folder, out or default_page(folder)) if which in (FLANK, CAM) else pages[which].of(folder)
