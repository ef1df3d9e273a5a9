"""Curves of pressure, film and temperature along the centreline in braille dots, for the terminal."""

import numpy as np

from tehl_taichi.values.arrays import nearest_index

ROWS, NARROWEST, LOWEST = 5, 24, 14  # letters: height of a plot, least width of one, least height of a terminal with plots
DOTS = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])  # of a braille letter: rows, columns (Unicode 28xx)
LOADED, BESIDE = 0.02, 0.3  # share of the largest pressure that is shown; share of that width shown on both sides
FILMS = 2.5  # central films up to which the film is drawn
SHOWN = (("pressure", "pressure", 1e-9, "GPa", "magenta"), ("film", "film", 1e6, "µm", "cyan"),
         ("temperature_mid", "mid-film", 1.0, "°C", "yellow"))  # field, title, factor, unit, colour


class Curves:
    """Newest snapshot along y = 0, on a whole domain through its largest pressure, with axes that only grow: x around the
    contact, p from 0, h to 2.5 central films, T.
    """

    def __init__(self):
        self.part, self.curves, self.feature, self.ends = None, {}, np.nan, {}

    def take(self, snapshot):
        """Store the drawn values of a snapshot."""
        row = shown_row(snapshot)
        if self.part is None:
            self.part = contact_slice(snapshot.fields["pressure"][:, row])
            self.x = snapshot.x[self.part]
        self.curves = {name: snapshot.fields[name][self.part, row] * factor for name, _, factor, _, _ in SHOWN
                       if name in snapshot.fields}
        self.feature = snapshot.feature_x
        for name, values in self.curves.items():
            self._widen(name, values, FILMS * snapshot.scalars["h_c_m"] * 1e6)

    def _widen(self, name, values, thick):
        """Extend the axis of a curve to include the values; thick: initial end of the film's axis, um."""
        if name == "film":
            self.ends.setdefault(name, (0.0, thick))
            return
        low, high = self.ends.get(name, (values.min(), values.max()))
        self.ends[name] = min(low, values.min()), max(high, values.max())

    def __rich_console__(self, console, options):
        """The plots side by side, as many as fit; nothing in a small terminal, or one without braille."""
        count = min(len(self.curves), options.max_width // NARROWEST)
        if count and console.height >= LOWEST and options.encoding.startswith("utf"):
            yield self._table(count, options.max_width // count - 2)

    def _table(self, count, width):
        from rich.table import Table
        from rich.text import Text

        table = Table.grid(padding=(0, 2, 0, 0))
        table.add_row(*(Text(self._plot(entry, width), entry[-1], no_wrap=True) for entry in SHOWN[:count]))
        return table

    def _plot(self, entry, width):
        name, title, _, unit, _ = entry
        low, high = self.ends[name]
        rows = braille(self.curves[name], width, ROWS, low, high)
        return "\n".join([f"{title} {low:.3g} to {high:.3g} {unit}", *rows, self._foot(width)])

    def _foot(self, width):
        """Axis of x with the feature on it, and its ends in mm."""
        axis, at = ["─"] * width, (self.feature - self.x[0]) / np.ptp(self.x)
        if 0 <= at <= 1:
            axis[min(int(at * width), width - 1)] = "▲"  # the letter in which the curves are drawn there
        left, right = (f"{end * 1e3:+.2f}" for end in self.x[[0, -1]])
        return "".join(axis) + f"\n{left}{'x, mm':^{width - len(left) - len(right)}}{right}"


class CurvesBar:
    """Curves above a progress bar on stderr. Only :meth:`show` draws them, so no thread is needed.

    of: what is counted; the remaining time is shown only for steps, which take about equal times.
    """

    def __init__(self, curves, total, done, of="step"):
        from rich.console import Console, Group
        from rich.live import Live
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

        clock = TimeRemainingColumn() if of == "step" else TimeElapsedColumn()
        self.steps = Progress(TextColumn(of), MofNCompleteColumn(), BarColumn(), clock, TextColumn("{task.description}"),
                              auto_refresh=False)
        self.task = self.steps.add_task("", total=total, completed=done)
        self.live = Live(Group(curves, self.steps), console=Console(stderr=True), auto_refresh=False)
        self.start, self.stop = self.live.start, self.live.stop

    def show(self, step, text=""):
        """Draw with `step` parts done."""
        self.steps.update(self.task, completed=step, description=text)
        self.live.refresh()


def shown_row(snapshot):
    """Row along which a snapshot is drawn."""
    if snapshot.y[0] < 0:
        return int(np.argmax(snapshot.fields["pressure"].max(axis=0)))
    return nearest_index(snapshot.y, 0.0)


def contact_slice(p):
    """Slice of the contact and its surroundings; p: pressure along the centreline."""
    loaded = np.flatnonzero(p >= LOADED * p.max())
    more = int(BESIDE * (loaded[-1] - loaded[0])) + 1
    return slice(max(0, loaded[0] - more), loaded[-1] + more + 1)


def braille(values, width, rows, low, high):
    """`rows` lines of `width` letters with the values over their index, from low at the bottom to high at the top; values
    beyond are not drawn.

    Every value counts: a column of dots spans the smallest to the largest of its values.
    """
    levels, edges = 4 * rows, np.linspace(0, values.size - 1, 2 * width + 1)
    places = np.union1d(np.arange(values.size), edges)
    fine, at = np.interp(places, np.arange(values.size), values), np.searchsorted(places, edges)
    parts = (most(most.reduceat(fine, at[:-1]), fine[at[1:]]) for most in (np.minimum, np.maximum))
    bottom, top = (np.round((part - low) / max(high - low, 1e-300) * (levels - 1)) for part in parts)
    level = np.arange(levels)[::-1, None]
    lit = (level >= bottom) & (level <= top)
    letters = (lit.reshape(rows, 4, width, 2) * DOTS[None, :, None, :]).sum(axis=(1, 3))
    return ["".join(map(chr, line)) for line in 0x2800 + letters]
