"""Pictures of an animation: pressure, film and temperatures along the centreline and a map, on fixed axes."""

from typing import Any

import numpy as np

from tehl_taichi.view.figures import palette
from tehl_taichi.view.figures.line_figures import ALONG, SURFACES
from tehl_taichi.view.figures.map_panels import mirrored
from tehl_taichi.view.figures.zoom_lines import THICK
from tehl_taichi.view.zoom_window import ZoomWindow

# maps: field, factor, label, colours
SHOWN = {"film": ("film", 1e6, "film (µm)", palette.FILM), "pressure": ("pressure", 1e-9, "pressure (GPa)", palette.PRESSURE),
         "temperature": ("temperature_mid", 1.0, "mid-film (°C)", palette.TEMPERATURE)}
# panels of lines: label, factor, {field: (kind of line, label)}
PANELS: dict[str, Any] = {
    "pressure": ("pressure (GPa)", 1e-9, {"pressure": ("-", None)}), "film": ("film (µm)", 1e6, {"film": ("-", None)}),
    "temperature": ("temperature (°C)", 1.0, {name: (style, text) for name, text, style in SURFACES})}
TALL = 0.9   # height over width of a map that stands beside the lines
OVER = 1.05  # of the largest value: upper end of an axis


class Frames:
    """Frames of the entries of a run; :meth:`picture` draws one.

    page: a :class:`FigureStyle`; moments: of the run; entries: all entries to draw, which set the range of the axes; shown: a
    key of SHOWN, or None for no map.
    """

    def __init__(self, page, moments, entries, shown):
        self.page, self.moments, self.store, self.entries, self.shown = page, moments, moments.store, entries, shown
        cold, self.finer = self.store.scene.isothermal, ZoomWindow.all_of(self.store)
        self.panels = {name: panel for name, panel in PANELS.items() if not (cold and name == "temperature")}
        self.fields = [field for _, _, fields in self.panels.values() for field in fields]
        self.figure, self.axes = self._laid_out()
        self.low, self.top = self._limits()
        self.lines = [line for name in self.panels for line in self._lines(name)]
        self.places = [self.axes[name].axvline(0.0, color=palette.GREY, ls=":", animated=True) for name in self.panels]
        self.map = self._map() if shown else None
        self.windows = [FrameWindow(self, window) for window in self.finer]
        self._freeze()

    def _laid_out(self):
        """(figure, {name: axes}): the map below the lines, or beside them if it is tall."""
        from matplotlib.figure import Figure

        left, right = self.moments.window
        tall = np.ptp(mirrored(self.store.y, self.store.y[None])[0]) / self.moments.a / (right - left)
        beside, heights = self.shown and tall > TALL, [0.7 * self.page.row()] * len(self.panels)
        rows: list[Any] = [[name, "map"] if beside else [name] for name in self.panels]
        if self.shown and not beside:
            rows.append(["map"])
            heights.append(tall * (self.page.inches - 0.08 * self.page.text) + 0.11 * self.page.text)
        figure = Figure((self.page.inches, sum(heights) + 0.06 * self.page.text), self.page.dpi, layout="constrained")
        return figure, figure.subplot_mosaic(rows, height_ratios=heights)

    def _limits(self):
        """({field: smallest}, {field: largest}) of all entries; of the film inside the contact."""
        ends: dict[str, list[float]] = {name: [] for name in self.fields}
        for n in self.entries:
            finer = [window.fields(n, self.fields) for window in self.finer if n in window]
            for name, values in self.store.fields(n, self.fields).items():
                parts = [values, *(one[name] for one in finer if name in one)]
                ends[name] += [float(of(part)) for part in parts for of in (np.min, np.max)]
        top = {name: max(values) for name, values in ends.items()} | {"film": self.moments.film_top(self.entries)}
        return {name: min(values) for name, values in ends.items()}, top

    def _lines(self, name):
        """Empty lines of a panel, as (line, field, factor)."""
        ax, (label, factor, fields) = self.axes[name], self.panels[name]
        colour = palette.LINES[list(PANELS).index(name)]
        lines = [(ax.plot([], [], style, color=colour, label=text, animated=True)[0], field, factor)
                 for field, (style, text) in fields.items()]
        low = min(self.low[field] for field in fields) if name == "temperature" else 0.0
        ax.set(ylabel=label, xlim=self.moments.window,
               ylim=(low * factor, low * factor + OVER * factor * (max(self.top[field] for field in fields) - low)))
        ax.grid()
        if len(fields) > 1:
            ax.legend(loc="upper left", fontsize="small")
        if name == list(self.panels)[-1]:
            ax.set_xlabel(ALONG if self.moments.half else f"{ALONG}, {self.moments.along}")
        return lines

    def _map(self):
        """(image, field, factor)."""
        field, factor, label, colours = SHOWN[self.shown]
        ax, x, y = self.axes["map"], self.moments.x, mirrored(self.store.y / self.moments.a, self.store.y[None])[0]
        dx, dy = (x[1] - x[0]) / 2, (y[1] - y[0]) / 2  # a value stands in the middle of its picture element
        image = ax.imshow(np.zeros((y.size, x.size)), origin="lower", interpolation="bilinear", cmap=colours, animated=True,
                          extent=(x[0] - dx, x[-1] + dx, y[0] - dy, y[-1] + dy),
                          vmin=self.low[field] * factor, vmax=self.top[field] * factor)
        ax.set(xlim=self.moments.window, ylim=(y[0], y[-1]), xlabel=ALONG, ylabel="y / a")
        self.figure.colorbar(image, ax=ax, location="bottom", label=label, aspect=40,
                             extend="max" if field == "film" else "neither")
        return image, field, factor

    def _freeze(self):
        """Draw the constant parts once, with space for the title."""
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        self.title = self.figure.suptitle(self._says(self.entries[-1]))
        self.canvas = FigureCanvasAgg(self.figure)
        self.canvas.draw()
        self.figure.set_layout_engine("none")
        self.title.set_animated(True)
        self.canvas.draw()
        self.still = self.canvas.copy_from_bbox(self.figure.bbox)

    def _says(self, n):
        return f"{self.moments.named}: {self.moments.says(n)}"

    def picture(self, n):
        """Picture of entry n as an array (rows, columns, 3) of bytes."""
        f = self.store.fields(n, self.fields)
        self.canvas.restore_region(self.still)
        for place in self.places:
            self._draw(place, xdata=[self.store.scalar("feature_x")[n] / self.moments.a] * 2)
        for line, field, factor in self.lines:
            self._draw(line, data=(self.moments.x, f[field][:, self.moments.line] * factor))
        if self.map:
            image, field, factor = self.map
            self._draw(image, data=mirrored(self.store.y, f[field] * factor)[1].T)
        for window in self.windows:
            window.draw(n)
        self.title.set_text(self._says(n))
        self.figure.draw_artist(self.title)
        return np.array(self.canvas.buffer_rgba())[..., :3]

    def _draw(self, artist, **changed):
        artist.set(**changed)
        artist.axes.draw_artist(artist)


class FrameWindow:
    """Zoom window of a run in its frames: thick lines over those of the run, a finer part of the map."""

    def __init__(self, frames, window):
        self.frames, self.window = frames, window
        self.row = window.row(frames.store.y[frames.moments.line])
        self.lines = [(self._like(line), field, factor) for line, field, factor in frames.lines if field in window.names]
        self.patch = self._patch() if frames.map and frames.map[1] in window.names else None

    def draw(self, n):
        """Draw entry n of the run, if it has a window."""
        if n not in self.window:
            return
        x, found = self.window.columns(n) / self.frames.moments.a, self.window.fields(n, self.frames.fields)
        for line, field, factor in self.lines if self.row is not None else []:
            self.frames._draw(line, data=(x, found[field][:, self.row] * factor))
        if self.patch:
            _, field, factor = self.frames.map
            y, values = mirrored(self.window.y / self.frames.moments.a, found[field] * factor)
            self.frames._draw(self.patch, data=values.T, extent=(x[0], x[-1], y[0], y[-1]))
            self._restore_ends()

    def _like(self, line):
        return line.axes.plot([], [], line.get_linestyle(), color=line.get_color(), lw=THICK, animated=True)[0]

    def _patch(self):
        image, ax = self.frames.map[0], self.frames.axes["map"]
        self.ends = ax.get_xlim(), ax.get_ylim()
        patch = ax.imshow(np.zeros((2, 2)), origin="lower", interpolation="bilinear", cmap=image.get_cmap(), animated=True,
                          norm=image.norm)
        self._restore_ends()
        return patch

    def _restore_ends(self):
        self.frames.axes["map"].set(xlim=self.ends[0], ylim=self.ends[1])
