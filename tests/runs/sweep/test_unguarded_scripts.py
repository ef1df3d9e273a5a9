"""Scripts that start workers without `if __name__ == "__main__":`: each worker imports them."""

import subprocess
import sys

import pytest

SWEEP = """import sys

import tehl_taichi as tehl
print("begins", flush=True)
{before}
scene = tehl.scene("smooth-line").replace(**{{"grid.nx": 64, "thermal.on": False}})
tehl.sweep(scene, {{"srr": [0.1, 0.2]}}, "study", workers=2)
"""


@pytest.mark.parametrize("before, said", [
    ("", "workers cannot start: each imports the script that started it"),
    ("open('once', 'x')", "a worker cannot start, for the reason above; it imports the script that started it")])
def test_a_sweep_in_a_script_without_a_guard_ends_at_once_and_says_what_to_do(tmp_path, before, said):
    """Each worker came to the sweep by itself, or failed before it, and was started again for every case."""
    (tmp_path / "script.py").write_text(SWEEP.format(before=before))
    done = subprocess.run([sys.executable, "script.py"], cwd=tmp_path, capture_output=True, text=True, timeout=100)
    last = done.stderr.splitlines()[-1]
    assert done.returncode == 1 and said in last and last.endswith('`if __name__ == "__main__":`; or use workers=1')
    assert done.stdout.count("begins") <= 3 and "bootstrapping" not in done.stderr
