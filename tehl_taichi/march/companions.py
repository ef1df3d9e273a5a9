"""Companions of a run: the same passage on grids with a half and a quarter of the cells, whose numbers tell its errors.

They run in a process of their own with one thread, beside the march, at the lowest priority. What happens to them never hurts
the run: a companion that is refused, does not converge or is not ready in time means that a bar is not known, and why.
"""

import base64
import contextlib
import json
import os
import pickle
import subprocess
import sys
import threading
from dataclasses import asdict, replace
from types import SimpleNamespace

import numpy as np

from tehl_taichi.engine import cores, runtime
from tehl_taichi.errors import Error
from tehl_taichi.march import readings
from tehl_taichi.march.error_bars import Reading, bars
from tehl_taichi.march.peaks import sharpest

COMPANIONS = 2  # with the run itself three grids; 1/8 and 1/64 of its cells and steps
WORTH = 3e5  # nodes times steps of a run: below, a companion's process takes longer to start than the run takes
PATIENCE = 0.2  # of the time of a run, to wait for companions that nobody asked for
LOWEST = 19  # priority of their process: they take what the run leaves


def scenes(scene):
    """([scenes with half and a quarter of the cells, coarsest first], [why others are left out]); steps grow with the cells."""
    out, refused = [], []
    for level in range(1, COMPANIONS + 1):
        nx, ny = scene.grid.nx // 2**level, scene.grid.ny // 2**level
        steps = min(scene.time.steps, max(1, scene.time.steps // 2**level))  # -1 is all
        try:
            out.append(scene.replace(**{"grid.nx": nx, "grid.ny": ny, "time.steps": steps, "output.profiles": False,
                                        "fatigue.depths": []}))
        except Error as error:
            refused.append(f"a companion run on {nx} x {ny} cells is refused: {error}")
    return out[::-1], refused


def passage_readings(scene, reader, scalar, fatigue=None):
    """{name: Reading} of the numbers of a passage.

    reader: entries as :class:`tehl_taichi.fatigue.histories.Passage` takes them, the steady start first; scalar(name): array of
    the entries' values; fatigue: summary of its search or None.
    """
    p, h = (scalar(name)[1:] for name in ("p_max_Pa", "h_min_m"))
    heat = () if scene.isothermal else readings.HEAT
    out = {"p_max_Pa": readings.highest(_moment(reader, int(np.argmax(p)) + 1)),
           "h_min_m": readings.lowest(_moment(reader, int(np.argmin(h)) + 1)),
           **{name: Reading(float(np.max(scalar(name)[1:]))) for name in heat},
           "friction_coefficient_mean": Reading(float(np.mean(scalar("friction_coefficient")[1:])))}
    out |= {"Fi_max": Reading(float(fatigue["Fi_max"]))} if fatigue else {}
    # a peak that the grid does not resolve at some moment: neither its pressure is known nor what it does to oil and steel
    spike = max(sharpest(reader.fields(n, ("pressure",))["pressure"], p.max()) for n in range(1, len(p) + 1))
    why = readings.doubt(reader.x, *spike)
    return out | {name: replace(out[name], doubt=why) for name in ("p_max_Pa", "film_max_C", "Fi_max") if why and name in out}


def values(scene):
    """{name: Reading} of one companion. Raises NotConverged."""
    from tehl_taichi.fatigue import assessment
    from tehl_taichi.march.passage import march

    shots = list(march(scene))
    found = assessment.run(scene, shots).summary if scene.fatigue_wanted and len(shots) > 2 else None
    return passage_readings(scene, assessment.Snapshots(shots),
                            lambda name: np.array([shot.scalars[name] for shot in shots]), found)


def _moment(reader, n):
    return SimpleNamespace(x=reader.x, feature_x=reader.feature_x(n), fields=reader.fields(n, ("pressure", "film")))


def beside(scene, steps):
    """The companions of a run of `steps` time steps as a context, or one in which nothing happens: those that nobody asked for
    need a core beside the run, and a run that is worth it."""
    asked, nodes = scene.numerics.estimate_error, (scene.grid.nx + 1) * (scene.rows + 1)
    free = cores.available() > 1 and nodes * steps >= WORTH
    wanted = scene.transient and steps >= 1 and (asked is True or asked is not False and free)
    return Companions(scene) if wanted else Nobody(scene)


class Nobody(contextlib.nullcontext):
    """No companions: no error is known, and nobody asked; but what the grid of the run itself does not resolve is said."""

    def __init__(self, scene):
        self.scene = scene

    def __enter__(self):
        return self

    def errors(self, reader, fatigue, seconds):
        """As those of :class:`Companions`: doubts alone, of passages."""
        if len(reader) < 2:
            return {}
        own = passage_readings(self.scene, reader, reader.scalar, fatigue)
        return {"passage_unknown": {name: reading.doubt for name, reading in own.items() if reading.doubt}}


class Companions:
    """The companions of a scene in their process; a context that ends them. :meth:`errors` waits for them."""

    def __init__(self, scene):
        self.scene, (self.scenes, self.reasons) = scene, scenes(scene)
        job = base64.b64encode(pickle.dumps(self.scenes)).decode()  # with the heights of their maps
        call = [sys.executable, "-c", "from tehl_taichi.march.companions import serve; serve()"]
        # a session of its own: Ctrl-C is for the run, which ends its companions by closing their input
        self.process = subprocess.Popen(call, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        text=True, start_new_session=True)
        self.lines = []
        self.listener = threading.Thread(target=lambda: self.lines.extend(self.process.stdout), daemon=True)
        self.listener.start()
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.write(job + "\n")
            self.process.stdin.flush()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.close()

    def errors(self, reader, fatigue, seconds):
        """{"passage_error": {name: error bar or None}, "passage_unknown": {name: why it is None}} of the numbers of a run.

        reader: its store; fatigue: summary of its search or None; seconds that it took: companions that were asked for are
        waited for, others PATIENCE of it.
        """
        self.listener.join(None if self.scene.numerics.estimate_error is True else PATIENCE * seconds)
        answers = [{"reason": reason} for reason in self.reasons] + [json.loads(line) for line in self.lines]
        if len(self.lines) < len(self.scenes):
            late = "were not ready when the run was (--estimate-error waits for them)"
            answers.append({"reason": f"the companion runs {late if self.listener.is_alive() else 'ended without an answer'}"})
        found, unknown = judged(answers, passage_readings(self.scene, reader, reader.scalar, fatigue))
        return {"passage_error": found, "passage_unknown": unknown}


def judged(answers, own):
    """({name: error bar or None}, {name: why it is None}) of own {name: Reading}; answers: of the companions, coarsest first,
    {"values": {name: a Reading's values}} or {"reason": why there are none}."""
    grids, reasons = [], []
    for answer in answers:
        if "reason" in answer:  # too coarse a grid: neither it nor the coarser ones tell anything
            grids, reasons = [], [*reasons, answer["reason"]]
        else:
            grids.append({name: Reading(**values) for name, values in answer["values"].items()})
    found, unknown = bars([*grids, own])
    return found, unknown if grids else dict.fromkeys(unknown, "; ".join(reasons) or "there are no coarser grids")


def serve():
    """The process of the companions: a job on the first line of stdin, an answer a line on stdout; ends with its input."""
    job = pickle.loads(base64.b64decode(sys.stdin.readline()))
    threading.Thread(target=_end_with_parent, daemon=True).start()
    if hasattr(os, "nice"):
        os.nice(LOWEST)
    runtime.start(threads=1)
    for one in job:
        print(json.dumps(answer(one)), flush=True)


def answer(scene):
    """What a companion tells, for :func:`judged`."""
    try:
        return {"values": {name: asdict(reading) for name, reading in values(scene).items()}}
    except Error as error:
        return {"reason": f"a companion run on {scene.grid.nx} x {scene.grid.ny} cells failed: {error}"}


def _end_with_parent():
    sys.stdin.read()
    os._exit(1)
