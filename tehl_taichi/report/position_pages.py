"""Pages of the positions of a flank or a cam: written beside their stores, and linked from its page."""

import os
from urllib.parse import quote

from tehl_taichi.disk import user_files
from tehl_taichi.report.document import links


def write(found, force, written):
    """Write the page of every finished position without one (force: of all); written(store, path) writes one."""
    for _, store, path in _pages(found):
        if store.finished and (force or not os.path.exists(path)):
            user_files.check(path, force, "html", of=found.folder)
            written(store, path)


def line(found, out, words):
    """Links to existing pages; out: file of the page with the links, None: no links; words(position): link text."""
    if out is None:
        return None
    rows = [(words(at), _relative(path, out)) for at, _, path in _pages(found) if os.path.exists(path)]
    return links(rows, "Pages of the positions")


def _pages(found):
    """[(position, its store, path of its page)]."""
    stores = [(at, found.store_of(n)) for n, (at, *_) in enumerate(found.rows)]
    return [(at, store, store.path.with_suffix(".html")) for at, store in stores if store]


def _relative(path, out):
    return quote(os.path.relpath(path.absolute(), out.absolute().parent).replace(os.sep, "/"))
