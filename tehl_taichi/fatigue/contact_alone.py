"""The contact alone: stresses and index of the smooth bodies under the steady start, at and below the surface."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue import depth_profile, exact_depths, findley, von_mises
from tehl_taichi.fatigue.stress.row_histories import histories_of
from tehl_taichi.fatigue.stress.steady_sweep import SteadySweep

FIRST = 32  # rows of a surface: on finer grids every second, third ... row first, then those beside the worst


@dataclass(frozen=True)
class ContactAlone:
    """Numbers of one body without features ("Fi_max", "findley_stress_max_Pa", "depth_m", "surface_Fi_max" of its surface, and
    whether the shear of the film and residual stress count, "shear_counted" and "residual_counted"), and Findley stress f (Pa)
    on the middle row, at the surface and at the depths of :func:`tehl_taichi.fatigue.depth_profile.ladder`.
    """

    summary: dict
    f: np.ndarray


def search(scene, reader, surface):
    """The :class:`ContactAlone` of the body of `surface`: rows of its surface, below it the middle and the worst one.

    scene: its constants matter, its moments and features do not; reader: of a run, whose entry 0 is the steady start. Depths
    below the surface are included unless fatigue.depths is empty. A line contact has one row.
    """
    sweep = SteadySweep(scene, reader, surface)
    strength, local = sweep.strength, sweep.strength.at(0.0)
    rows, histories, at_surface = _at_surface(sweep, local)
    top = int(np.argmax(at_surface))
    f, worst, depth = at_surface[[rows.index(sweep.middle)]], float(at_surface[top]), 0.0
    peaks = [most := von_mises.peak(histories, lambda n: (0.0, 0.0, sweep.reader.y[rows[n]]))]
    if scene.fatigue.depths:
        profiles = _profiles(sweep, list(dict.fromkeys([sweep.middle, rows[top]])))
        f = np.append(f, profiles[0].f[:, 0])
        peaks += [profile.mises for profile in profiles]
        point = max((profile.worst for profile in profiles), key=lambda one: (one.compared, one.depth))
        if (point.compared, point.depth) > (worst, 0.0):
            worst, depth, local = float(point.f), point.depth, point.local
    return ContactAlone({"Fi_max": worst / local.endurance, "findley_stress_max_Pa": worst, "depth_m": depth,
                         "surface_Fi_max": float(at_surface[top]) / strength.surface_limit,
                         "shear_counted": scene.fatigue.shear, "residual_counted": strength.has_residual,
                         "von_mises": von_mises.summary(peaks, most.value, surface, strength)}, f)


def _at_surface(sweep, local):
    """(rows, histories (rows, moments, 6) in Pa, Findley stress (rows,) in Pa) of the surface: of some FIRST rows, and of those
    beside the worst one. A line contact has one row.
    """
    all_rows = [sweep.middle] if sweep.line else range(sweep.reader.y.size)
    every = max(1, len(all_rows) // FIRST)
    rows = [row for row in all_rows if (row - sweep.middle) % every == 0]
    histories, f = _searched(sweep, local, rows)
    top = rows[int(np.argmax(f))]
    beside = [row for row in all_rows if 0 < abs(row - top) < every]
    if beside:
        more, others = _searched(sweep, local, beside)
        rows, histories, f = rows + beside, np.concatenate([histories, more]), np.append(f, others)
    return rows, histories, f


def _searched(sweep, local, rows):
    """(histories (rows, moments, 6), Findley stress (rows,)), Pa, of these rows of the surface; local: their strength."""
    histories = np.concatenate([found[0] for found in _histories(sweep, [0.0], rows)])
    return histories, findley.search(histories, local.kappa, criterion=local.criterion)[0]


def _profiles(sweep, rows):
    """The :class:`tehl_taichi.fatigue.depth_profile.DepthProfile` under each of these rows."""
    under = depth_profile.ladder(sweep)
    found = [depth_profile.of_row(sweep, under, one, row) for row, one in zip(rows, _histories(sweep, under, rows))]
    return exact_depths.computed(sweep, rows, found, endless=sweep.line)


def _histories(sweep, depths, rows):
    """Histories (depths, 1, moments, 6), Pa, of each of these rows; that of a line contact is treated as an endless line."""
    return histories_of(sweep, depths, [(row, sweep.line) for row in rows])
