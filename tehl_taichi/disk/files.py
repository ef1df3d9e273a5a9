"""One file: replaced as a whole or left as it was; never written through a link, never read where it is no plain file."""

import contextlib
import errno
import json
import os
import re
import secrets
import stat

from tehl_taichi.errors import StoreError

TEMPORARY = re.compile(r"\..+\.[0-9a-f]{16}\.tmp")  # unguessable: no link can be there before
LINK = "it is a link, and tehl does not write through links"
TEXT = 2e8  # bytes: no attributes, tables or scenes of ours are larger
UNWAITING = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)  # the reader of a FIFO would wait for its writer
UNFOLLOWING = getattr(os, "O_NOFOLLOW", 0) | UNWAITING


def replace(path, content):
    """Write bytes to `path` under another name first. Raises OSError, and then leaves no half of it."""
    with aside(path) as temporary:
        write(temporary, content)


def write(path, content):
    """Write bytes to a path that has no reader yet, in place of what has that name. Raises OSError, and then may leave half of
    them."""
    try:
        file = open(path, "xb")
    except FileExistsError:
        os.unlink(path)  # a link goes, not what it leads to
        file = open(path, "xb")
    with file:
        file.write(content)


@contextlib.contextmanager
def aside(path):
    """Another name to write to, which becomes `path` at the end of the block. Raises OSError; whatever ends the block before
    leaves no half of it."""
    temporary = path.with_name(f".{path.name[:60]}.{secrets.token_hex(8)}.tmp")
    try:
        yield temporary
        os.replace(temporary, path)
    except BaseException:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)
        raise


def append(path, content):
    """Add bytes to a file, which is made where there is none. Raises OSError, also for a link."""
    with os.fdopen(opened(path, os.O_WRONLY | os.O_APPEND | os.O_CREAT), "ab") as file:
        file.write(content)


def cut(path, size):
    """Cut a file off behind so many bytes. Raises OSError, also for a link."""
    with os.fdopen(opened(path, os.O_RDWR), "r+b") as file:
        file.truncate(size)


def opened(path, flags):
    """Descriptor of a plain file that has this name alone. Raises OSError, also for a link and for a special file."""
    try:
        found = os.open(path, flags | UNFOLLOWING, 0o666)
    except OSError as error:
        raise OSError(error.errno, LINK if error.errno == errno.ELOOP else error.strerror) from None
    status = os.fstat(found)
    if stat.S_ISREG(status.st_mode) and status.st_nlink <= 1:
        return found
    os.close(found)
    raise OSError(errno.EINVAL, LINK if stat.S_ISREG(status.st_mode) else "it is not a regular file")


def content(path, most=TEXT):
    """Bytes of a plain file, read through links too. Raises OSError where it is none, or has more than `most` bytes."""
    with os.fdopen(os.open(path, os.O_RDONLY | UNWAITING), "rb") as file:
        status = os.fstat(file.fileno())
        if stat.S_ISDIR(status.st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        if not stat.S_ISREG(status.st_mode):
            raise OSError(errno.EINVAL, "it is not a regular file")
        if status.st_size > most:
            raise OSError(errno.EFBIG, f"it has {status.st_size} bytes; allowed: at most {most:.0f}")
        return file.read()


def text(path):
    """The text of a plain file. Raises as :func:`content`; ValueError where it is no text."""
    return content(path).decode("utf-8")


def json_of(path):
    """Content of a JSON file. Raises as :func:`content`; ValueError where it is none, or nested without end."""
    try:
        return json.loads(text(path))
    except RecursionError:
        raise ValueError("it is nested too deeply") from None


def tidy(folder):
    """Remove what killed writers left of single files in a folder that only this process writes."""
    for entry in os.scandir(folder):
        if TEMPORARY.fullmatch(entry.name) and entry.is_file(follow_symlinks=False):
            os.unlink(entry.path)


def reason(error):
    """An OSError in words."""
    return error.strerror or str(error)


@contextlib.contextmanager
def blamed(path, doing="cannot write"):
    """Context manager: OSErrors of the disk become a StoreError about `path`."""
    try:
        yield
    except OSError as error:
        raise StoreError(f"{doing} {path}: {reason(error)}") from None
