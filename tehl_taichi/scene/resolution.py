"""Resolution of features by the grid, and their path through the domain."""

import math
from dataclasses import dataclass, replace

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_text import Option, grid_option
from tehl_taichi.values.coded_warning import with_data

# Cells per width of a feature. Measured on passages of bumps, ridges, furrows and roughness (isothermal, against grids four
# times finer): film under it and largest pressure off by 20 to 40 % with 3 to 4 cells, 5 to 20 % with 6 to 9, 2 to 5 % with
# 12 to 18, 1 % with 35.
FEWEST, ENOUGH = 4, 16
SURE = 32  # for a film within 1 %
MULTIPLES = {"nx": (16, 8192), "ny": (4, 4096)}  # that a grid must keep to, and its most cells
WINDOW = 8  # times as fine as a grid is the finest window
HALVED = 2  # times: by the coarse-grid runs for the errors of a run
MOST_FEATURES = 256  # each costs a time step 1 ms on 256 x 64 cells: with 60 of them a step takes twice as long


@dataclass(frozen=True)
class AxisResolution:
    """Resolution of a feature (by its number) along one axis: key of its length there (m), cells per length, cells of the
    grid.
    """

    feature: int
    key: str
    length: float
    count: str
    cells: float
    grid: int

    def grid_for(self, cells):
        """Number of cells of a grid with `cells` per length."""
        multiple = kept_multiple(self.count, self.grid)
        return max(math.ceil(self.grid * cells / self.cells / multiple - 1e-9) * multiple, self.grid)


def kept_multiple(count, cells):
    """Multiple to which the number of cells along this axis is rounded: if the present one can be halved for error bars, so can
    the advised one.
    """
    least = MULTIPLES[count][0]
    return least << HALVED if cells % (least << HALVED) == 0 else least


def check_count(features):
    """Refuse more than MOST_FEATURES features. Raises SceneError."""
    if len(features) > MOST_FEATURES:
        raise SceneError(f'{len(features)} features are too many; allowed: at most {MOST_FEATURES}, or all of them in '
                         'one height map (shape = "map")')


def check(scene):
    """Refuse features outside the domain, or that fall between the nodes of the grid. Raises SceneError."""
    if not scene.transient:
        return
    scales = Scales.of(scene)
    for n, feature in enumerate(scene.features):
        _check_x(scene, scales, label(scene, n), feature)
        _check_y(scene, scales, label(scene, n), feature)
    worst = min(sights(scene), key=lambda sight: sight.cells, default=None)
    times = max(scene.zoom.factor, 1)
    if worst and worst.cells * times < FEWEST:
        raise SceneError(f"{worst.key} = {worst.length:.3g} m is {_too_few(worst.cells)} cells of grid.{worst.count} = "
                         f"{worst.grid}, too few to resolve it; allowed: at least {FEWEST / times:g} cells: "
                         f"{_remedy(scene, FEWEST / times, worst)}")


def _too_few(cells):
    """Text of a number of cells with two digits, rounded down: 3.98 are not the 4 that are allowed."""
    digit = 10.0 ** (math.floor(math.log10(cells)) - 1)
    return f"{math.floor(cells / digit + 1e-6) * digit:.2g}"


def shortest_length(scene):
    """Contact half-width (m), or the width of a narrower feature that passes."""
    widths = [f.width for f in scene.features if f.width] if scene.transient else []
    return min([Scales.of(scene).a, *widths])


def label(scene, n):
    """Name of feature n in messages."""
    return "feature" if len(scene.features) == 1 else f"feature.{n}"


def _check_x(scene, scales, name, feature):
    pace = next(s.pace for s in scene.surfaces if s.name == feature.surface)
    low, high = (pace * p + (feature.x + sign * feature.reach) / scales.a for p, sign in zip(scene.path, (-1, 1)))
    if high <= scene.grid.x_min or low >= scene.grid.x_max:
        raise SceneError(f"{name}: no part of it passes through the domain: from time.x_start = {scene.path[0]:g} a to x_end "
                         f"= {scene.path[1]:g} a it covers {low:.3g} to {high:.3g} a, the domain grid.x_min = "
                         f"{scene.grid.x_min:g} a to x_max = {scene.grid.x_max:g} a")


def _check_y(scene, scales, name, feature):
    edge, (_, cell) = scene.grid.y_max * scales.b, scales.cell(scene.grid)
    if not feature.transverse and abs(feature.y) + cell > edge + feature.reach_y:
        raise SceneError(f"{name}.y = {feature.y:g} m: no part of the feature, which reaches {feature.reach_y:.3g} m to each "
                         f"side, passes through the domain; allowed: -{edge + feature.reach_y - cell:.3g} to "
                         f"{edge + feature.reach_y - cell:.3g} m, or a larger grid.y_max (= {scene.grid.y_max:g} b, "
                         f"{edge:.3g} m)")


def sights(scene, passing=False):
    """AxisResolution of each feature along each axis on which its shape declares a size. passing: of the passage, even if the
    scene is still steady.
    """
    g = scene.grid
    cell = dict(zip(MULTIPLES, Scales.of(scene).cell(g)))
    out = []
    for n, f in enumerate(scene.features):
        along, across = f.kind.sizes(f)
        for count, lengths in (("nx", along), ("ny", {} if scene.one_dimensional and not passing else across)):
            if lengths:
                key, length = min(lengths.items(), key=lambda one: one[1])
                name = f"{label(scene, n)}.{key}"
                out.append(AxisResolution(n, name, length, count, length / cell[count], getattr(g, count)))
    return out


def resolved_features(scene, times):
    """Features that a grid with 1/times as many cells along each axis still resolves: of sums of waves the long waves, of
    others those of sufficient size.
    """
    cells = [FEWEST * times * cell for cell in Scales.of(scene).cell(scene.grid)]
    seen = [f.kind.coarser(f, *cells) for f in scene.features]
    seen = replace(scene, features=tuple(f for f in seen if f is not None))
    lost = {sight.feature for sight in sights(seen) if sight.cells < FEWEST * times}
    return tuple(f for n, f in enumerate(seen.features) if n not in lost)


def _remedy(scene, cells, worst):
    """Advice: the grid, or a window and a grid, that gives every feature `cells` cells, or another remedy."""
    if found := _finer(scene, cells):
        return found
    if not scene.zoom.factor and (found := _finer(scene, cells / WINDOW)):
        return Option(f"--zoom {WINDOW} with {found}", f"a window {WINDOW} times as fine with {found.words}")
    return f"no grid is fine enough; {worst.key} of {worst.length * cells / worst.cells:.2g} m is enough on this one"


def _finer(scene, cells):
    """Option of the grid that gives every feature `cells` cells; None if it is too large."""
    need = {count: max([getattr(scene.grid, count), *(s.grid_for(cells) for s in sights(scene) if s.count == count)])
            for count in MULTIPLES}
    fits = all(need[count] <= most for count, (_, most) in MULTIPLES.items())
    return grid_option(scene, need["nx"], need["ny"]) if fits else None


def warnings(scene):
    """Warnings about the resolution of the features of a scene and about their paths."""
    if not scene.transient:
        return []
    return [*_coarse(scene), *_beside(scene)]


def _coarse(scene):
    worst, times = min(sights(scene), key=lambda sight: sight.cells, default=None), max(scene.zoom.factor, 1)
    if worst is None or worst.cells * times >= ENOUGH:
        return []
    remedy = _remedy(scene, ENOUGH / times, worst)
    window = f", {worst.cells * times:.1f} of the window" if times > 1 else ""
    text = (f"{worst.key} = {worst.length:.3g} m is {worst.cells:.1f} cells of grid.{worst.count} = {worst.grid}{window}; "
            f"with fewer than {ENOUGH} the film and pressure at a feature have errors above 5 % (about 20 % with 8, 40 % with "
            f"4); {remedy}")
    return [with_data(text, remedy, length_m=worst.length, cells=worst.cells)]


def misses_contact(f, scales):
    """Whether a feature passes beside the contact."""
    return not scales.line and abs(f.y) - f.reach_y >= scales.b


def _beside(scene):
    s = Scales.of(scene)
    return [f"{label(scene, n)}.y = {f.y:g} m: the feature passes beside the contact, which reaches to {s.b:.3g} m"
            for n, f in enumerate(scene.features) if not f.transverse and misses_contact(f, s)]
