"""The scenes of a flank, run one after another in this process; what stands in stores of them already is taken from there."""

from dataclasses import dataclass
from pathlib import Path

from tehl_taichi.errors import NotConverged, StoreError
from tehl_taichi.study import single
from tehl_taichi.study.progress import Progress


@dataclass(frozen=True)
class Outcome:
    """summary: as `tehl run --json`, None where the scene did not converge; reason: why not; store: its path."""

    store: Path
    summary: dict | None = None
    reason: str = ""


def summaries(scenes, folder, threads=None, progress=None):
    """Outcomes of scenes, in their order, each with a store NAME.zarr in `folder`.

    A scene that does not converge does not stop the others. A store that is there already is gone on with. Raises StoreError
    where it is of another scene; KeyboardInterrupt leaves what is stored.
    """
    folder, progress, found = Path(folder), progress or Progress(), []
    places = [(scene, folder / f"{scene.name}.zarr") for scene in scenes]
    for scene, path in places:
        _check_same(scene, path)
    for n, (scene, path) in enumerate(places):
        progress.stage(STAGE, n, len(scenes))
        progress.say(f"{n + 1} of {len(scenes)}: {scene.name}")
        found.append(_outcome(scene, path, threads, _Named(progress, scene.name)))
    progress.stage(STAGE, len(scenes), len(scenes))
    return found


STAGE = "positions"


def _check_same(scene, path):
    if path.exists() and (stored := single.open(path)).scene != scene:
        raise StoreError(f"{path} is of another scene ({stored.scene.name} with other values); choose another folder")


def _outcome(scene, path, threads, progress):
    try:
        if not path.exists():
            run = single.run(scene, path, threads=threads, progress=progress)
        else:
            run = single.open(path)
            run = run if run.finished else single.resume(path, threads=threads, progress=progress)
    except NotConverged as error:
        return Outcome(path, reason=str(error))
    return Outcome(path, run.summary)


class _Named(Progress):
    """Passes on what one of many runs tells: its stages and steps, and its warnings with its name."""

    def __init__(self, listener, name):
        self.listener, self.name = listener, name

    def warn(self, sentence):
        self.listener.warn(f"{self.name}: {sentence}")

    def step(self, snapshot):
        self.listener.step(snapshot)

    def stage(self, name, done, total):
        self.listener.stage(name, done, total)
