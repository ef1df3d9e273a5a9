"""Single files: replaced as a whole or unchanged; never written through a link; only plain files are read."""

import contextlib
import errno
import json
import os
import re
import secrets
import stat

from tehl_taichi.errors import DiskError, StoreError

TEMPORARY = re.compile(r"\..+\.[0-9a-f]{16}\.tmp")  # unguessable: no link can be there before
LINK = "it is a link, and tehl does not write through links"
TEXT = 2e8  # bytes: no attributes, tables or scenes of ours are larger
FAULTS = {errno.ENOSPC, errno.EFBIG, errno.EIO, getattr(errno, "EDQUOT", errno.ENOSPC)}  # of the disk, not of a path
UNWAITING = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)  # the reader of a FIFO would wait for its writer
UNFOLLOWING = getattr(os, "O_NOFOLLOW", 0) | UNWAITING


def replace(path, content):
    """Replace the content of `path` atomically. Raises OSError, and then leaves `path` unchanged."""
    with replacement(path) as temporary:
        write(temporary, content)


def write(path, content):
    """Write bytes to `path`, which has no reader yet, in place of an existing file. Raises OSError, and may then leave an
    incomplete file.
    """
    try:
        file = open(path, "xb")
    except FileExistsError:
        os.unlink(path)  # a link goes, not what it leads to
        file = open(path, "xb")
    with file:
        file.write(content)


@contextlib.contextmanager
def replacement(path):
    """Context manager: a temporary name, renamed to `path` at the end of the block. Raises OSError; no incomplete file is
    left.
    """
    temporary = path.with_name(f".{path.name[:60]}.{secrets.token_hex(8)}.tmp")
    try:
        yield temporary
        os.replace(temporary, path)
    except BaseException:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)
        raise


def append(path, content):
    """Append bytes to a file, which is created if missing. Raises OSError, also for a link."""
    with os.fdopen(open_plain(path, os.O_WRONLY | os.O_APPEND | os.O_CREAT), "ab") as file:
        file.write(content)


def truncate(path, size):
    """Truncate a file to `size` bytes. Raises OSError, also for a link."""
    with os.fdopen(open_plain(path, os.O_RDWR), "r+b") as file:
        file.truncate(size)


def open_plain(path, flags):
    """Open a plain file that has no other name; returns the descriptor. Raises OSError, also for a link and for a special
    file.
    """
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
    """Bytes of a plain file, also read through links. Raises OSError if it is none, or has more than `most` bytes."""
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
    """Text of a plain file, without the mark that some editors put first. Raises as :func:`content`; ValueError if it is no
    text.
    """
    return content(path).decode("utf-8-sig")


def json_of(path):
    """Content of a JSON file. Raises as :func:`content`; ValueError if it is no JSON or nested too deeply."""
    try:
        return json.loads(text(path))
    except RecursionError:
        raise ValueError("it is nested too deeply") from None


def remove_temporaries(folder):
    """Remove temporary files of killed writers in a folder that only this process writes."""
    for entry in os.scandir(folder):
        if TEMPORARY.fullmatch(entry.name) and entry.is_file(follow_symlinks=False):
            os.unlink(entry.path)


def reason(error):
    """Text of an OSError."""
    return error.strerror or str(error)


def store_error(error, message):
    """StoreError with this message about an OSError; a DiskError if the disk is full or fails, whatever the path."""
    return (DiskError if error.errno in FAULTS else StoreError)(message)


@contextlib.contextmanager
def disk_errors(path, doing="cannot write"):
    """Context manager: OSErrors of the disk become a StoreError about `path`, see :func:`store_error`."""
    try:
        yield
    except OSError as error:
        raise store_error(error, f"{doing} {path}: {reason(error)}") from None
