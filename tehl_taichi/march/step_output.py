"""Outputs of every step: an entry of `march/outputs/` for each field and each number.

An entry has its unit, the scenes it exists for, and its formula in terms of the solved state. Snapshots are made of these
entries and stores keep them. Nothing here imports taichi: stores are read without it.
"""

import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tehl_taichi.march import outputs
from tehl_taichi.march.sample_state import SAMPLE
from tehl_taichi.values.registry import Checked, Entry, collect


def always(scene):
    """Condition for an output of every scene."""
    return True


def thermal(scene):
    """Condition: the scene has temperatures."""
    return not scene.isothermal


def passing(scene):
    """Condition: the scene has a passage."""
    return scene.transient


@dataclass(frozen=True, kw_only=True)
class StepOutput(Entry):
    """One value of a step. says: long name; of(solved): from a :class:`tehl_taichi.march.solved_state.SolvedState`;
    exists(scene): whether a run of that scene has it; by_hand: sum of the result of `of` for
    :data:`tehl_taichi.march.sample_state.SAMPLE`.
    """

    unit: str
    of: Callable
    by_hand: float
    exists: Callable = always
    checked: tuple[Checked, ...] = ()

    def __post_init__(self):
        def on_sample():
            return float(np.sum(self.of(SAMPLE)))

        object.__setattr__(self, "checked", (Checked("march/sample_state.py, by hand", self.by_hand, on_sample), *self.checked))


@dataclass(frozen=True, kw_only=True)
class Field(StepOutput):
    """A value at every node: `of` returns (ny+1, nx+1) or, with "zeta" among dims, (ny+1, nx+1, nodes across the film); stored
    along dims as dtype.
    """

    dtype: str = "f4"
    dims: tuple[str, ...] = ("x", "y")


@dataclass(frozen=True, kw_only=True)
class Scalar(StepOutput):
    """A number. over: reduction over several steps if only every n-th step is stored (CF's cell methods)."""

    over: str


@functools.cache
def entries(kind):
    """{name: entry} of the kind :class:`Field` or :class:`Scalar`."""
    return collect(outputs, kind)


def names():
    """Names of all outputs, for any scene."""
    return [*entries(Field), *entries(Scalar)]


def fields_of(scene):
    """{name: :class:`Field`} of a run of this scene."""
    return {name: field for name, field in entries(Field).items() if field.exists(scene)}


def scalars_of(scene):
    """{name: :class:`Scalar`} of it."""
    return {name: scalar for name, scalar in entries(Scalar).items() if scalar.exists(scene)}
