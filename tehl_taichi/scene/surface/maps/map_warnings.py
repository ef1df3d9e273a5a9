"""Description of a measured height map, and warnings about its unit, pixel and grid."""

import os

import numpy as np

from tehl_taichi.scene.resolution import MULTIPLES
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.surface.maps import height_map, stated_keys
from tehl_taichi.scene.surface.maps.cutoff_choice import (
    SHARE,
    STEEP,
    SURELY,
    contact_pressure,
    middle,
    points_in_a_cell,
    suitable_cutoff,
    yields,
)
from tehl_taichi.scene.surface.maps.form import FLAT
from tehl_taichi.scene.surface.maps.height_map import LEVELS, ROWS, error_on_grid
from tehl_taichi.scene.yield_stress import STEEL
from tehl_taichi.values.coded_text import Option, grid_option
from tehl_taichi.values.coded_warning import with_data
from tehl_taichi.values.digits import number_of

TURNED = "Heights point out of the metal and most bodies are convex; if the map is upside down, set feature.scale = "
LEFT = 0.5  # of the rms that a taper ought to leave
RIM = 0.1  # of the rms: a step at the rim below that is roughness like the rest


def doubts(f, scene):
    """Warnings about a map: falling coordinates, holes, spikes, the form of its body, flat or rough heights, points finer or
    coarser than the grid, an end with a step, a wide taper.
    """
    return [*_falling(f), *_holes(f), *_spikes(f), *_row_offsets(f), *form(f), *_across(f, scene), *_size(f), *_rough(f, scene),
            *_grid(f, scene), *_rim(f), *_faded(f)]


def lines(f, scene):
    """Two lines: the heights as read, and the heights that pass through the contact."""
    steps = points_in_a_cell(f, scene)
    m, name = f.measures, f"{f.shape} {os.path.basename(f.file)}".strip()
    unit_said, steps_said = stated_keys.words(f)
    heights = f"heights in {f.unit}{unit_said}" + (f" times {f.scale:g}" if f.scale != 1 else "")
    turned = f"{lay}, " if (lay := f.kind.lies(f)) else ""
    off = f"{LEVELS[f.level]} removed{form_taken(f, scene)}"
    skipped = f"{found}, " if (found := height_map.facts(f).skipped) else ""
    yield (f"{name}: {skipped}{f.kind.points_words(f)} {_apart(f)} um apart{steps_said}, {_patch(f)} of them used{_offset(f)}"
           f"{_taper(f)}, {turned}{heights}, {off}{_filter(f)}")
    cells = " x ".join(f"{count:.3g}" for count, many in zip(steps, f.points) if many > 1)
    yield (f"{name}: {_um(m.low)} to {_um(m.high)} um (range {_um(m.range)} um), rms {_um(m.rms)} um, largest slope "
           f"{m.slope:.2g} deg; a cell of the grid has {cells} points")


def _patch(f):
    """Text of the size of the used patch along the axes on which it has points."""
    return " x ".join(_um(size) for size, count in zip(f.patch, f.points) if count > 1) + " um"


def _offset(f):
    """Text of the position of the used part in the scan."""
    each = zip("xy", (f.offset_x, f.offset_y), f.points)
    moved = [f"{axis} = {_um(offset)} um" for axis, offset, count in each if offset and count > 1]
    return f" around {', '.join(moved)}" if moved else ""


def _filter(f):
    return f", low-pass with a cutoff of {_um(f.cutoff)} um (Gaussian)" if f.cutoff else ""


def _taper(f):
    return f", fading out over {_um(f.taper)} um at the rim" if f.taper else ""


def _apart(f):
    """Text of the distances of its points in um: one number if they are equal."""
    return " x ".join(dict.fromkeys(_um(step) for step, count in zip(f.steps, f.points) if count > 1))


def _um(value):
    return f"{value * 1e6:.4g}"


def _falling(f):
    """Warnings about coordinates of the file that fall along an axis on which its heights are not reversed."""
    for axis, falls in zip("xy", f.orientation.swapped(height_map.facts(f).falling)):
        if falls and not getattr(f, f"mirror_{axis}"):
            yield (f"{_name(f)}: its coordinates fall along {axis}, and its heights keep the order of the file; if {axis} of "
                   f"the scan is to be {axis} of the contact, set feature.mirror_{axis} = true")


def _holes(f):
    holes = f.holes & ~f.spikes
    if holes.any():
        cut = " used" if holes.size < f.heights.size else ""
        yield (f"{_name(f)}: {holes.sum()} of its {holes.size}{cut} points were not measured and are filled smoothly from "
               "their neighbours; results there are not reliable")


def _spikes(f):
    """Warning with the number of spikes, and the position of the largest."""
    if count := int(f.spikes.sum()):
        away = np.where(f.spikes, np.abs(f.part - f.raw), 0.0)
        largest = np.unravel_index(int(away.argmax()), away.shape)
        many = number_of(count, "point is a spike", "points are spikes")
        text = (f"{_name(f)}: {many} of the measurement and filled from the neighbours like points that were not measured; the "
                f"largest, {_um(away.max())} um, is at {f.place_in_file(*largest)}")
        yield with_data(text, spikes=count, largest_m=float(away.max()))


def _row_offsets(f):
    found = f.row_offsets if f.level != ROWS else None
    if found:
        which = f"at {number_of(found.rows, 'place')} rows" if found.rows else "the rows"
        yield (f"{_name(f)}: {which} of the file are offset by about {_um(found.size)} um against the next one, more than "
               "roughness explains (a stitched scan, or one measured line by line); feature.level = 'rows' removes the median "
               "of each row, and with it marks along the rows")


def form(f):
    """Sentences about a map that is mostly the form of a body."""
    found = f.form
    if not found.dominant:
        return
    turned = "" if found.convex else f". {TURNED}{-f.scale:g}"
    if f.level != "form":
        yield (f"{_name(f)}: all but {_um(found.left)} um of its rms of {_um(found.flat)} um are one curvature, {found.says}. "
               "If this is the curvature of the body, which the scene already has, set feature.level = 'form' to remove "
               f"it{turned}")
    elif turned:
        yield f"{_name(f)}: the removed form is {found.says}{turned}"


def form_taken(f, scene):
    """Text ' (convex with a radius of ...)' of a removed form; "" if only a plane was removed."""
    return f" ({f.form.says}{_mate(f, scene)})" if f.level == "form" else ""


def _mate(f, scene):
    """Text with the radius of the other body, if the form is that of the scanned one; it shows whether radii and scan belong
    together.
    """
    if not f.form.dominant or not f.form.convex or f.form.axis != "x":
        return ""
    other = 1 / scene.contact.radius_x - f.form.bent
    radius = f"radius of {1e3 / abs(other):.3g} mm" if other else "plane"
    return (f"; with contact.radius_x = {scene.contact.radius_x * 1e3:.4g} mm the other body has a"
            f"{'' if other >= 0 else ' concave'} {radius}")


def _across(f, scene):
    """Warning about a form that differs from that of the bodies, which are curved only along x in a line contact."""
    if scene.contact.kind == "line" and f.form.dominant and f.form.axis == "y":
        yield (f"{_name(f)}: its form is {f.form.says}, across the rolling direction, but the bodies of a line contact are "
               f"curved along x only. If the scan lies across, set {f.kind.other_lay(f)}")


def _size(f):
    m = f.measures
    if m.rms < FLAT:
        yield (f"{_name(f)}: heights in {f.unit} have an rms of {m.rms * 1e9:.2g} nm, far below the film thickness; check "
               f"feature.unit = {f.unit!r}")


def _rough(f, scene):
    """One sentence about slopes too large for the film equation and heights too large for steel: one cutoff helps against
    both.
    """
    why = [*_steep(f), *_hard(f, scene)]
    if why:
        helps = f", or roughness? {found}" if (found := _cutoff(f, scene)) else "?"
        yield f"{_name(f)}: heights in {f.unit} {', and '.join(why)}: spikes of the measurement{helps}"


def _steep(f):
    if (slope := f.measures.slope) > STEEP:
        yield f"have slopes up to {slope:.3g} deg; the film equation assumes slopes below {STEEP:g} deg"


def _hard(f, scene):
    if yields(heights := middle(f.used), f, scene, SURELY):
        yield f"need about {contact_pressure(heights, f, scene) / 1e9:.2g} GPa to be flattened in this contact; {STEEL}"


def _name(f):
    return f"feature.file = {os.path.basename(f.file)!r}" if f.file else height_map.named(f)


def _grid(f, scene):
    steps, heights = points_in_a_cell(f, scene), middle(f.used)
    lost, own = error_on_grid(heights, *steps), error_on_grid(heights, *(2 if step < 1 else 1 for step in steps))
    if lost > SHARE:
        remedy, cutoff = _finer(heights, steps, scene), _cutoff(f, scene)
        yield with_data(f"{_name(f)}: on this grid the {f.shape} is off by {lost:.0%} of its rms "
                        f"({remedy}{f'; {cutoff}' * bool(cutoff)})", remedy, lost=float(lost))
    if min(steps) < 1 and own > SHARE:
        yield (f"{_name(f)}: points {_apart(f)} um apart are {1 / min(steps):.2g} cells and do not resolve the roughness "
               f"(without every second point it is off by {own:.0%} of its rms); heights are interpolated linearly")


def resolves_maps(scene):
    """Whether the grid resolves every map of the scene."""
    return all(error_on_grid(middle(f.used), *points_in_a_cell(f, scene)) <= SHARE for f in scene.features if f.kind.measured)


def _cutoff(f, scene):
    """Text of the cutoff that removes the warnings about grid, slopes and pressure; "" without one."""
    if not (cutoff := suitable_cutoff(f, scene)):
        return ""
    cells, left = cutoff / max(Scales.of(scene).cell(scene.grid)), np.ptp(f.passing(cutoff))
    return (f"feature.cutoff = {cutoff:g} (m; {_um(cutoff)} um, {cells:.2g} cells) removes finer waves and reduces the range "
            f"from {_um(f.measures.range)} to {_um(left)} um")


def _finer(heights, steps, scene):
    """Option of the grid that would resolve the map."""
    factor = 2
    while error_on_grid(heights, steps[0] / factor, steps[1] / factor) > SHARE:  # ends at the map's own points
        factor *= 2
    (nx, ny), most = (scene.grid.nx * factor, scene.grid.ny * factor), [cells for _, cells in MULTIPLES.values()]
    if nx <= most[0] and ny <= most[1]:
        grid = grid_option(scene, nx, ny)
        return Option(f"{grid} resolves it", f"{grid.words} resolves it")
    return f"and on every grid up to {most[0]} x {most[1]}; filter the map"


def _rim(f):
    step = max(float(np.abs(edge).max()) for edge in _edges(f))
    formed = f.level != "form" and f.form.dominant  # the step belongs to the form, which _form reports
    if f.taper == 0 and step > RIM * f.measures.rms and not formed:
        yield f"{_name(f)} ends in a step of up to {_um(step)} um at its rim; set feature.taper (m) to fade it out"


def _edges(f):
    """Heights along the rim of the patch, where it ends: an endless profile has a rim along x only."""
    sides = zip(f.patch, (f.used.T, f.used))
    return [rows[end] for size, rows in sides if np.isfinite(size) for end in (0, -1)]


def _faded(f):
    whole = f.unfaded.rms
    if f.taper and f.measures.rms < LEFT * whole:
        yield (f"{_name(f)}: feature.taper = {f.taper:g} m leaves {f.measures.rms / whole:.0%} of the rms of its patch, "
               f"{_um(f.patch[0])} x {_um(f.patch[1])} um")
