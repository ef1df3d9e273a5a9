"""A file is replaced as a whole or stays as it was."""

import contextlib
import os


def replace(path, content):
    """Write bytes to `path` under another name first. Raises OSError, and then leaves no half of it."""
    with aside(path) as temporary:
        write(temporary, content)


def write(path, content):
    """Write bytes to a path that nobody reads yet. Raises OSError, and then may leave half of them."""
    with open(path, "wb") as file:
        file.write(content)


@contextlib.contextmanager
def aside(path):
    """Another name to write to, which becomes `path` at the end of the block. Raises OSError; whatever ends the block before
    leaves no half of it."""
    temporary = path.with_name(path.name + ".tmp")
    try:
        yield temporary
        os.replace(temporary, path)
    except BaseException:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)
        raise
