"""Figure of results in a folder of their own, such as a flank."""

import os

from tehl_taichi.disk import links
from tehl_taichi.view.figures.figure_style import folder_of_figures, import_matplotlib


def check(folder, page, name):
    """Raise StoreError if a figure could not be drawn, or not be written as `name` into the folder of future results (None: a
    new one).
    """
    import_matplotlib()
    if folder is not None and os.path.lexists(folder):
        links.refuse(folder)
        page.check(folder / f"{name}.{page.format}", folder)


def write(folder, path, page, draw):
    """Write the figure of draw(page) for the results in `folder`, in the format of the :class:`FigureStyle`; returns the
    path.
    """
    page, path = page.of_file(path)
    if os.path.realpath(path.parent) == os.path.realpath(folder):
        links.refuse(path.parent)
    page.check(path, folder)
    with folder_of_figures(path.parent):
        return page.save(lambda: draw(page), path, of=folder)
