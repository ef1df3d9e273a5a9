"""A stored run as a Python object."""

import html
import warnings
from collections.abc import Iterator
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tehl_taichi.errors import StoreError, UnknownName
from tehl_taichi.fatigue.overrides import changed
from tehl_taichi.runs.dataset import dataset
from tehl_taichi.runs.summary import summary_numbers
from tehl_taichi.scene import Scene
from tehl_taichi.scene.timeline import remaining_scene
from tehl_taichi.values.checks import callback, integer
from tehl_taichi.values.coded_text import for_reader
from tehl_taichi.values.coded_warning import summary_for_reader
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.estimate import Quantity

if TYPE_CHECKING:
    from tehl_taichi.crack.analysis import CrackResult
    from tehl_taichi.fatigue.search_result import SearchResult
    from tehl_taichi.store.store import Store


MOST_STEPS = 10**7  # further ones of a run


def check_steps(steps):
    """Refuse a number of further steps that is none; None is allowed."""
    if steps is not None:
        integer("steps", steps, 1, MOST_STEPS)


class Run:
    """A stored run; :func:`tehl_taichi.run`, :func:`tehl_taichi.open` and :func:`tehl_taichi.resume` return one.

    `run["p_max"]` is a number with its error and unit, `list(run)` the names of all numbers. `run.summary` holds
    all numbers, `run.store.fields(n)` the arrays (nx+1, ny+1) of entry n in SI units, `run.to_xarray()` everything. A notebook
    shows a run as a table.

    Attributes
    ----------
    store : Store
          Its store, :class:`tehl_taichi.store.store.Store`.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> scene = tehl.scene("smooth-line").replace(**{"grid.nx": 64, "thermal.on": False})
    >>> run = tehl.run(scene, "shown.zarr")
    >>> run.path.name, run.finished, run.scene == scene, run.rest()
    ('shown.zarr', True, True, None)
    >>> film = run["h_c"]
    >>> film.unit, film.error < 0.2 * film.value, run["steady.h_c_m"] == film
    ('m', True, True)
    """

    def __init__(self, store: "Store") -> None:
        self.store = store

    @property
    def path(self) -> Path:
        """Folder of the store."""
        return self.store.path

    @property
    def scene(self) -> Scene:
        """Its :class:`tehl_taichi.Scene`. Raises StoreError if a law of it is not installed here."""
        if self.store.lacks:
            raise StoreError(self.store.lacks)
        return self.store.scene

    @property
    def finished(self) -> bool:
        """Whether the run reached its end, with fatigue and summary."""
        return self.store.finished

    @property
    def summary(self) -> dict:
        """The JSON object of `tehl run --json` (SI units in the names), with arguments of Python in place of options; {} if the
        run is not finished.
        """
        return summary_for_reader(self.store.summary)

    @property
    def warnings(self) -> list:
        """Warnings: sentences with a `code` and `data`; for an unfinished run only those of its scene.

        Examples
        --------
        >>> import tehl_taichi as tehl
        >>> cut, = (one for one in tehl.scene("gear").replace(**{"time.steps": 1}).warnings() if one.code == "cut")
        >>> cut[:11], sorted(cut.data)
        ('passage cut', ['end_a', 'options', 'whole_a'])
        """
        return [for_reader(one) for one in self.store.warnings]

    def __getitem__(self, name: str) -> Quantity:
        """Return a number of the summary with its error: run["p_max"], or by its full name run["steady.p_max_Pa"].

        A name without its part is searched in the passage, then the steady start, then the fatigue; the unit may be left out.

        Raises
        ------
        UnknownName
              The run has no such number (the message proposes the nearest one; `list(run)` lists all), or is not finished.
        """
        if not self.summary:
            raise UnknownName(f"{self.path} is not finished: it has no summary; tehl_taichi.resume finishes it")
        return summary_numbers.find(self.summary, name)

    def __iter__(self) -> Iterator[str]:
        """Full names of all numbers of the summary; none if the run is not finished.

        Examples
        --------
        >>> import tehl_taichi as tehl
        >>> scene = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
        >>> run = tehl.run(scene, "listed.zarr")
        >>> [name for name in run if name.startswith("hertz")], "p_max" in run, "friction" in run
        (['hertz.a_m', 'hertz.p_Pa'], True, False)
        """
        return iter(summary_numbers.all_numbers(self.summary))

    def __contains__(self, name: object) -> bool:
        """Whether `run[name]` is a number."""
        return summary_numbers.contains(self.summary, name)

    def _ipython_key_completions_(self):
        return list(self)

    def fatigue(self, *, progress: Any = None, threads: int | None = None, until: float | None = None, **constants: Any
                ) -> "SearchResult":
        """Recompute its fatigue with other constants, see :func:`tehl_taichi.fatigue`; the store is not changed.

        Parameters
        ----------
        progress, threads, until, **constants
            As for :func:`tehl_taichi.fatigue`; `until` by default: where the grid no longer resolves the pressure.

        Returns
        -------
        SearchResult
            With the error bars of the index, where they hold for these constants too.
        """
        from tehl_taichi.march.accuracy import coarse_runs
        from tehl_taichi.runs import fatigue_errors
        from tehl_taichi.runs.stored_fatigue import assessed

        callback("progress", progress, "stage")
        scene = changed(self.scene, constants)
        resolved = until
        if until is None and len(self.store) > 1:
            resolved = coarse_runs.resolved(self.scene, self.store, self.store.scalar)
        found = assessed(self.store, scene, progress, resolved, threads)
        if self.store.map("zoom_entry") is not None:
            from tehl_taichi.runs import stored_window

            found = stored_window.refined(self.store, scene, found, progress, until)
        fatigue_errors.add_errors(found.summaries, scene.fatigue, self.store)
        return found.decided()

    def crack(self, **options: Any) -> "CrackResult":
        """Follow cracks under its loads, see :func:`tehl_taichi.crack`."""
        from tehl_taichi.crack import crack

        return crack(self, **options)

    def to_xarray(self) -> Any:
        """Open every array of the store as an `xarray.Dataset` that loads data when they are used.

        Returns
        -------
        xarray.Dataset
            Units and long names on every variable, a coordinate for every dimension; `feature_x` (m) runs along `time`.

        Raises
        ------
        StoreError
            xarray is not installed (extra `xarray`), or a file of the store is missing or damaged (the latter also while
            the dataset loads data).

        Examples
        --------
        >>> import tehl_taichi as tehl
        >>> scene = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
        >>> data = tehl.run(scene, "arrays.zarr").to_xarray()
        >>> data.pressure.dims, data.pressure.units, set(data.dims) <= set(data.coords)
        (('time', 'x', 'y'), 'Pa', True)
        """
        return dataset(self.path)

    def plot(self, folder: str | PathLike | None = None, *, at: float | None = None, depth: float | None = None,
             interference: str | None = None, refractive_index: float | None = None, wavelength: float | None = None,
             width: float = 17.0, dpi: int = 160, **written: Any) -> dict | list:
        """Draw its figures, those of `tehl plot`; :meth:`save_figures` writes them.

        Parameters
        ----------
        at : float, optional
            Position of the feature to show, in half-widths a; default: a choice, see :mod:`tehl_taichi.view.figures.moments`.
        depth : float, optional
            Depth in µm of the fatigue map beside that of the surface; default: where the index is largest.
        interference : {"chromatic", "monochromatic"}, optional
            Also draw the interference colours of the film, as an optical rig shows it.
        refractive_index : float, optional
            Of the oil without pressure, default 1.47.
        wavelength : float, optional
            Of monochromatic light in m, default 589.3e-9.
        width : float
            Width in cm, 5 to 60.
        dpi : int
            Dots per inch in a notebook, 40 to 1200.

        Returns
        -------
        dict
            {name: matplotlib Figure}; a notebook shows all of them.

        Raises
        ------
        SceneError
            A number is out of range, or the run has no such moment or depth.
        StoreError
            matplotlib is not installed (extra `plot`).

        Examples
        --------
        >>> import tehl_taichi as tehl
        >>> scene = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
        >>> tehl.run(scene, "drawn.zarr").plot()
        <tehl figures: centreline>
        """
        from tehl_taichi.view.figures.figure_style import FigureStyle
        from tehl_taichi.view.figures.interference import light
        from tehl_taichi.view.figures.run_figures import draw_all

        if folder is not None or written:
            warnings.warn("run.plot(folder) is run.save_figures(folder) from version 0.9 on", DeprecationWarning, stacklevel=2)
            return self.save_figures(folder, at=at, depth=depth, width=width, dpi=dpi, **written)
        return draw_all(self.store, FigureStyle(dpi=dpi, width=width), at, depth,
                        light(interference, refractive_index, wavelength))

    def save_figures(self, folder: str | PathLike | None = None, *, at: float | None = None, depth: float | None = None,
                     interference: str | None = None, refractive_index: float | None = None, wavelength: float | None = None,
                     width: float = 17.0, dpi: int = 160, format: str = "png", force: bool = False) -> list:
        """Write its figures, as `tehl plot` does.

        Parameters
        ----------
        folder : path, optional
            Default: beside the store.
        at, depth, interference, refractive_index, wavelength, width, dpi
            As for :meth:`plot`.
        format : {"png", "pdf", "svg"}
            File format.
        force : bool
            Replace figures that this program wrote.

        Returns
        -------
        list of pathlib.Path

        Raises
        ------
        SceneError, StoreError
            As for :meth:`plot`, or a file cannot be written.

        Examples
        --------
        >>> import tehl_taichi as tehl
        >>> scene = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
        >>> [path.name for path in tehl.run(scene, "saved.zarr").save_figures("figures", dpi=40)]
        ['centreline.png']
        """
        from tehl_taichi.view.figures.figure_style import FigureStyle, default_folder
        from tehl_taichi.view.figures.interference import light
        from tehl_taichi.view.figures.run_figures import write_all

        return write_all(self.store, folder or default_folder(self.path), FigureStyle(format, dpi, width, force), at, depth,
                         light(interference, refractive_index, wavelength))

    def animate(self, out: str | PathLike | None = None, **options: Any) -> Path:
        """Write an animation of its passage, see :func:`tehl_taichi.animate`."""
        from tehl_taichi.view.figures import animate

        return animate(self, out, **options)

    def export(self, format: str = "csv", path: str | PathLike | None = None, **options: Any) -> Path:
        """Write it for other tools (csv, netcdf, vtk), see :func:`tehl_taichi.export`."""
        from tehl_taichi.view.export import export

        return export(self, format, path, **options)

    def rest(self, steps: int | None = None) -> Scene | None:
        """The scene with which :func:`tehl_taichi.resume` would continue; None where no step is left.

        Parameters
        ----------
        steps : int, optional
            Number of further steps; default: to the end that the run was given, for a finished run to the end of its passage.

        Raises
        ------
        SceneError
            `steps` is no whole number of at least 1.
        """
        check_steps(steps)
        if not self.finished and not steps:
            return self.scene
        found = remaining_scene(self.scene, self.store.last_step, steps)
        if found and self.store.window_search:  # the longer passage may need another one
            found = found.replace(**{"zoom.factor": 0})
        return found or (None if self.finished else self.scene)

    def __repr__(self):
        state = "finished" if self.finished else "not finished"
        return f"<tehl.Run {self.store.scene.name}: {number_of(self.store.last_step, 'step')}, {state}, {self.path}>"

    def _repr_html_(self):
        """Its summary as a small table, for notebooks."""
        from tehl_taichi.runs.summary.summary_rows import summary_rows, title

        if not self.summary:
            return f"<p>{html.escape(repr(self))}</p>"
        rows = "".join(f"<tr><td>{html.escape(what)}</td><td>{html.escape(value)}</td></tr>"
                       for what, value in summary_rows(self.summary))
        doubts = "".join(f"<li>{html.escape(sentence)}</li>" for sentence in self.warnings)
        return f"<table><caption>{html.escape(title(self.summary))}</caption>{rows}</table><ul>{doubts}</ul>"
