"""Arguments of the Python interface of a wrong kind: a sentence, an error of this package, and nothing is left behind."""

import subprocess
import sys

import pytest

import tehl_taichi as tehl

LINE = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})


@pytest.mark.parametrize("wrong, words", [
    (lambda path: tehl.run(LINE, path, progress=True), "progress = True has no method begin"),
    (lambda path: tehl.run(LINE, path, progress=print), "progress = .* has no method begin"),
    (lambda path: tehl.run(LINE, path, force="no"), "force = 'no' must be true or false"),
    (lambda path: tehl.march("gear", state={}), "is not the state of a snapshot"),
    (lambda path: tehl.march("gear", state=3), "state = 3 is not the state of a snapshot"),
    (lambda path: tehl.crack([], lenth=3), r"unknown option 'lenth' \(did you mean 'length'\?\)"),
], ids=["progress", "callable", "force", "state", "number", "crack"])
def test_a_sentence(wrong, words, tmp_path):
    with pytest.raises(tehl.SceneError, match=words):
        wrong(tmp_path / "line.zarr")
    assert not [*tmp_path.iterdir()]


@pytest.mark.usefixtures("taichi_cpu")
def test_until_is_a_position(tmp_path):
    run = tehl.run(tehl.scene("gear").replace(**{"grid.nx": 32, "grid.ny": 8, "thermal.on": False, "time.steps": 4}),
                   tmp_path / "gear.zarr")
    for until in ("x", float("nan"), None.__class__):
        with pytest.raises(tehl.SceneError, match="until = .* is not a number"):
            run.fatigue(until=until)
    assert run.fatigue(until=float("inf")).summary["Fi_max"] > 0


def test_threads_that_start_together_get_an_answer_each():
    """One of them has Taichi, the others are told so."""
    code = """
import threading, tehl_taichi as tehl
found, line = [], tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
def simulate():
    try:
        found.append(len(tehl.simulate(line)))
    except tehl.RuntimeUnavailable:
        found.append("elsewhere")
some = [threading.Thread(target=simulate) for _ in range(3)]
[one.start() for one in some]; [one.join() for one in some]
print(sorted(map(str, found)))
"""
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert out.strip() == "['1', 'elsewhere', 'elsewhere']"
