"""Checkpoints: one .npz file each (with checksums), named by the number of entries before it."""

import os
import zipfile
import zlib

import numpy as np

from tehl_taichi.disk import files, npy
from tehl_taichi.errors import StoreError
from tehl_taichi.values.escape import typed

NEEDED = {"step", "P", "H0"}


def write(folder, number, state):
    """Write the state after entry `number`."""
    with files.replacement(folder / f"{number}.npz") as temporary, open(temporary, "xb") as file:
        np.savez(file, **{key: value for key, value in state.items() if value is not None})


def remove_others(folder, number):
    """Remove all checkpoints but the one of entry `number`."""
    for other in _numbers(folder):
        if other != number:
            (folder / f"{other}.npz").unlink(missing_ok=True)


def load_last(store, folder, steps, shape):
    """Load the last checkpoint within the first `steps` entries. Returns (entries before it, state).

    shape: of its pressure. Raises StoreError.
    """
    number = max((n for n in _numbers(folder) if n <= steps), default=None)
    if number is None:
        raise StoreError(f"{store} holds no checkpoint, so it cannot be resumed; `tehl run {typed(store)} --out NEW` repeats "
                         "the run")
    try:
        state = npy.load_all(folder / f"{number}.npz") if os.path.isfile(folder / f"{number}.npz") else {}
    except (OSError, ValueError, KeyError, EOFError, AttributeError, NotImplementedError, zipfile.BadZipFile, zlib.error):
        state = {}
    if not NEEDED <= state.keys() or state["P"].shape != shape:
        raise StoreError(f"the checkpoint {folder / f'{number}.npz'} is damaged or of another grid; the store can be read, and "
                         f"`tehl run {typed(store)} --out NEW` repeats the run")
    return number, state


def _numbers(folder):
    return [int(file.stem) for file in folder.glob("*.npz") if file.stem.isdigit()]
