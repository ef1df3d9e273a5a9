"""A file is replaced as a whole or stays as it was."""

import os


def replace(path, content):
    """Write bytes to `path` under another name first. Raises OSError, and then leaves no half of it."""
    temporary = path.with_name(path.name + ".tmp")
    try:
        temporary.write_bytes(content)
        os.replace(temporary, path)
    except BaseException:
        try:
            temporary.unlink(missing_ok=True)
        except OSError:
            pass
        raise
