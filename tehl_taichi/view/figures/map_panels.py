"""Panels of maps over x, y: below each other, side by side if they are tall, or turned for a wide ellipse.

An ellipse that is wide across the flow has its long axis to the right; panels below show its middle.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures.line_figures import ALONG

LEAST, LEAST_TALL = 5.0, 3.4  # cm that a map needs to stand beside another
TALL = 0.9                    # height over width, beyond it the second
THIN = 20                     # length over thickness of a colour bar, for each map
WIDE = 1.5                    # half-axis across over that along, beyond which an ellipse lies
EDGE, MIDDLE = 1.25, 1.5      # b, a: shown of a lying ellipse along y, all of it and its middle
BESIDE = 0.85                 # share of the width that panels have beside their labels and colour bars
DOWN = "x / a (flow downwards)"


def mirrored(y, values):
    """y and values (x, y) with the mirror image of a half domain."""
    if y[0] < 0:
        return y, values
    return np.concatenate([-y[:0:-1], y]), np.hstack([values[:, :0:-1], values])


def shade(ax, x, y, values, **style):
    """Draw values (x, y) in colours, as a bitmap also in vector files."""
    return ax.pcolormesh(x, y, values.T, shading="gouraud", rasterized=True, **style)


def bar(figure, image, axes, label, beside=False):
    """Add a colour bar with an arrow at each end where colours are cut; beside: below maps that are side by side."""
    low, top = image.get_clim()
    values = image.get_array()
    cut = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[int(values.min() < low), int(values.max() > top)]
    return figure.colorbar(image, ax=axes, label=label, extend=cut, location="bottom" if beside else "right",
                           aspect=THIN * np.size(axes))


def is_turned(scene):
    """Whether maps of this scene are turned."""
    s = Scales.of(scene)
    return scene.contact.kind == "elliptic" and s.b > WIDE * s.a


def half_axis(scene):
    """Text after y / a: length of the half-axis b of an ellipse."""
    s = Scales.of(scene)
    return f" (b = {s.b / s.a:.3g} a)" if scene.contact.kind == "elliptic" else ""


def panels(page, moments, count):
    """The :class:`Panels` for `count` maps of a moment."""
    return _on_its_side(page, moments, count) if is_turned(moments.store.scene) else _upright(page, moments, count)


@dataclass(frozen=True)
class Panels:
    """figure; axes: one per field; beside: they are side by side; middles: axes of the middle of a turned ellipse, or none."""

    figure: Any
    moments: Any
    axes: Any
    beside: bool = False
    middles: tuple = ()

    def draw(self, n, values, title, **style):
        """Draw field n with its mirror image; returns the object for a colour bar."""
        if not self.middles:
            return draw_map(self.axes[n], self.moments, values, title, **style)
        image = _draw_lying(self.axes[n], self.moments, values, EDGE * _b(self.moments), **style)
        low, top = image.get_clim()
        _draw_lying(self.middles[n], self.moments, values, MIDDLE, **{**style, "vmin": low, "vmax": top})
        self.axes[n].set_title(title)
        self.middles[n].set_title(f"{title}, middle")
        return image

    def bar(self, image, which, label):
        """Add a colour bar for the fields `which` (a slice)."""
        bar(self.figure, image, list(self.axes[which]), label, self.beside)


def _upright(page, moments, count):
    left, right = moments.window
    tall = np.ptp(mirrored(moments.store.y, moments.store.y[None])[0]) / moments.a / (right - left)
    beside = page.width / count >= (LEAST_TALL if tall > TALL else LEAST)
    rows, columns = (1, count) if beside else (count, 1)
    room = (tall * page.inches / columns + 0.1 * page.text) * rows + 0.1 * page.text  # more than enough
    figure, axes = page.figure(rows, columns, room, equal=True, sharex=True, sharey=True)
    for ax in axes[-1]:
        ax.set_xlabel(ALONG)
    for ax in axes[:, 0]:
        ax.set_ylabel(f"y / a{half_axis(moments.store.scene)}")
    return Panels(figure, moments, axes.ravel(), beside)


def _on_its_side(page, moments, count):
    """Panels with the whole ellipses below each other, and a row with the middle of each."""
    left, right = moments.window
    whole, middle = [f"whole {n}" for n in range(count)], [f"middle {n}" for n in range(count)]
    flat = BESIDE * page.inches * (right - left) / (2 * EDGE * _b(moments))
    square = BESIDE**2 * page.inches / count * (right - left) / (2 * MIDDLE)
    height = count * flat + square + (2 * count + 6) * 1.5 * page.text / 72
    figure, axes = page.mosaic([*([name] * count for name in whole), middle], height, height_ratios=[flat] * count + [square])
    for name in whole[:-1]:
        axes[name].tick_params(labelbottom=False)
    for name in middle[1:]:
        axes[name].tick_params(labelleft=False)
    axes[whole[-1]].set_xlabel(f"y / a{half_axis(moments.store.scene)}")
    axes[middle[count // 2]].set_xlabel("y / a")
    axes[middle[0]].set_ylabel(DOWN)
    axes[whole[count // 2]].set_ylabel("x / a")
    return Panels(figure, moments, np.array([axes[name] for name in whole]), False, tuple(axes[name] for name in middle))


def _b(moments):
    """Half-axis across, in a."""
    s = Scales.of(moments.store.scene)
    return s.b / s.a


def draw_map(ax, moments, values, title, **style):
    """Draw one field over x, y with its mirror image; returns the object for a colour bar."""
    left, right = moments.window
    seen = _seen(moments, left, right)
    y, full = mirrored(moments.store.y / moments.a, values[seen])
    ax.set(aspect="equal", xlim=(left, right), title=title)
    return shade(ax, moments.x[seen], y, full, **style)


def _seen(moments, left, right):
    step = moments.x[1] - moments.x[0]
    return (moments.x > left - step) & (moments.x < right + step)


def _draw_lying(ax, moments, values, side, **style):
    """Draw a field with y to the right up to `side` (a) and x downwards: as seen from above."""
    left, right = moments.window
    seen = _seen(moments, left, right)
    y, full = mirrored(moments.store.y / moments.a, values[seen])
    side = min(side, y[-1])
    near = np.abs(y) <= side + (y[1] - y[0])
    ax.set(aspect="equal", xlim=(-side, side), ylim=(right, left))
    return shade(ax, y[near], moments.x[seen], full[:, near].T, **style)
