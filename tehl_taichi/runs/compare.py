"""Comparison of runs: differences of their scenes, their summaries, one common figure."""

from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Union

from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.runs import compare_labels
from tehl_taichi.runs.compare_labels import flat
from tehl_taichi.runs.open_results import RUN, kind, open_run
from tehl_taichi.store.sets_of_runs import INSIDE
from tehl_taichi.store.store import Store
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.path_arguments import folder_of

if TYPE_CHECKING:
    from tehl_taichi.runs.compare_places import PlaceComparison
    from tehl_taichi.runs.contact_set import ContactSet
    from tehl_taichi.runs.stored_run import Run
    from tehl_taichi.runs.sweep.study_table import Study

MOST = 8  # results: more lines cannot be distinguished
# of a summary: words, or what every run has of its own
OWN = ("store", "version", "scene", "left_out", "warnings", "warning_codes", "warning_data", "error_parts", "unknown",
       "unknown_codes")


@dataclass(frozen=True)
class Comparison:
    """Comparison of two or more runs; :func:`tehl_taichi.compare` makes one.

    Attributes
    ----------
    stores : tuple of Store
          The stores of the runs, in the given order.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Comparison(())
    <tehl.Comparison of 0 runs>
    """

    stores: tuple
    without_settings = ()  # every store has its scene

    def __repr__(self):
        return f"<tehl.Comparison of {len(self.stores)} runs{': ' * bool(self.stores)}{', '.join(self.labels())}>"

    @property
    def names(self) -> list[str]:
        """Folder names, with as many parent folders as are needed to distinguish them."""
        return compare_labels.names([store.path for store in self.stores])

    @property
    def differs(self) -> dict:
        """{dotted key of the scene: its value in every run} of the keys that differ; None for a scene without the key."""
        return compare_labels.differs([flat(store.scene.to_dict()) for store in self.stores])

    @property
    def summaries(self) -> dict:
        """{dotted name, as in the JSON summary: its number in every run}; None for a run without it."""
        return compare_labels.side_by_side([flat(store.summary) for store in self.stores], _shown_values)

    @property
    def lines(self) -> list:
        """Rows of `tehl show` for the summaries: one :class:`tehl_taichi.runs.compare_rows.ComparisonRow` per quantity."""
        from tehl_taichi.runs.compare_rows import lines

        return lines([store.summary for store in self.stores])

    def labels(self) -> list[str]:
        """Label of each run: up to two values that differ, or its folder."""
        return compare_labels.labels(self.differs, [store.path for store in self.stores])

    def to_dict(self) -> dict:
        """The JSON object of `tehl compare --json`."""
        return {"stores": [str(store.path) for store in self.stores], "finished": [store.finished for store in self.stores],
                "differs": self.differs, "summaries": self.summaries}

    def plot(self, path: str | PathLike, at: float = 0.0, dpi: int = 160, format: str = "png", width: float = 17.0,
             force: bool = False) -> Path:
        """Write the figure, with the feature at `at` half-widths in runs with a feature; returns its path.

        dpi, format (if the path has no suffix), width, force: as :meth:`Run.plot`. Raises SceneError, StoreError.
        """
        from tehl_taichi.runs import compare_figure
        from tehl_taichi.view.figures.figure_style import FigureStyle

        return compare_figure.write(self, path, at, FigureStyle(format, dpi, width, force))


def compare(*paths: "str | PathLike | Run | Study | ContactSet") -> Union[Comparison, "PlaceComparison"]:
    """Compare results: see :func:`tehl_taichi.compare`."""
    from tehl_taichi.runs.compare_places import PlaceComparison

    if len(paths) == 1 and isinstance(paths[0], (list, tuple)):
        raise SceneError(f"{shown(paths[0])} is a list; give its results one by one, as compare(*results)")
    if not 2 <= len(paths) <= MOST:
        raise SceneError(f"{number_of(len(paths), 'store')} to compare; allowed: 2 to {MOST}")
    folders = [folder_of(path) for path in paths]
    if len({folder.resolve() for folder in folders}) < len(folders):
        raise StoreError(f"{_twice(folders)} is given twice; give different ones")
    if _one_kind(folders) == RUN:
        return Comparison(tuple(Store.open(folder) for folder in folders))
    return PlaceComparison.of(folders)


def _one_kind(folders):
    """Common kind of all folders. Raises SceneError for different kinds, StoreError for a folder without results."""
    kinds = [kind(folder) for folder in folders]
    other = next((n for n, one in enumerate(kinds) if one != kinds[0]), None)
    if other is None:
        return kinds[0]
    for folder in (folder for folder, one in zip(folders, kinds) if one == RUN):
        open_run(folder)  # refused where nothing lies there, or an unfinished flank
    inside = next((Path(folder) / INSIDE[one][1] for folder, one in zip(folders, kinds) if one != RUN), None)
    raise SceneError(f"{folders[0]} is a {kinds[0]} and {folders[other]} is a {kinds[other]}; allowed: results of one kind (a "
                     f"run of the {next(one for one in kinds if one != RUN)} is {inside})")


def _twice(paths):
    return next(path for n, path in enumerate(paths) if path.resolve() in [other.resolve() for other in paths[:n]])


def _shown_values(key, values):
    parts = key.split(".")
    numbers = [v for v in values if isinstance(v, (int, float)) and not isinstance(v, bool)]
    return bool(numbers) and not set(parts) & set(OWN) and " " not in key
