"""Folders that are written under a lock: opened completely or released, closed at the end of a `with`."""


from tehl_taichi.disk import links
from tehl_taichi.disk.files import disk_errors, remove_temporaries
from tehl_taichi.disk.locks import Lock


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
