"""A run on disk, as Python sees it."""

import html
from os import PathLike
from pathlib import Path
from typing import Any

from tehl_taichi.errors import StoreError, extra
from tehl_taichi.scene import Scene


class Run:
    """A run and its store: what :func:`tehl_taichi.run`, :func:`tehl_taichi.open` and :func:`tehl_taichi.resume` give.

    store: the :class:`tehl_taichi.io.store.Store` behind it, whose `fields(n)` are the (nx+1, ny+1) arrays in SI of entry n.

    >>> import tehl_taichi as tehl
    >>> scene = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
    >>> run = tehl.run(scene, "shown.zarr")
    >>> run.path.name, run.finished, run.scene == scene, sorted(run.summary["steady"]["error"])[:2], run.rest()
    ('shown.zarr', True, True, ['friction_coefficient', 'h_c_m'], None)
    """

    def __init__(self, store):
        self.store = store

    @property
    def path(self) -> Path:
        """Folder of the store."""
        return self.store.path

    @property
    def scene(self) -> Scene:
        """The :class:`tehl_taichi.Scene` that it is of."""
        return self.store.scene

    @property
    def finished(self) -> bool:
        """Whether it reached the end that it was given, with its fatigue and its summary."""
        return self.store.finished

    @property
    def summary(self) -> dict:
        """The JSON object of `tehl run --json` (SI units in the names), {} of a run that is not finished."""
        return self.store.summary

    @property
    def warnings(self) -> list:
        """What is doubtful, a sentence each; of a run that is not finished: in its scene."""
        return self.store.warnings

    def fatigue(self, *, progress: Any = None, threads: int | None = None, until: float | None = None, **constants: Any) -> Any:
        """Its fatigue again, with other constants: :func:`tehl_taichi.fatigue` of it; told apart up to where its grid resolves
        the pressure (or `until`), with the error bars of its index where they hold for these constants, too."""
        from tehl_taichi.fatigue.constants import changed
        from tehl_taichi.march import companions
        from tehl_taichi.study import errors_again
        from tehl_taichi.study.assessed import assessed

        scene = changed(self.scene, constants)
        if until is None and len(self.store) > 1:
            until = companions.resolved(self.scene, self.store, self.store.scalar)
        found = assessed(self.store, scene, progress, until, threads)
        errors_again.tell(found.summary, scene.fatigue, self.store)
        return found

    def crack(self, **wanted: Any) -> Any:
        """Where a crack goes under its loads: :func:`tehl_taichi.crack` of it."""
        from tehl_taichi.crack import crack

        return crack(self, **wanted)

    def to_xarray(self) -> Any:
        """Every array of the store as an `xarray.Dataset` that is read when it is looked at: dimensions time, x and y, unit and
        meaning on each. Raises StoreError without xarray (the `xarray` extra)."""
        try:
            import xarray
        except ImportError:
            raise StoreError(f"a dataset needs xarray: {extra('xarray')}") from None
        return xarray.open_zarr(self.path)

    def plot(self, folder: str | PathLike | None = None, dpi: int = 160, format: str = "png", width: float = 17.0,
             at: float | None = None, depth: float | None = None, force: bool = False) -> list:
        """Write the figures of `tehl plot` into `folder` (default: beside the store); returns their paths.

        dpi: dots per inch, 40 to 1200; format: png, pdf or svg; width: cm, 5 to 60; at: position of the feature to show, in
        half-widths a (default: some, see :mod:`tehl_taichi.figures.moments`); depth: µm, of the fatigue to show beside that of
        the surface (default: the worst); force: replace figures of ours that are there. Raises SceneError, or StoreError
        without matplotlib (the `plot` extra) or where it cannot write.
        """
        from tehl_taichi.figures.page import Page, beside
        from tehl_taichi.figures.run_figures import write_all

        return write_all(self.store, folder or beside(self.path), Page(format, dpi, width, force), at, depth)

    def animate(self, out: str | PathLike | None = None, **options: Any) -> Path:
        """Write a film of its passage: :func:`tehl_taichi.animate` of it."""
        from tehl_taichi.figures import animate

        return animate(self, out, **options)

    def export(self, format: str = "csv", path: str | PathLike | None = None, **options: Any) -> Path:
        """Write it for other tools (csv, netcdf, vtk): :func:`tehl_taichi.export` of it; returns what was made."""
        from tehl_taichi.export import export

        return export(self, format, path, **options)

    def rest(self, steps: int | None = None) -> Scene | None:
        """The scene with which :func:`tehl_taichi.resume` goes on: with `steps` more, or to the end that the run was given, of
        a finished run to the end of its passage. None where nothing is left."""
        from tehl_taichi.scene.route import continued

        if not self.finished and not steps:
            return self.scene
        found = continued(self.scene, self.store.last_step, steps)
        return found or (None if self.finished else self.scene)

    def __repr__(self):
        state = "finished" if self.finished else "not finished"
        return f"<tehl.Run {self.scene.name}: {self.store.last_step} steps, {state}, {self.path}>"

    def _repr_html_(self):
        """Its summary as a small table, for notebooks."""
        from tehl_taichi.io.summary_rows import summary_rows, title

        if not self.summary:
            return f"<p>{html.escape(repr(self))}</p>"
        rows = "".join(f"<tr><td>{html.escape(what)}</td><td>{html.escape(value)}</td></tr>"
                       for what, value in summary_rows(self.summary))
        doubts = "".join(f"<li>{html.escape(sentence)}</li>" for sentence in self.warnings)
        return f"<table><caption>{html.escape(title(self.summary))}</caption>{rows}</table><ul>{doubts}</ul>"
