"""Commit of this code, as far as known. Uses only the standard library, because the build of a wheel runs this file."""

import functools
import os
import subprocess
from pathlib import Path

FILE = Path(__file__).parent / "commit.txt"  # filled in by `git archive`, and in a wheel by its build; not in a checkout
UNKNOWN, CHANGED, LENGTH = "unknown", "+changes", 12


@functools.lru_cache(maxsize=1)
def commit():
    """The commit's first LENGTH digits, followed by CHANGED if tracked files differ from it; or UNKNOWN."""
    return _written() or _of_checkout(FILE.parents[1]) or UNKNOWN


def _written():
    """Commit in the file, if the build filled it in."""
    text = FILE.read_text().strip() if os.path.isfile(FILE) else "$"
    return None if text.startswith("$") or text == UNKNOWN else text[:LENGTH] + CHANGED * text.endswith(CHANGED)


def _of_checkout(root):
    """Commit from git if the package lies at the top of a checkout (a virtual environment inside one does not count)."""
    if not os.path.exists(root / ".git"):
        return None
    try:
        head = _git(root, "rev-parse", f"--short={LENGTH}", "HEAD")
        return head + CHANGED * bool(_git(root, "status", "--porcelain", "--untracked-files=no"))
    except (OSError, subprocess.SubprocessError):
        return None


def _git(root, *words):
    done = subprocess.run(["git", "-C", str(root), *words], capture_output=True, text=True, check=True, timeout=10)
    return done.stdout.strip()
