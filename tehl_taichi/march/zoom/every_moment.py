"""Reader of a run with its windows at all moments of the windows, also between the steps of the run."""

import functools
from dataclasses import replace

import numpy as np

from tehl_taichi.march.zoom.base_states import POINTS, weights_in_time
from tehl_taichi.march.zoom.zoomed_reader import ZoomedReader


class BetweenSteps:
    """Reader of a run at some of its moments (n,), numbers of steps that may have a fraction, in rising order.

    Fields between steps are those that drive a window: polynomials in time through POINTS steps.
    """

    def __init__(self, run, moments):
        self.run, self.moments, self.x, self.y = run, np.asarray(moments, float), run.x, run.y
        self.time = np.interp(self.moments, np.arange(len(run)), run.time)
        self.residual_fields = getattr(run, "residual_fields", {})

    def __len__(self):
        return len(self.moments)

    def feature_x(self, n):
        """Centre of the feature (m) at entry n."""
        return sum(weight * self.run.feature_x(step) for step, weight in self._steps(n, 2))

    def fields(self, n, names):
        """{name: (nx+1, ny+1) array} of entry n, SI units."""
        parts = [(weight, self.run.fields(step, names)) for step, weight in self._steps(n, POINTS)]
        if len(parts) == 1:
            return parts[0][1]
        return {name: sum(weight * np.asarray(found[name], float) for weight, found in parts) for name in names}

    def parts(self, n):
        """[(entry of a step, weight)]: the loads of entry n are this sum of the loads of steps."""
        return [(int(np.searchsorted(self.moments, step)), weight) for step, weight in self._steps(n, POINTS)]

    def _steps(self, n, points):
        """[(step, weight)] of the polynomial for entry n."""
        return weights_in_time(self.moments[n], points, len(self.run))


def every_moment(reader):
    """The ZoomedReader of the same run and windows with all moments of the windows, or None if it has none between steps."""
    places = _common([[at for at, _, _ in one.between] for one in reader.zoomed])
    if not places.size:
        return None
    steps = {entry for one in reader.zoomed for entry in one.entries}
    moments = np.union1d(np.arange(len(reader), dtype=float), np.concatenate([sorted(steps), places]))
    passages = [_with_all(one, places, moments) for one in reader.zoomed]
    out = ZoomedReader(BetweenSteps(reader.base, moments), passages, reader.refining.mirrored)
    out.tables = reader.tables
    return out


def _common(lists):
    """Moments that all windows have: where one takes shorter steps, it does not keep those of all."""
    return functools.reduce(np.intersect1d, lists, lists[0])


def _with_all(passage, places, moments):
    """The ZoomedPassage with the moments `places` between its entries, which become numbers of `moments`."""
    own = [(float(entry), origin, {name: values[n] for name, values in passage.fields.items()})
           for n, (entry, origin) in enumerate(zip(passage.entries, passage.origins))]
    own = sorted([*own, *(one for one in passage.between if one[0] in places)], key=lambda one: one[0])
    names = passage.between[0][2]
    return replace(passage, entries=[int(n) for n in np.searchsorted(moments, [at for at, _, _ in own])], between=[],
                   origins=[origin for _, origin, _ in own], fields={name: [one[2][name] for one in own] for name in names})
