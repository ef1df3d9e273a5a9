"""Figure style: file format, resolution and width; sizes of text and lines follow from the width."""

import contextlib
import os
import textwrap
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from tehl_taichi.disk import links, user_files
from tehl_taichi.disk.drafts import missing_above, remove_empty
from tehl_taichi.disk.files import reason, store_error
from tehl_taichi.errors import SceneError, StoreError, extra
from tehl_taichi.values.checks import choice, flag, integer
from tehl_taichi.values.escape import printable
from tehl_taichi.values.path_arguments import path_of
from tehl_taichi.values.units import amount
from tehl_taichi.view.figures import palette

FORMATS = ("png", "pdf", "svg")
DPI, WIDTH = 160, 17.0  # two columns of a journal; one is 8.5 cm
NARROW = 12.0           # cm: below it panels stand below each other
INCH = 2.54
DOTS = 16000            # across: more take minutes and gigabytes
SIZES = ((5.0, 8.5, 17.0, 60.0), (6.0, 7.0, 9.0, 32.0))  # widths, cm: text, points; wider than a page all grows alike
LETTER = 0.5            # of the text's size: mean width of a letter
ROWS, LINE = 4, 1.35    # of a legend: as many have room in a figure; height of another one, of the text's size
WIDEST = 0.55           # the same, of a line of a title with many wide ones
BESIDE, LEAST = 4.0, 8  # height of the title and the x label of a panel, of the text's size; letters in a line of its y label
SAID = {"png": {"Software": user_files.PROGRAM}, "pdf": {"Creator": user_files.PROGRAM, "CreationDate": None},
        "svg": {"Title": user_files.PROGRAM, "Date": None}}  # by which --force knows it; the same figure is the same file


@dataclass(frozen=True)
class FigureStyle:
    """Style of figures. Raises SceneError for impossible values.

    format: png, pdf or svg; dpi: dots per inch, also of the maps inside pdf and svg; width: cm; force: replace existing figures
    of ours.
    """

    format: str = "png"
    dpi: int = DPI
    width: float = WIDTH
    force: bool = False

    def __post_init__(self):
        choice("format", self.format, FORMATS)
        integer("dpi", self.dpi, 40, 1200)
        flag("force", self.force)
        object.__setattr__(self, "width", amount("width", self.width, "cm", 5.0, 60.0))
        if self.width / INCH * self.dpi > DOTS:
            raise SceneError(f"width = {self.width:g} cm with dpi = {self.dpi} gives {self.width / INCH * self.dpi:.0f} dots; "
                             f"allowed: at most {DOTS}")

    @property
    def inches(self):
        return self.width / INCH

    @property
    def text(self):
        """Size of the text, points."""
        return float(np.interp(self.width, *SIZES))

    @property
    def narrow(self):
        """Whether panels are placed below each other, not side by side as on a wide page."""
        return self.width < NARROW

    def row(self, columns=1):
        """Height (inches) of a row with `columns` panels of lines; narrower panels are less flat."""
        grown = max(self.width / WIDTH, 1.0)
        return 0.93 * grown * (self.inches / columns / grown) ** 0.5

    def figure(self, rows=1, columns=1, height=None, equal=False, **options):
        """(figure, axes as an array of rows). height: inches (default: for panels of lines); equal: panels have equal scales of
        x and y, and the height follows from them.
        """
        figure = self._empty(height or self.row(columns) * rows + 0.06 * self.text, equal)
        return figure, figure.subplots(rows, columns, squeeze=False, **options)

    def mosaic(self, rows, height, **options):
        """(figure, {name: axes}) of panels that may span several columns; rows: names, as for matplotlib; height: inches."""
        figure = self._empty(height, False)
        return figure, figure.subplot_mosaic(rows, **options)

    def _empty(self, height, equal):
        from matplotlib.figure import Figure

        figure: Any = Figure((self.inches, height), layout="compressed" if equal else "constrained")
        figure.to_fit = equal
        return figure

    def title(self, figure, text):
        """Set a title that is not wider than the page."""
        figure.suptitle(textwrap.fill(text, int(self.inches * 72 / (1.1 * WIDEST * self.text))))

    def legend(self, figure, handles=None, **options):
        """Add a legend of lines (default: of the first panel) below the panels, as wide as possible; a long one makes the
        figure higher.
        """
        handles = handles or figure.axes[0].get_legend_handles_labels()[0]
        for handle in handles:
            if handle.get_label().startswith("_"):  # which matplotlib would leave out
                handle.set_label(f" {handle.get_label()}")
        longest = max(len(handle.get_label()) for handle in handles) * LETTER + 4.5
        rows = -(-len(handles) // max(int(self.inches * 72 / (longest * self.text)), 1))
        figure.legend(handles=handles, loc="outside lower center", ncols=-(-len(handles) // rows), **options)
        figure.set_figheight(figure.get_figheight() + max(rows - ROWS, 0) * LINE * self.text / 72)

    def style(self):
        """Context manager in which figures are drawn and saved. Raises StoreError if matplotlib is not installed."""
        small, line = 0.9 * self.text, 0.14 * self.text
        return import_matplotlib().rc_context({
            "text.parse_math": False, "text.usetex": False,  # a name with $ in it is a name
            "font.size": self.text, "axes.titlesize": self.text, "axes.labelsize": self.text,
            "figure.titlesize": 1.1 * self.text,
            "legend.fontsize": small, "legend.frameon": False, "legend.title_fontsize": small, "xtick.labelsize": small,
            "ytick.labelsize": small, "lines.linewidth": line, "lines.markersize": 0.4 * self.text,
            "axes.linewidth": 0.5 * line, "xtick.major.width": 0.5 * line, "ytick.major.width": 0.5 * line,
            "grid.linewidth": 0.4 * line, "grid.color": palette.RULE, "axes.prop_cycle": _cycle(), "pdf.fonttype": 42,
            "svg.hashsalt": "tehl"})

    def write(self, folder, figures):
        """Write {name: function that draws the figure} into `folder`; returns the paths. Raises StoreError."""
        paths = self.check_all(folder, figures)
        with folder_of_figures(folder):
            return [self.save(draw, path) for draw, path in zip(figures.values(), paths)]

    def check_all(self, folder, names):
        """Paths of figures with these names in `folder`. Raises StoreError if they cannot be drawn or may not be written."""
        import_matplotlib()
        folder = path_of("folder", folder)
        links.refuse_itself(folder)
        check_folder(folder)
        paths = [folder / f"{name}.{self.format}" for name in names]
        for path in paths:
            self.check(path)
        return paths

    def check(self, path, of=None):
        """Raise StoreError if no figure may be written to `path`; of: see :func:`tehl_taichi.disk.user_files.check`."""
        user_files.check(path, self.force, self.format, of=of)

    def save(self, draw, path, of=None):
        """Write the figure of `draw()` to `path`, whose suffix sets the format; returns the path. Raises StoreError."""
        self.check(path, of)
        with self.style():
            figure = self._finished(draw)
            with user_files.made(path, self.force, kind=self.format, of=of) as draft:
                figure.savefig(draft, format=self.format, dpi=self.dpi, metadata=SAID[self.format])
        return path

    def drawn(self, draw):
        """Matplotlib Figure of `draw()` in this style. Raises StoreError without matplotlib."""
        with self.style():
            return self._finished(draw)

    def _finished(self, draw):
        return self.fitted(wrap_labels(spell_letters(draw())))

    def fitted(self, figure):
        """The figure without the empty height that panels with equal scales leave."""
        if getattr(figure, "to_fit", False):
            figure.get_layout_engine().execute(figure)
            figure.set_size_inches(self.inches, figure.get_tightbbox().height + 0.02 * self.text)
        return figure

    def of_file(self, path):
        """(page, path) that agree: format of the path's suffix, or suffix of the format. Raises SceneError."""
        path = path_of("path", path)
        if not path.suffix:
            return self, path.with_name(f"{path.name}.{self.format}")
        choice(f"format of {path}", path.suffix[1:].lower(), FORMATS)
        return replace(self, format=path.suffix[1:].lower()), path


def _cycle():
    from matplotlib.rcsetup import cycler

    return cycler(color=palette.LINES)


def import_matplotlib():
    """The matplotlib module. Raises StoreError if it is not installed."""
    try:
        import matplotlib
    except ImportError:
        raise StoreError(f"figures need matplotlib: {extra('plot')}") from None
    return matplotlib


def spell_letters(figure):
    """The figure with non-printing letters (of file names) spelled."""
    from matplotlib.text import Text

    for text in figure.findobj(Text):
        if text.get_text() != (plain_text := printable(text.get_text(), "\n")):
            text.set_text(plain_text)
    return figure


def wrap_labels(figure):
    """The figure with the y labels in several lines that are longer than their panels, which would be cut at its edge."""
    for ax in figure.axes:
        place, size = ax.get_subplotspec(), ax.yaxis.label.get_size()
        if place is not None:
            height = figure.get_figheight() * 72 * len(place.rowspan) / place.get_gridspec().nrows
            letters = max(int((height - BESIDE * size) / (1.1 * WIDEST * size)), LEAST)
            ax.set_ylabel(textwrap.fill(ax.get_ylabel(), letters, break_long_words=False, break_on_hyphens=False))
    return figure


def default_folder(path):
    """Default folder for the figures of the store at `path`."""
    return path.with_suffix("") if path.suffix else path.with_name(f"{path.name}-figures")


def check_folder(folder):
    """Raise StoreError if the folder cannot be made."""
    there = next(path for path in (Path(folder).absolute(), *Path(folder).absolute().parents) if os.path.lexists(path))
    if not os.path.isdir(there):
        raise StoreError(f"cannot put figures into {folder}: {there} is not a folder; choose another one")


@contextlib.contextmanager
def folder_of_figures(folder):
    """Context manager: a folder, made if necessary; after an error in it a new one does not stay empty. Raises StoreError."""
    folder = Path(folder)
    new = missing_above(folder / "figure")
    try:
        _make_folder(folder)
        yield
    except BaseException:
        remove_empty(new)
        raise


def _make_folder(folder):
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise store_error(error, f"cannot put figures into {folder}: {reason(error)}; --out takes a folder") from None
