"""A file is replaced as a whole or stays as it was."""

import contextlib
import os


def replace(path, content):
    """Write bytes to `path` under another name first. Raises OSError, and then leaves no half of it."""
    with aside(path) as temporary:
        temporary.write_bytes(content)


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
