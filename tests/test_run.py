"""tehl.run, open and resume: what the command line does, from Python."""

import numpy as np
import pytest

import tehl_taichi as tehl

pytestmark = pytest.mark.usefixtures("taichi_cpu")
# a ridge: one dimension
RIDGE = tehl.scene("gear").replace(**{"feature.shape": "ridge", "grid.nx": 64, "grid.ny": 8, "thermal.on": False,
                                      "time.steps": 4})


class Heard(tehl.Progress):
    """Notes all that a run tells; Ctrl-C at the end of one step."""

    def __init__(self, stop=None):
        self.said, self.doubts, self.stages, self.steps, self.stop = [], [], [], [], stop

    def say(self, text):
        self.said.append(text)

    def warn(self, sentence):
        self.doubts.append(sentence)

    def stage(self, name, done, total):
        self.stages.append((name, done, total))

    def step(self, snapshot):
        self.steps.append(snapshot.step)
        if snapshot.step == self.stop:
            raise KeyboardInterrupt


@pytest.fixture(scope="module")
def done(taichi_cpu, tmp_path_factory):
    """(run of four steps, what it told)."""
    heard = Heard()
    return tehl.run(RIDGE, tmp_path_factory.mktemp("run") / "a.zarr", progress=heard), heard


def test_a_run_tells_its_stages_and_steps(done):
    run, heard = done
    assert heard.steps == [1, 2, 3, 4] and heard.doubts == RIDGE.warnings() and "passage cut" in heard.doubts[-1]
    assert any("left out: y direction" in said for said in heard.said)
    passage = [(n, total) for name, n, total in heard.stages if name == "passage"]
    assert passage == [(n, 4) for n in range(5)]
    assert list(dict.fromkeys(name for name, *_ in heard.stages)) == ["steady start", "passage", "stresses and fatigue",
                                                                      "companion runs"]
    last = {name: n == total for name, n, total in heard.stages}
    assert all(last.values()) and len(last) == 4


def test_a_run_is_what_is_stored(done):
    run, _ = done
    again = tehl.open(str(run.path))
    assert run.finished and again.summary == run.summary and again.scene == run.scene == RIDGE
    assert run.summary["steps"] == 4 and run.summary["fatigue"]["Fi_max"] > 0 and run.summary["store"] == str(run.path)
    shots = list(tehl.march(RIDGE))
    assert again.warnings == run.warnings == run.summary["warnings"]
    assert run.summary["transient"]["p_max_Pa"] == max(shot.scalars["p_max_Pa"] for shot in shots[1:])
    np.testing.assert_array_equal(run.store.fields(4)["film"], shots[4].fields["film"].astype("f4"))
    assert repr(run) == f"<tehl.Run gear: 4 steps, finished, {run.path}>"


def test_ctrl_c_says_what_is_stored_and_is_no_error_of_ours(done, tmp_path):
    path = tmp_path / "b.zarr"
    with pytest.raises(KeyboardInterrupt, match="interrupted after [12] steps; go on with: tehl resume .*b.zarr"):
        tehl.run(RIDGE, path, progress=Heard(stop=2))
    half = tehl.open(path)
    assert not half.finished and half.summary == {} and "not finished" in repr(half) and half.rest() == RIDGE
    assert tehl.resume(path).finished
    for n in range(5):
        np.testing.assert_array_equal(half.store.fields(n)["film"], done[0].store.fields(n)["film"])


def test_a_finished_run_goes_on_behind_its_end(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run = tehl.run(RIDGE.replace(**{"time.steps": np.int64(1), "fatigue.on": False}))
    assert str(run.path) == "runs/gear-1.zarr" and run.rest(2).time.steps == 3
    heard = Heard()
    more = tehl.resume(run.path, steps=2, progress=heard)
    assert heard.steps == [2, 3] and more.summary["steps"] == 3
    whole = tehl.run(tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False}), "s.zarr")
    assert whole.rest() is None and tehl.resume("s.zarr", progress=heard).summary == whole.summary and len(heard.steps) == 2


@pytest.mark.parametrize("words, said", [
    (("geer",), "gear"), (("no.toml",), "cannot read"), ((5,), "5 is no scene"), ((RIDGE, "a", {"threads": 0}), "1 to 1024"),
    ((RIDGE, "a", {"threads": 1}), "already runs"), ((RIDGE, "a", {"arch": "cuda"}), "cpu")])
def test_bad_input_is_one_error_and_writes_nothing(tmp_path, monkeypatch, words, said):
    monkeypatch.chdir(tmp_path)
    *words, options = words if isinstance(words[-1], dict) else (*words, {})
    with pytest.raises(tehl.Error, match=said) as error:
        tehl.run(*words, **options)
    assert error.value.exit_code == 2 and list(tmp_path.iterdir()) == []
    with pytest.raises(tehl.Error, match="whole number"):
        tehl.resume("a", steps=0.5)
