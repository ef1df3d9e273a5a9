"""One writer at a time: a lock file in the folder, held by the kernel as long as its process lives.

The content of the file (process, host, since when) is for people, and for hosts that share the folder but not the kernel.
"""

import json
import os
import socket
import time
from pathlib import Path

from tehl_taichi.disk import files
from tehl_taichi.errors import StoreError

LOCK = ".lock"
PROGRAM = "tehl_taichi"
PATIENCE = 0.25  # s: whoever only looks whether a lock is held keeps it for microseconds


class Busy(StoreError):
    """Another process writes in this folder, or may do so."""


class Lock:
    """The right to write below `folder`; taken over from dead processes of this host.

    Raises Busy, StoreError if a file that is no lock has its name, or OSError if it cannot be written (it may be a link).
    """

    def __init__(self, folder, name=None):
        self.path, self.name = Path(folder) / LOCK, name or folder
        self.file = _open_and_lock(self.path, self.name)
        try:
            before = _read(self.file)
            if not before and os.fstat(self.file.fileno()).st_size:
                raise StoreError(f"{self.path} is not a lock of tehl; check the file and move it away")
            if before and before["host"] != socket.gethostname():
                raise Busy(f"{self.name} was being written by process {before['pid']} on {before['host']}, which cannot be "
                           f"checked from this machine; if that run has ended, remove {self.path}")
            self.file.seek(0)
            self.file.truncate()
            json.dump({"program": PROGRAM, "pid": os.getpid(), "host": socket.gethostname(), "since": time.time()}, self.file)
            self.file.flush()
        except BaseException:
            self.file.close()
            raise

    def moved(self, folder):
        """Record the new name of the locked folder."""
        self.path = Path(folder) / LOCK

    def release(self):
        """Remove the lock file, then release the kernel's lock."""
        if not self.file.closed:
            if _has_this_name(self.file, self.path):
                self.path.unlink(missing_ok=True)
            self.file.close()


def holder(folder):
    """Description of the process that is writing below `folder`, or None."""
    try:
        with _to_read(folder) as file:
            return _words(_read(file)) if not _lock(file, shared=True) else None
    except OSError:
        return None


def lock_content(folder):
    """Content of the lock in `folder` (program, pid, host, since); {} without a lock of this program."""
    try:
        with _to_read(folder) as file:
            return _read(file)
    except OSError:
        return {}


def is_abandoned(folder):
    """Whether `folder` has a lock of this program that no process of this host holds."""
    try:
        with _to_read(folder) as file:
            content = _read(file)
            return bool(content) and content["host"] == socket.gethostname() and _lock(file, shared=True)
    except OSError:
        return False


def _to_read(folder):
    return os.fdopen(files.open_plain(Path(folder) / LOCK, os.O_RDONLY))


def _open_and_lock(path, name):
    """Open and lock the lock file. Raises Busy."""
    until = time.monotonic() + PATIENCE
    while True:
        file = os.fdopen(files.open_plain(path, os.O_RDWR | os.O_CREAT), "r+")
        if _lock(file) and _has_this_name(file, path):
            return file
        content = _read(file)
        file.close()
        if time.monotonic() > until:
            raise Busy(f"{name} is still being written by {_words(content)}; wait for it or stop it")
        time.sleep(0.01)


def _lock(file, shared=False):
    """Whether the kernel's lock was acquired; where the kernel has none (some network folders), whether the process has
    ended.
    """
    try:
        import fcntl

        fcntl.flock(file, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
        return True
    except BlockingIOError:
        return False
    except (ImportError, OSError):
        content = _read(file)
        return not content or content["host"] != socket.gethostname() or not _alive(content["pid"])


def _alive(pid):
    if pid == os.getpid() or os.name != "posix":  # there a signal 0 is not a question
        return True
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    return True


def _has_this_name(file, path):
    """Whether the open file still has this name: its last owner may have removed it meanwhile."""
    try:
        return os.path.samestat(os.fstat(file.fileno()), os.lstat(path))
    except OSError:
        return False


def _read(file):
    """Content of a lock file; {} if this program did not write it."""
    try:
        file.seek(0)
        content = json.load(file)
        known = content["program"] == PROGRAM and isinstance(content["pid"], int) and isinstance(content["host"], str)
        return content if known else {}
    except (ValueError, KeyError, TypeError, RecursionError, OSError):
        return {}


def _words(content):
    if not content:
        return "another process"
    since = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(content.get("since", 0)))
    return f"process {content['pid']} on {content['host']} (since {since})"
