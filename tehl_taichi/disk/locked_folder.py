"""Folders that are written under a lock: opened completely or released, closed at the end of a `with`."""

import contextlib

from tehl_taichi.disk import links
from tehl_taichi.disk.files import TEMPORARY, disk_errors, remove_temporaries
from tehl_taichi.disk.locks import LOCK, Lock


class LockedFolder:
    """A folder on disk that only this process writes while it holds the `lock`."""

    lock = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self) -> None:
        """Release the lock; stored data can still be read."""
        if self.lock:
            self.lock.release()
            self.lock = None


def locked_folder(path, opened):
    """Call `opened(lock)` with the lock of the folder `path`; releases it on failure. Raises StoreError, also for links in it;
    Busy.
    """
    links.refuse(path)
    with disk_errors(path, "cannot write to"):
        lock = Lock(path)
    try:
        with disk_errors(path, "cannot write to"):
            remove_temporaries(path)
        return opened(lock)
    except BaseException:
        lock.release()
        raise


def is_begun(folder):
    """Whether a folder holds nothing, or only what a writer that was killed at its beginning left: its lock, a temporary
    file.
    """
    return all(path.name == LOCK or TEMPORARY.fullmatch(path.name) for path in folder.iterdir())


@contextlib.contextmanager
def only_writer(folder):
    """Context manager: only this process writes in `folder`, which is made if necessary and removed if it stays empty. Raises
    StoreError, Busy.
    """
    with disk_errors(folder, "cannot write to"):
        folder.mkdir(parents=True, exist_ok=True)
    lock = locked_folder(folder, lambda lock: lock)
    try:
        yield
    finally:
        lock.release()
        with contextlib.suppress(OSError):  # it holds results
            folder.rmdir()
