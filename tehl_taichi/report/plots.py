"""Figures for plotly.js: plain dictionaries of traces and layout. The browser adds the colours of the page."""

from dataclasses import dataclass, field

from tehl_taichi.view.figures.palette import BLACK, LIMIT, LINES, RIM

PANEL, AROUND = 165, 110  # px: height of a panel of lines; of legend, title and axis around them


@dataclass(frozen=True)
class Figure:
    """name: on the page; caption: a sentence or two; traces, layout: of plotly; height: px; more: data for scripts."""

    name: str
    caption: str
    traces: list
    layout: dict
    height: int
    more: dict = field(default_factory=dict)

    @property
    def spec(self):
        return {"data": self.traces, "layout": self.layout, **self.more}


def axis(title, **more):
    """Axis with its title, which contains the unit; plotly's prefixes, as in 150µ, are off."""
    return {"title": {"text": title, "standoff": 6}, "exponentformat": "power", **more}


def line(x, y, name, colour, panel=1, dash="solid", in_legend=True, **more):
    """Line in one of the panels; in_legend: it has an entry in the legend."""
    return {"type": "scatter", "mode": "lines", "x": x, "y": y, "name": name, "showlegend": in_legend, "legendgroup": name,
            "line": {"color": colour, "dash": dash, "width": 1.8}, **_in(panel), **more}


def marks(x, y, name, colour, panel=1, symbol="cross-thin", **more):
    """Single points."""
    return {"type": "scatter", "mode": "markers", "x": x, "y": y, "name": name, "showlegend": True,
            "marker": {"symbol": symbol, "size": 13, "color": colour, "line": {"width": 3, "color": colour}}, **_in(panel),
            **more}


def rings(x, y, name, colour):
    """Open circles around points of lines."""
    found = marks(x, y, name, colour, symbol="circle-open")
    found["marker"] |= {"size": 9, "line": {"width": 1.5, "color": colour}}
    return found


def _in(panel):
    return {} if panel == 1 else {"yaxis": f"y{panel}"}


def stack(name, caption, x_title, panels, x=None, more=None, height=0):
    """Panels of lines below each other over one x; None without panels.

    panels: (title of y, traces with the number of their panel, keys of its axis); x: keys of the common axis; height: px, if
    not the usual one.
    """
    if not panels:
        return None
    traces = [trace for _, found, _ in panels for trace in found]
    legend = any(trace["showlegend"] for trace in traces)
    rows, layout = len(panels), {"xaxis": axis(x_title, **(x or {})), **_frame(legend)}
    gap = 0.06
    size = (1 - gap * (rows - 1)) / rows
    for n, (title, _, keys) in enumerate(panels):
        top = 1 - n * (size + gap)
        layout[f"yaxis{n + 1 if n else ''}"] = axis(title, domain=[max(top - size, 0.0), top], **keys)
    layout["xaxis"]["anchor"] = f"y{rows}" if rows > 1 else "y"
    return Figure(name, caption, traces, layout, height or PANEL * rows + AROUND, more or {})


def _frame(legend=True):
    """Margins around a plot, and the legend above it."""
    return {"margin": {"l": 10, "r": 14, "t": 40 if legend else 8, "b": 10}, "hovermode": "closest",
            "legend": {"orientation": "h", "x": 0, "y": 1.01, "yanchor": "bottom"}}


def colours(scale):
    """Colours of a map by its name in the palette; plotly.js does not know all maps."""
    from plotly.colors import get_colorscale

    return get_colorscale(scale)


def field_map(name, caption, x, y, values, scale, unit, x_title, y_title, marked=(), true=True, height=330, **keys):
    """Map of a field (x, y); marked: traces on it; true: equal scales along both axes; keys: of plotly's heatmap."""
    heat = {"type": "heatmap", "x": x, "y": y, "z": values.T, "colorscale": colours(scale), "zsmooth": "best",
            "colorbar": {"title": {"text": unit, "side": "top"}, "orientation": "h", "thickness": 12, "y": -0.22,
                         "yanchor": "top", "lenmode": "fraction", "len": 0.9, "exponentformat": "power"}, **keys}
    frame = _frame(any(trace.get("showlegend") for trace in marked))
    layout = {"xaxis": axis(x_title, constrain="domain"), "yaxis": axis(y_title, constrain="domain"), **frame}
    if true:
        layout["yaxis"]["scaleanchor"] = "x"
    return Figure(name, caption, [heat, *marked], layout, height)


def level(x, y, values, at):
    """Line values (x, y) = at on a map: white with a black rim, visible on every colour. Without a legend entry, because the
    page is white, too.
    """
    common = {"type": "contour", "x": x, "y": y, "z": values.T, "showscale": False, "showlegend": False, "hoverinfo": "skip",
              "contours": {"start": at, "end": at, "size": 1, "coloring": "none"}}
    return [{**common, "line": {"color": hue, "width": width}} for hue, width in ((RIM, 4.0), (LIMIT, 1.6))]


def colour(n):
    """The n-th line colour visible on light and dark pages (not black)."""
    seen = [one for one in LINES if one != BLACK]
    return seen[n % len(seen)]
