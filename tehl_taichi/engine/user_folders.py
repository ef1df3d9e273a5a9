"""Folders of the user, also in an environment (a service, a container, a batch job) without them."""

import os
import tempfile

from tehl_taichi.errors import RuntimeUnavailable


def home():
    """Home folder of the user, or the folder for temporary files if the system knows none. Raises RuntimeUnavailable."""
    found = os.path.expanduser("~")
    return found if os.path.isabs(found) else temporary()


def temporary():
    """The folder of temporary files. Raises RuntimeUnavailable."""
    try:
        return tempfile.gettempdir()
    except OSError:
        raise RuntimeUnavailable("no folder for temporary files is writable; set TMPDIR to a writable folder") from None


def give_home():
    """Set HOME if it is missing or empty: without it Taichi ends the process at its import."""
    if not os.environ.get("HOME"):
        os.environ.pop("HOME", None)
        os.environ["HOME"] = home()
