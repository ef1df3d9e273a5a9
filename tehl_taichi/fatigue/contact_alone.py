"""The contact alone: stresses and index of the smooth bodies under the steady start, at and below the surface."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue import depth_profile, findley, von_mises
from tehl_taichi.fatigue.stress.row_histories import histories_of
from tehl_taichi.fatigue.stress.steady_sweep import SteadySweep


@dataclass(frozen=True)
class ContactAlone:
    """Numbers of one body without features ("Fi_max", "findley_stress_max_Pa", "depth_m", "surface_Fi_max" of its surface, and
    whether the shear of the film and residual stress count, "shear_counted" and "residual_counted"), and Findley stress f (Pa)
    at the surface and at the depths of :func:`tehl_taichi.fatigue.depth_profile.ladder`.
    """

    summary: dict
    f: np.ndarray


def search(scene, reader, surface):
    """The :class:`ContactAlone` of the body of `surface`, for the middle row of the contact and its whole passage.

    scene: its constants matter, its moments and features do not; reader: of a run, whose entry 0 is the steady start. Depths
    below the surface are included unless fatigue.depths is empty.
    """
    sweep = SteadySweep(scene, reader, surface)
    history = _histories(sweep, [0.0])[0]
    strength = sweep.strength
    local = strength.at(0.0)
    surface_f, _ = findley.search(history, local.kappa, criterion=local.criterion)
    f, worst, depth = surface_f, float(surface_f[0]), 0.0
    peaks = [top := von_mises.peak(history, lambda n: (0.0, 0.0, 0.0))]
    if scene.fatigue.depths:
        under = depth_profile.ladder(sweep)
        profile = depth_profile.of_row(sweep, under, _histories(sweep, under), sweep.middle)
        f = np.append(surface_f, profile.f[:, 0])
        peaks.append(profile.mises)
        point = profile.worst
        if (point.compared, point.depth) > (worst, 0.0):
            worst, depth, local = point.f, point.depth, point.local
    return ContactAlone({"Fi_max": worst / local.endurance, "findley_stress_max_Pa": worst, "depth_m": depth,
                         "surface_Fi_max": float(surface_f[0]) / strength.surface_limit,
                         "shear_counted": scene.fatigue.shear, "residual_counted": strength.has_residual,
                         "von_mises": von_mises.summary(peaks, top.value, surface, strength)}, f)


def _histories(sweep, depths):
    """Histories (depths, 1, moments, 6), Pa; the row of a line contact is treated as an endless line."""
    return histories_of(sweep, depths, [(sweep.middle, sweep.line)])[0]
