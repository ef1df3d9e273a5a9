"""The figure of results that lie in a folder of their own, as a flank: where it may be drawn and written."""

import os

from tehl_taichi.disk import links
from tehl_taichi.view.figures.figure_style import drawing, made


def check(folder, page, name):
    """Raises StoreError where no figure could be drawn, nor written as `name` into the folder (None: a new one) of results to
    come."""
    drawing()
    if folder is not None and os.path.lexists(folder):
        links.refuse(folder)
        page.check(folder / f"{name}.{page.format}", folder)


def write(folder, path, page, draw):
    """Write what draw(page) gives for the results in `folder`, as the :class:`FigureStyle` says; returns the path."""
    page, path = page.of_file(path)
    if os.path.realpath(path.parent) == os.path.realpath(folder):
        links.refuse(path.parent)
    page.check(path, folder)
    made(path.parent)
    return page.save(lambda: draw(page), path, of=folder)
