"""Folders of the user, where an environment (a service, a container, a batch job) names none."""

import os
import tempfile

from tehl_taichi.errors import RuntimeUnavailable


def home():
    """The user's home, or the folder of temporary files where the system knows none. Raises RuntimeUnavailable."""
    found = os.path.expanduser("~")
    return found if os.path.isabs(found) else temporary()


def temporary():
    """The folder of temporary files. Raises RuntimeUnavailable."""
    try:
        return tempfile.gettempdir()
    except OSError:
        raise RuntimeUnavailable("no folder for temporary files is writable; set TMPDIR to a writable folder") from None


def give_home():
    """Set HOME where it is missing or empty: Taichi ends the process without it, as soon as it is imported."""
    if not os.environ.get("HOME"):
        os.environ.pop("HOME", None)
        os.environ["HOME"] = home()
