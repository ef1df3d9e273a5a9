"""Stress histories of points in rows of a body: under some rows at many depths, and of all rows of its surface."""

import numpy as np

from tehl_taichi.engine.fftw import DOUBLE, SINGLE, real_of
from tehl_taichi.fatigue.stress.averaging import has_window
from tehl_taichi.fatigue.stress.row_stress import RowStress
from tehl_taichi.fatigue.stress.thermal_stress import ThermalStress
from tehl_taichi.fatigue.stress.unit_loads import HELD
from tehl_taichi.fatigue.stress.workers import pool


def _no_progress(done, total):
    """Report nothing."""


def at_the_surface(passage):
    """Function histories(rows, notify, meanwhile) of the points at the surface of a passage (StressHistories).

    It does at the surface what :meth:`tehl_taichi.fatigue.stress.histories.StressHistories.history` does below it, with the
    same arguments and result.
    """
    first, thermal = passage.rows.start, _thermal(passage)

    def histories(rows, notify=_no_progress, meanwhile=lambda: None):
        kinds = [(row, False) for row in range(first + rows.start, first + rows.stop)]
        out = _histories(passage, [0.0], kinds, notify, thermal, meanwhile)
        return out.reshape(-1, *out.shape[3:])

    return histories


def histories_of(passage, depths, kinds, notify=_no_progress):
    """Stress histories under some rows at some depths: a list with an array (depths, x', moments, 6) Pa for each of `kinds`.

    passage: a :class:`tehl_taichi.fatigue.stress.histories.StressHistories`. depths: (n,) m, increasing. kinds: list of (number
    of a row, whether its loads continue along y for ever), the latter ones last. notify: called with (done, total) blocks of
    entries, and depths if the scene has thermal stress. The last moment is unloaded.
    """
    thermal = None if depths[0] else _thermal(passage)
    return list(_histories(passage, depths, kinds, notify, thermal).transpose(1, 2, 0, 3, 4))


def _thermal(passage):
    """The ThermalStress at the surface of a passage, or None without thermal stress."""
    if not passage.scene.has_thermal_stress:
        return None
    return _windowed_heat().on_the_surface(passage) if has_window(passage.reader) else passage.heat(ThermalStress)


def _histories(passage, depths, kinds, notify, thermal, meanwhile=lambda: None):
    """Histories (x', kinds, depths, moments, 6) Pa; arguments as for :func:`histories_of`.

    thermal: the ThermalStress if one of the depths is the surface; meanwhile: function that this thread runs while others
    compute the stresses.
    """
    deep = [n for n, depth in enumerate(depths) if depth] if passage.scene.has_thermal_stress else []
    blocks, stresses = len(passage.blocks), _Stresses(passage, depths, kinds, thermal)
    out = passage.gathered((len(kinds), len(depths)), stresses, lambda done, _: notify(done, blocks + len(deep)), meanwhile)
    if deep:
        _heat(passage, depths, deep, [row for row, _ in kinds], out, lambda n: notify(blocks + n, blocks + len(deep)))
    return passage.resting(out, np.asarray(depths)[:, None], [row for row, _ in kinds])


def _windowed_heat():
    """The class, loaded only where a scene has a window."""
    from tehl_taichi.fatigue.stress.windowed_heat import WindowedHeat

    return WindowedHeat


class _Stresses:
    """Stresses of the entries of a passage, with the thermal stress at the surface; arguments as for :func:`_histories`."""

    def __init__(self, passage, depths, kinds, thermal):
        self.passage, self.of_loads = passage, _of_loads(passage, depths, kinds)
        self.heat = thermal.on([row for row, _ in kinds]) if thermal else None

    def __call__(self, block):
        """Stresses (entries, columns, kinds, depths, 6) Pa of the entries of one block."""
        out = self.of_loads(block)
        for fields, entry in zip(out, block if self.heat else []):
            used = self.passage.band(entry)
            fields[used, :, 0][..., HELD] += self.heat(self.passage.ticks[entry])[used]
        return out


def _of_loads(passage, depths, kinds):
    """Function of a block of entries that returns the stresses of their loads, without heat."""
    if not has_window(passage.reader):
        return _LoadStresses(passage, depths, kinds)
    from tehl_taichi.fatigue.stress.windowed import WindowedStresses

    return WindowedStresses(passage, depths, [row for row, _ in kinds], _kind(passage))


class _LoadStresses:
    """Stresses of the loads of the entries of a passage, on its grid; arguments as for :func:`_histories`."""

    def __init__(self, passage, depths, kinds):
        self.passage, self.operators = passage, _operators(passage, depths, kinds)

    def __call__(self, block):
        """As :class:`_Stresses`, without heat."""
        passage, size = self.passage, self.passage.block
        loads = np.zeros((3, size, passage.grid_x.size, passage.reader.y.size), real_of(_kind(passage)))
        for entry in block:
            loads[:, entry % size] = passage.loads(int(entry))
        found = [operator(*loads[..., rows]) for operator, rows in self.operators]
        return (np.concatenate(found, axis=2) if len(found) > 1 else found[0])[block % size]


def _kind(passage):
    """Precision of the transforms: double for a single row, where it costs little."""
    return SINGLE if passage.reader.y.size > 1 else DOUBLE


def _operators(passage, depths, kinds):
    """List of (RowStress, rows of the loads it takes): one for all rows, and one for each row whose loads continue along y."""
    def made(y, rows):
        return RowStress(passage.grid_x, y, passage.surface.body.nu, passage.line, passage.mirrored, depths, rows,
                         _kind(passage))

    y = passage.reader.y
    plain = [row for row, endless in kinds if not endless]
    out = [(made(y, plain), slice(None))] if plain else []
    return out + [(made(np.zeros(1), [0]), [row]) for row, endless in kinds if endless]


def _heat(passage, depths, deep, rows, out, notify):
    """Add the thermal stress below the surface to the histories `out` (x', kinds, depths, moments, 6) Pa.

    deep: numbers of the depths below the surface; notify: called with the number of depths done.
    """
    first = min(depths[n] for n in deep)
    thermal = passage.below(first, _windowed_heat().below if has_window(passage.reader) else None)
    with pool(passage.nodes) as workers:
        for done, (n, found) in enumerate(zip(deep, workers.map(lambda n: thermal.rows(depths[n], rows), deep)), 1):
            for kind, stresses in enumerate(found):
                out[:, kind, n, :-1] += passage.followed(stresses)
            notify(done)
