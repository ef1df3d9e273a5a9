"""What a measured height map is and whether unit, pixel and grid suit it: lines printed before a run, and doubts."""

import os

import numpy as np

from tehl_taichi.scene import height_map, map_filter
from tehl_taichi.scene.height_map import LEVELS, Measures, missed
from tehl_taichi.scene.map_form import FLAT
from tehl_taichi.scene.scales import Scales

STEEP = 10.0  # degrees: the film equation takes slopes for small (tan 10 deg = 0.18)
SHARE = 0.1  # of the rms that a grid, or the map's own points, may miss: a wave of six cells
TURNED = "Heights count out of the metal and most bodies are convex: is it upside down? feature.scale = -1 turns it over"
RIM = 0.1  # of the rms: a step at the rim below that is roughness like the rest
CUTOFFS = (4, 6, 8, 12, 16)  # cells, that a cutoff is looked for among
JUDGED = 1024  # points along each side, from the middle, that are judged


def doubts(f, scene):
    """Sentences about a map that has holes, has the form of its body, is flat or steep, finer or coarser than the grid, or ends
    in a step."""
    return [sentence for check in (_holes, _form, _size, _grid, _rim) for sentence in check(f, scene)]


def cells(scene):
    """(along x, along y): size of a cell of the grid in m."""
    s, g = Scales.of(scene), scene.grid
    return (g.x_max - g.x_min) * s.a / g.nx, g.y_max * s.b / g.ny


def lines(f, scene):
    """Two lines: what was read, and what passes through the contact."""
    cell = cells(scene)
    (along, across), m, name = f.points, f.measures, f"map {os.path.basename(f.file)}"
    heights = f"heights in {f.unit}" + (f" times {f.scale:g}" if f.scale != 1 else "")
    turned = f"{f.orientation.says}, " if f.orientation.says else ""
    off = f"{LEVELS[f.level]} taken off" + (f" ({f.form.says})" if f.level == "form" else "")
    skipped = f"{found}, " if (found := height_map.skipped(f.sha256)) else ""
    yield (f"{name}: {skipped}{along} x {across} points {_apart(f)} um apart, {_um(f.patch[0])} x {_um(f.patch[1])} um of them "
           f"used, {turned}{heights}, {off}{_filter(f)}")
    yield (f"{name}: {_um(m.low)} to {_um(m.high)} um (range {_um(m.range)} um), rms {_um(m.rms)} um, largest slope "
           f"{m.slope:.2g} deg; a cell of the grid has {cell[0] / f.steps[0]:.3g} x {cell[1] / f.steps[1]:.3g} points")


def _filter(f):
    return f", low-pass with a cutoff of {_um(f.cutoff)} um (Gaussian)" if f.cutoff else ""


def _apart(f):
    """Distances of its points, in um: one number where they are one."""
    return " x ".join(dict.fromkeys(map(_um, f.steps)))


def _um(value):
    return f"{value * 1e6:.4g}"


def _holes(f, scene):
    count = int(f.holes.sum())
    if count:
        yield (f"{_name(f)}: {count} of its {f.heights.size} points were not measured; they are filled smoothly from their "
               "neighbours, so nothing that passes there is known")


def _form(f, scene):
    form = f.form
    if not form.dominant:
        return
    turned = "" if form.convex else f". {TURNED}"
    if f.level != "form":
        yield (f"{_name(f)}: all but {_um(form.left)} um of its rms of {_um(form.flat)} um are one curvature, {form.says}. If "
               f"it is that of the body, whose radius the scene has already, feature.level = 'form' takes it off{turned}")
    elif turned:
        yield f"{_name(f)}: the form taken off is {form.says}{turned}"


def _size(f, scene):
    m, told = f.measures, f"{_name(f)}: heights in {f.unit}"
    helps = f", or roughness? {found}" if m.slope > STEEP and (found := _cutoff(f, scene)) else "?"
    if m.rms < FLAT:
        yield f"{told} have an rms of {m.rms * 1e9:.2g} nm, nothing to a film; is feature.unit = {f.unit!r} right?"
    if m.slope > STEEP:
        yield (f"{told} have slopes up to {m.slope:.3g} deg; the film equation takes slopes for small (below {STEEP:g} deg): "
               f"spikes of the measurement{helps}")


def _name(f):
    return f"feature.file = {os.path.basename(f.file)!r}"


def _grid(f, scene):
    steps, heights, lost = _seen(f, scene)
    own = missed(heights, 2, 2)
    if lost > SHARE:
        yield (f"{_name(f)}: the grid misses {lost:.0%} of the map's rms ({_finer(heights, steps, scene.grid)}"
               f"{f'; {found}' if (found := _cutoff(f, scene)) else ''})")
    if min(steps) < 1 and own > SHARE:
        yield (f"{_name(f)}: points {_apart(f)} um apart are {1 / min(steps):.2g} cells and do not resolve their own "
               f"roughness ({own:.0%} of the rms changes without every second one); heights are taken as linear between them")


def _seen(f, scene):
    """(points in a cell along x and y, heights that are judged, share of their rms that the grid misses)."""
    steps, heights = [size / step for size, step in zip(cells(scene), f.steps)], _middle(f.used)
    return steps, heights, missed(heights, *steps)


def carried(scene):
    """Whether the grid sees every map of the scene."""
    return all(_seen(f, scene)[-1] <= SHARE for f in scene.features if f.kind.measured)


def _cutoff(f, scene):
    """The first cutoff of some cells with which the doubts about grid and slopes are gone, in words; "" where there is none."""
    size, (least, most) = max(cells(scene)), map_filter.limits(f)
    for count in CUTOFFS:
        cutoff = float(f"{count * size:.1e}")
        if max(least, f.cutoff) < cutoff < most and _taken(_middle(f.inside(f.filtered(cutoff))), f.steps, cells(scene)):
            return f"feature.cutoff = {cutoff:g} (m, {count} cells) filters what is finer"
    return ""


def _taken(heights, steps, cell):
    """Whether heights (points along y, along x) in m, those steps (m) apart, are long and flat enough for such cells (m)."""
    seen = missed(heights, *(size / step for size, step in zip(cell, steps))) <= SHARE
    return seen and Measures.of(heights, steps).slope <= STEEP


def _finer(heights, steps, grid):
    """The grid that would see it, in words."""
    factor = 2
    while missed(heights, steps[0] / factor, steps[1] / factor) > SHARE:  # ends at the map's own points
        factor *= 2
    nx, ny = grid.nx * factor, grid.ny * factor
    return f"--grid {nx}x{ny} sees it" if nx <= 8192 and ny <= 4096 else "so does every grid up to 8192 x 4096: filter the map"


def _middle(heights):
    """The middle of a large map."""
    cut = [max(0, (n - JUDGED) // 2) for n in heights.shape]
    return heights[cut[0]:heights.shape[0] - cut[0], cut[1]:heights.shape[1] - cut[1]]


def _rim(f, scene):
    used = f.used
    step = max(float(np.abs(edge).max()) for edge in (used[0], used[-1], used[:, 0], used[:, -1]))
    formed = f.level != "form" and f.form.dominant  # the step is the form's, of which _form tells
    if f.taper == 0 and step > RIM * f.measures.rms and not formed:
        yield f"{_name(f)} ends in a step of up to {_um(step)} um at its rim; feature.taper (m) lets it fade out"
