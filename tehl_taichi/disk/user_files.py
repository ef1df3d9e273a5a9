"""Output files for users: figures, films, pages, tables. One rule for every --out.

An existing file stays unless --force is given. --force replaces only a file that tehl wrote, recognised by its content. Nothing
is written inside a store, a study or a flank, nor through a link.
"""

import contextlib
import mmap
import os
import re

from tehl_taichi.disk import links
from tehl_taichi.disk.drafts import Draft, exists
from tehl_taichi.disk.files import disk_errors
from tehl_taichi.disk.locks import Lock
from tehl_taichi.errors import StoreError

PROGRAM, COMMENT = "tehl_taichi", "<!-- tehl_taichi -->"
COLUMN = re.compile(rb'"?[^\[\],]+ \[[^\[\]]*\]"?')
# {kind: (how a file of it begins, what it has somewhere if tehl wrote it)}
SIGNS = {"png": (b"\x89PNG", b"Software\0tehl_taichi"), "pdf": (b"%PDF-", b"/Creator (tehl_taichi)"),
         "svg": (b"<?xml", b"<dc:title>tehl_taichi</dc:title>"), "gif": (b"GIF8", b"tehl_taichi"), "mp4": (b"", b"tehl_taichi"),
         "html": (b"<!doctype html>", b'<meta name="generator" content="tehl_taichi">'), "nc": (b"\x89HDF", b"tehl_taichi"),
         "vti": (b"<?xml", COMMENT.encode()), "pvd": (b"<?xml", COMMENT.encode()),
         "json": (b"{", b'"program": "tehl_taichi"'), "md": (b"", COMMENT.encode())}


class UserFile(Draft):
    """A file or folder at `path` that is made as `draft` and appears with :meth:`publish`; see :func:`check`."""

    def __init__(self, path, force=False, kind="", parts="", of=None):
        self.kind_parts_of = kind, parts, of
        super().__init__(path, force)
        self.draft = self.folder / "made"
        if parts:
            self.draft.mkdir()

    def allowed(self, replace):
        check(self.path, replace, *self.kind_parts_of)
        return Lock(self.path) if links.is_folder(self.path) else None

    def publish(self, made=None):
        super().publish(made or self.draft)


def check(path, force=False, kind="", parts="", of=None):
    """Raise StoreError if a command may not write to `path`.

    force: replace a file of ours; kind: of the file, as its usual suffix (default: suffix of `path`); parts: for a folder, a
    regular expression of the names in it; of: the flank's folder, if the file is its own figure.
    """
    check_outside(path, of)
    if not os.path.lexists(path):
        return
    if what := links.special_kind(os.lstat(path)):
        remedy = "choose another --out" if what == links.SPECIAL else "remove it or choose another --out"
        raise StoreError(f"{path} is {what}, and tehl does not write through links; {remedy}")
    if links.is_folder(path) != bool(parts):
        what = "not a folder" if parts else "a folder"
        raise StoreError(f"{path} exists and is {what}; --out takes the name of a {'folder' if parts else 'file'}")
    if not force:
        raise StoreError(exists(path))
    _check_parts(path, parts) if parts else _check_ours(path, kind)


def check_outside(path, of=None):
    """Raise StoreError if `path` lies inside a store, study, flank, bearing or cam other than `of`."""
    for folder in links.result_folders(path):
        if not (of and os.path.samefile(folder, of)):
            mark = links.marks_of(folder)[0]
            raise StoreError(f"{path} lies in {folder}, which holds results of tehl ({mark}); choose another --out")


def _check_parts(path, parts):
    for part in sorted(path.iterdir()):
        if not re.fullmatch(parts, part.name) or links.special_kind(os.lstat(part)):
            raise StoreError(f"{path} holds {part.name}, which is not part of an export; move it away, or choose another --out")
        _check_ours(part)


def _check_ours(path, kind=""):
    if not is_ours(path, kind):
        raise StoreError(f"{path} was not written by tehl, and --force replaces only files of tehl; move it away, or choose "
                         "another --out")


def is_ours(path, kind=""):
    """Whether a command of tehl wrote a file, by its content; kind: see :func:`check`."""
    kind = kind or path.suffix[1:].lower()
    with open(path, "rb") as file:
        if kind == "csv":
            return all(map(COLUMN.fullmatch, file.readline(100_000).strip().split(b",")))
        begins, has = SIGNS.get(kind, (b"", None))
        if has is None or not os.path.getsize(path) or file.read(len(begins)).lower() != begins.lower():
            return False
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
            return content.find(has) >= 0


@contextlib.contextmanager
def made(path, force=False, **what):
    """Context manager: a temporary path whose content appears at `path` at the end of the block; arguments: see :func:`check`.
    Raises StoreError, also for disk errors.
    """
    with disk_errors(path), UserFile(path, force, **what) as output:
        yield output.draft
        output.publish()


def text(path, content, force=False, **what):
    """Write text to `path`; arguments: see :func:`made`."""
    with made(path, force, **what) as draft:
        draft.write_text(content, encoding="utf-8")
