"""Files of a run-in between its passages: the common start of all passages and the result so far, beside the checkpoints."""

import json
import os
import zipfile
import zlib
from dataclasses import asdict, fields

import numpy as np

from tehl_taichi.disk import npy
from tehl_taichi.errors import StoreError
from tehl_taichi.plastic.run_in import BodyRunIn, RunInState
from tehl_taichi.plastic.steel_body import SteelState
from tehl_taichi.store import checkpoint
from tehl_taichi.store.integrity import CHECKPOINTS
from tehl_taichi.values.escape import typed

START, LEFT = "start", "run_in"  # names of the files
NUMBERS = "passages", "rounds", "part", "done", "contained", "unsettled", "records"


def start_of(store, state):
    """State of the steady start from which every passage begins: `state` while the store is at that entry, else the kept
    one.
    """
    if int(state["step"]) == 0:
        checkpoint.write(store.path / CHECKPOINTS, START, state)
    return _arrays(store.path, START)


def write(path, state):
    """Keep a RunInState in the store at `path`. Raises OSError."""
    arrays = {f"{name}.{key}": value for name, body in state.bodies.items() for key, value in _of_body(body).items()}
    numbers = {"numbers": np.array(json.dumps({name: getattr(state, name) for name in NUMBERS}))}
    checkpoint.write(path / CHECKPOINTS, LEFT, {**arrays, **numbers, "rest": state.rest})


def read(path, needed=False):
    """Read the RunInState of the store at `path`; without one, the state before the first passage, unless `needed`. Raises
    StoreError.
    """
    if not needed and not os.path.isfile(path / CHECKPOINTS / f"{LEFT}.npz"):
        return RunInState()
    found = _arrays(path, LEFT)
    try:
        numbers = json.loads(str(found.pop("numbers")))
        names = dict.fromkeys(key.partition(".")[0] for key in found if "." in key)
        bodies = {name: _body({key.partition(".")[2]: value for key, value in found.items() if key.startswith(f"{name}.")})
                  for name in names}
        return RunInState(bodies, rest=found.get("rest"), **{**numbers, "records": tuple(numbers["records"])})
    except (KeyError, TypeError, ValueError, AttributeError):
        raise _damaged(path, LEFT) from None


def _of_body(body):
    return {key: value for key, value in vars(body).items() if key != "start"} | asdict(body.start)


def _body(arrays):
    start = SteelState(**{field.name: arrays.pop(field.name) for field in fields(SteelState)})
    return BodyRunIn(start=start, **{**arrays, "mirrored": bool(arrays["mirrored"])})


def _arrays(path, name):
    try:
        return npy.load_all(path / CHECKPOINTS / f"{name}.npz")
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, zlib.error):
        raise _damaged(path, name) from None


def _damaged(path, name):
    return StoreError(f"{path / CHECKPOINTS / name}.npz is damaged or missing, and the run-in in it; `tehl run {typed(path)} "
                      "--out NEW` repeats the run")
