"""Stress histories under rows of material points at many depths, the surface (0) among them if wanted."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from tehl_taichi.engine.fftw import SINGLE
from tehl_taichi.fatigue.row_stress import RowStress
from tehl_taichi.fatigue.thermal_stress import WORKERS, ThermalStress
from tehl_taichi.fatigue.unit_loads import HELD

BLOCK = 16  # entries whose stresses are found at once


def histories_of(passage, depths, kinds, tell=lambda done, total: None):
    """A list of (depths, x', moments, 6) Pa, one for each kind: (row, whether its loads go on as an endless line).

    passage: a :class:`tehl_taichi.fatigue.histories.Passage`; depths: m, increasing. The last moment is the unloaded state.
    tell: called with (done, total): blocks of entries, and depths where there is heat.
    """
    operators = _operators(passage, depths, kinds)
    out = np.zeros((len(kinds), passage.x.size, len(depths), passage.centres.size + 1, 6))
    entries = np.unique(passage.entries)

    def fill(block):
        loads = np.zeros((3, BLOCK, passage.grid_x.size, passage.reader.y.size))
        for entry in block:
            loads[:, entry % BLOCK] = passage.loads(int(entry))
        for operator, rows, those in operators:
            for n, stresses in zip(those, operator(*loads[..., rows])):
                for entry in block:
                    passage.follow(out[n], entry, stresses[entry % BLOCK].swapaxes(0, 1))

    # by their numbers: an entry has its place in the same block, and so the same bits, whatever moments are searched
    blocks = np.split(entries, np.flatnonzero(np.diff(entries // BLOCK)) + 1)
    hot = passage.scene.thermal_stress_wanted
    total = len(blocks) + hot * len(depths)
    with ThreadPoolExecutor(WORKERS) as pool:
        for done, _ in enumerate(pool.map(fill, blocks), 1):
            tell(done, total)
    if hot:
        _heat(passage, depths, [row for row, _ in kinds], entries, out, lambda n: tell(len(blocks) + n, total))
    return passage.resting(out).swapaxes(1, 2)


def _operators(passage, depths, kinds):
    """(RowStress, rows of loads that it takes, which of the kinds it gives): one of all loads for all rows, one of each row
    whose loads go on."""
    def made(y, rows):
        return RowStress(passage.grid_x, y, passage.scene.body_a.nu, passage.line, passage.mirrored, depths, rows,
                         SINGLE)

    plain = [n for n, (_, endless) in enumerate(kinds) if not endless]
    out = [(made(passage.reader.y, [kinds[n][0] for n in plain]), slice(None), plain)] if plain else []
    return out + [(made(np.zeros(1), [0]), [row], [n]) for n, (row, endless) in enumerate(kinds) if endless]


def _heat(passage, depths, rows, entries, out, tell):
    """Thermal stress added to the histories `out` (kinds, x', depths, moments, 6); tell: called with the depths done."""
    thermal, part = passage.below(min(depth for depth in depths if depth)), np.zeros_like(out[0, :, 0])

    def at(depth):
        return thermal.rows(depth, rows) if depth else _at_the_surface(passage, rows)

    with ThreadPoolExecutor(WORKERS) as pool:
        for n, found in enumerate(pool.map(at, depths)):
            for histories, stresses in zip(out, found):
                for entry in entries:
                    passage.follow(part, entry, stresses[passage.ticks[entry]])
                histories[:, n] += part
            tell(n + 1)


def _at_the_surface(passage, rows):
    """(rows, entries, columns, 6) Pa."""
    thermal = passage.heat(ThermalStress)
    out = np.zeros((len(rows), len(thermal.rises), thermal.columns, 6))
    for entry in range(len(thermal.rises)):
        held = np.stack(thermal(entry), axis=-1)
        out[:, entry][..., HELD] = held[:, rows].swapaxes(0, 1)
    return out
