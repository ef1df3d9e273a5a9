"""Folders that are written under a lock: opened whole or let go, closed at the end of a `with`."""


from tehl_taichi.disk import links
from tehl_taichi.disk.files import blamed, tidy
from tehl_taichi.disk.locks import Lock


class LockedFolder:
    """A folder on disk that only this process writes as long as it has a `lock`."""

    lock = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Let others write; what is stored can still be read."""
        if self.lock:
            self.lock.release()
            self.lock = None


def locked_folder(path, opened):
    """`opened(lock)` under the lock of the folder `path`, which is let go where that fails. Raises StoreError, also where it
    holds a link; Busy."""
    links.refuse(path)
    with blamed(path, "cannot write to"):
        lock = Lock(path)
    try:
        with blamed(path, "cannot write to"):
            tidy(path)
        return opened(lock)
    except BaseException:
        lock.release()
        raise
