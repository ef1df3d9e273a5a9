"""A bare environment (a service, a container, a batch job): no HOME, no folder for kernels, none for temporary files."""

import os
import subprocess
import sys
import tempfile

import pytest
from commands import CALL

from tehl_taichi.engine import runtime, user_folders
from tehl_taichi.errors import RuntimeUnavailable


def start(**environment):
    """Taichi started in a process with no environment but this: (exit code, what it prints)."""
    code = "from tehl_taichi.engine import runtime; print(runtime.start(threads=1)['cache'])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment)
    return done.returncode, done.stdout.strip(), done.stderr


@pytest.mark.parametrize("environment", [{}, {"HOME": ""}])
def test_taichi_starts_without_home(tmp_path, environment):
    """It would end the process with its own words."""
    code, cache, said = start(**environment, TEHL_CACHE=str(tmp_path))
    assert code == 0 and cache.startswith(str(tmp_path)), said


def test_kernels_that_cannot_be_kept_are_compiled(tmp_path):
    (tmp_path / "file").touch()
    code, cache, said = start(HOME=str(tmp_path / "file"), TMPDIR=str(tmp_path))
    assert code == 0 and "compiled kernels cannot be kept in" in said and cache.startswith(str(tmp_path / "tehl-"))


def test_the_command_says_in_a_sentence_that_no_folder_can_be_written(tmp_path, monkeypatch):
    code = ("import tempfile; tempfile._get_default_tempdir = lambda: (_ for _ in ()).throw(FileNotFoundError(2, 'none')); "
            f"{CALL[2]}")
    words = ("run", "smooth-line", "--grid", "32", "--isothermal", "--threads", "1")
    done = subprocess.run([sys.executable, "-c", code, *words], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 2 and done.stderr.endswith("set TMPDIR to a writable folder\n") and not list(tmp_path.iterdir())


def test_a_user_whom_the_system_does_not_know(monkeypatch, tmp_path):
    """A container that runs under any number: "~" is no folder."""
    monkeypatch.delenv("HOME", raising=False)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.delenv("TEHL_CACHE", raising=False)
    monkeypatch.setattr(os.path, "expanduser", lambda path: path)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    assert user_folders.home() == str(tmp_path) and runtime.preferred_cache().is_relative_to(tmp_path)

    def none():
        raise FileNotFoundError(2, "No usable temporary directory")

    monkeypatch.setattr(tempfile, "gettempdir", none)
    with pytest.raises(RuntimeUnavailable, match="set TMPDIR to a writable folder"):
        user_folders.home()
