"""The commit of this code, as far as it can be known. Nothing but the standard library: the build of a wheel runs this file."""

import functools
import subprocess
from pathlib import Path

FILE = Path(__file__).parent / "commit.txt"  # filled in by `git archive`, and in a wheel by its build; not in a checkout
UNKNOWN, CHANGED, LENGTH = "unknown", "+changes", 12


@functools.lru_cache(maxsize=1)
def commit():
    """The commit's first LENGTH digits, with CHANGED behind them where tracked files differ from it; or UNKNOWN."""
    return _written() or _of_checkout(FILE.parents[1]) or UNKNOWN


def _written():
    """Content of the file, if it was filled in."""
    text = FILE.read_text().strip() if FILE.is_file() else "$"
    return None if text.startswith("$") or text == UNKNOWN else text[:LENGTH] + CHANGED * text.endswith(CHANGED)


def _of_checkout(root):
    """Commit from git, where the package lies at the top of a checkout (not merely inside one, as in a virtual environment)."""
    if not (root / ".git").exists():
        return None
    try:
        head = _git(root, "rev-parse", f"--short={LENGTH}", "HEAD")
        return head + CHANGED * bool(_git(root, "status", "--porcelain", "--untracked-files=no"))
    except (OSError, subprocess.SubprocessError):
        return None


def _git(root, *words):
    done = subprocess.run(["git", "-C", str(root), *words], capture_output=True, text=True, check=True, timeout=10)
    return done.stdout.strip()
