"""What a measured height map is and whether unit, pixel and grid suit it: lines printed before a run, and doubts."""

import functools
import os

import numpy as np

from tehl_taichi.scene import height_map, map_filter
from tehl_taichi.scene.height_map import LEVELS, Measures, missed
from tehl_taichi.scene.map_form import FLAT
from tehl_taichi.scene.passing import MULTIPLES
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
    cutoff = functools.cache(lambda: _cutoff(f, scene))  # wanted up to twice; to look for it, the map is filtered several times
    return [*_holes(f), *form(f), *_across(f, scene), *_size(f, cutoff), *_grid(f, scene, cutoff), *_rim(f)]


def lines(f, scene):
    """Two lines: what was read, and what passes through the contact."""
    steps = _points_in_a_cell(f, scene)
    (along, across), m, name = f.points, f.measures, f"map {os.path.basename(f.file)}"
    heights = f"heights in {f.unit}" + (f" times {f.scale:g}" if f.scale != 1 else "")
    turned = f"{f.orientation.says}, " if f.orientation.says else ""
    off = f"{LEVELS[f.level]} taken off" + (f" ({f.form.says})" if f.level == "form" else "")
    skipped = f"{found}, " if (found := height_map.skipped(f.sha256)) else ""
    yield (f"{name}: {skipped}{along} x {across} points {_apart(f)} um apart, {_um(f.patch[0])} x {_um(f.patch[1])} um of them "
           f"used, {turned}{heights}, {off}{_filter(f)}")
    yield (f"{name}: {_um(m.low)} to {_um(m.high)} um (range {_um(m.range)} um), rms {_um(m.rms)} um, largest slope "
           f"{m.slope:.2g} deg; a cell of the grid has {steps[0]:.3g} x {steps[1]:.3g} points")


def _filter(f):
    return f", low-pass with a cutoff of {_um(f.cutoff)} um (Gaussian)" if f.cutoff else ""


def _apart(f):
    """Distances of its points, in um: one number where they are one."""
    return " x ".join(dict.fromkeys(map(_um, f.steps)))


def _um(value):
    return f"{value * 1e6:.4g}"


def _holes(f):
    holes = f.inside(f.holes)  # what is cut off does not pass
    if holes.any():
        cut = " used" if holes.size < f.heights.size else ""
        yield (f"{_name(f)}: {holes.sum()} of its {holes.size}{cut} points were not measured; they are filled smoothly from "
               "their neighbours, so nothing that passes there is known")


def form(f):
    """Sentences about a map that is mostly the form of a body."""
    found = f.form
    if not found.dominant:
        return
    turned = "" if found.convex else f". {TURNED}"
    if f.level != "form":
        yield (f"{_name(f)}: all but {_um(found.left)} um of its rms of {_um(found.flat)} um are one curvature, {found.says}. "
               f"If it is that of the body, whose radius the scene has already, feature.level = 'form' takes it off{turned}")
    elif turned:
        yield f"{_name(f)}: the form taken off is {found.says}{turned}"


def _across(f, scene):
    """A form that is not that of the bodies: those of a line contact are curved along x alone."""
    if scene.contact.kind == "line" and f.form.dominant and f.form.axis == "y":
        yield (f"{_name(f)}: its form is {f.form.says}, across the rolling direction, but the bodies of a line contact are "
               f"curved along x alone; does the scan lie across? feature.transpose = {str(not f.transpose).lower()} turns it")


def _size(f, cutoff):
    m, told = f.measures, f"{_name(f)}: heights in {f.unit}"
    helps = f", or roughness? {found}" if m.slope > STEEP and (found := cutoff()) else "?"
    if m.rms < FLAT:
        yield f"{told} have an rms of {m.rms * 1e9:.2g} nm, nothing to a film; is feature.unit = {f.unit!r} right?"
    if m.slope > STEEP:
        yield (f"{told} have slopes up to {m.slope:.3g} deg; the film equation takes slopes for small (below {STEEP:g} deg): "
               f"spikes of the measurement{helps}")


def _name(f):
    return f"feature.file = {os.path.basename(f.file)!r}"


def _grid(f, scene, cutoff):
    steps, heights = _points_in_a_cell(f, scene), _middle(f.used)
    lost, own = missed(heights, *steps), missed(heights, 2, 2)
    if lost > SHARE:
        yield (f"{_name(f)}: the grid misses {lost:.0%} of the map's rms ({_finer(heights, steps, scene.grid)}"
               f"{f'; {found}' if (found := cutoff()) else ''})")
    if min(steps) < 1 and own > SHARE:
        yield (f"{_name(f)}: points {_apart(f)} um apart are {1 / min(steps):.2g} cells and do not resolve their own "
               f"roughness ({own:.0%} of the rms changes without every second one); heights are taken as linear between them")


def _points_in_a_cell(f, scene):
    """[along x, along y] of the map; they need not be whole."""
    return [size / step for size, step in zip(Scales.of(scene).cell(scene.grid), f.steps)]


def carried(scene):
    """Whether the grid sees every map of the scene."""
    return all(missed(_middle(f.used), *_points_in_a_cell(f, scene)) <= SHARE for f in scene.features if f.kind.measured)


def _cutoff(f, scene):
    """The first cutoff of some cells with which the doubts about grid and slopes are gone, in words; "" where there is none."""
    size, (least, most) = max(Scales.of(scene).cell(scene.grid)), map_filter.limits(f)
    for count in CUTOFFS:
        cutoff = float(f"{count * size:.1e}")
        if max(least, f.cutoff) < cutoff < most and _taken(f, scene, cutoff):
            return f"feature.cutoff = {cutoff:g} (m, {count} cells) filters what is finer"
    return ""


def _taken(f, scene, cutoff):
    """Whether the map with this cutoff (m) is long and flat enough for the grid."""
    heights = _middle(f.inside(f.filtered(cutoff)))
    return missed(heights, *_points_in_a_cell(f, scene)) <= SHARE and Measures.of(heights, f.steps).slope <= STEEP


def _finer(heights, steps, grid):
    """The grid that would see it, in words."""
    factor = 2
    while missed(heights, steps[0] / factor, steps[1] / factor) > SHARE:  # ends at the map's own points
        factor *= 2
    (nx, ny), most = (grid.nx * factor, grid.ny * factor), [cells for _, cells in MULTIPLES.values()]
    return (f"--grid {nx}x{ny} sees it" if nx <= most[0] and ny <= most[1] else
            f"so does every grid up to {most[0]} x {most[1]}: filter the map")


def _middle(heights):
    """The middle of a large map."""
    cut = [max(0, (n - JUDGED) // 2) for n in heights.shape]
    return heights[cut[0]:heights.shape[0] - cut[0], cut[1]:heights.shape[1] - cut[1]]


def _rim(f):
    used = f.used
    step = max(float(np.abs(edge).max()) for edge in (used[0], used[-1], used[:, 0], used[:, -1]))
    formed = f.level != "form" and f.form.dominant  # the step is the form's, of which _form tells
    if f.taper == 0 and step > RIM * f.measures.rms and not formed:
        yield f"{_name(f)} ends in a step of up to {_um(step)} um at its rim; feature.taper (m) lets it fade out"
