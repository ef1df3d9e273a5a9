"""What is written under the lock of its folder: opened whole or let go, closed at the end of a `with`."""

from tehl_taichi.errors import StoreError
from tehl_taichi.io.lock import Lock
from tehl_taichi.io.place import reason


class Held:
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


def held(path, opened):
    """`opened(lock)` under the lock of the folder `path`, which is let go where that fails. Raises StoreError, Busy."""
    try:
        lock = Lock(path)
    except OSError as error:
        raise StoreError(f"cannot write to {path}: {reason(error)}") from None
    try:
        return opened(lock)
    except BaseException:
        lock.release()
        raise
