"""Study on disk: a folder that is a zarr group (xarray opens it with the swept keys as dimensions), a CSV and the cases.

STUDY/zarr.json, STUDY/srr/ ...   coordinates, status, and every number of the summaries over them
STUDY/table.csv                   the same numbers, one line per case
STUDY/cases.jsonl                 every completed case with its summary, from which the other two are made
STUDY/cases/0001.zarr             the store of a case
"""

import contextlib
import csv
import html
import io
import itertools
import json
import math
import os
import time
from collections.abc import Iterator
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from tehl_taichi import __version__
from tehl_taichi.commit import commit
from tehl_taichi.disk.files import disk_errors, json_of, reason, replace, store_error
from tehl_taichi.disk.locked_folder import LockedFolder, is_begun, locked_folder
from tehl_taichi.disk.user_files import check_outside
from tehl_taichi.errors import Interrupted, SceneError, StoreError, UnknownName, extra
from tehl_taichi.runs.sweep import case_records as records
from tehl_taichi.runs.sweep import summary_columns
from tehl_taichi.runs.sweep.axis_syntax import all_numbers, short_word, word
from tehl_taichi.runs.sweep.main_effects import main_effects, usual_effects
from tehl_taichi.runs.sweep.plan import ONE, Plan, unit
from tehl_taichi.runs.sweep.summary_columns import JUDGED
from tehl_taichi.store import array_file
from tehl_taichi.store.integrity import ROOT, missing_choice
from tehl_taichi.values.checks import integer, known_names, nearest
from tehl_taichi.values.coded_warning import summary_for_reader
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.escape import cell

TABLE, CASES, PLAN = "table.csv", "cases", "study"  # PLAN: the attribute that makes a group a study
SPELLED = {"deg C": "degC"}  # units of a scene, as the arrays of all stores have them
SHARE = 0.05  # of the time, at most, goes into writing table and arrays
EVERY = 1.0  # s between two writes, at least
MOST_SHOWN = 60  # cases in a notebook


class Study(LockedFolder):
    """A sweep on disk: its cases, their status and a table of all numbers of their summaries.

    :func:`tehl_taichi.sweep` and :func:`tehl_taichi.open` give one; `xarray.open_zarr(study.path)` reads it with the swept
    keys as dimensions.

    Attributes
    ----------
    path : pathlib.Path
        Its folder.
    plan : Plan
        Scene, keys and values, :class:`tehl_taichi.runs.sweep.plan.Plan`.
    status : array (cases,)
        Numbers of `case_records.STATUS`.
    values : dict
        {name: array (cases,)}, for instance "fatigue_Fi_max"; nan where a case has no such number.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> line = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
    >>> study = tehl.sweep(line, {"srr": [0.0, 0.1]}, "small.zarr", workers=1)
    >>> study, study.counts["converged"], len(study)
    (<Study small.zarr: 2 cases, 2 converged>, 2, 2)
    """

    def __init__(self, path, plan, lock=None):
        self.path, self.plan, self.lock = Path(path), plan, lock
        self.status = np.zeros(plan.count, "i1")
        self.values, self.written, self.due = {}, {}, 0.0
        self.first: dict[str, tuple[int, int]] = {}  # case in which a column is first, and its place there
        for record in records.read(self.path):
            if record["case"] < plan.count:
                self._take(record)

    @classmethod
    def open(cls, path: str | PathLike) -> "Study":
        """Open an existing study for reading. Raises StoreError."""
        attrs = attributes(path)
        if attrs is None:
            raise StoreError(f"{path} is not a study of tehl sweep")
        try:
            return cls(path, Plan.from_text(attrs[PLAN]))
        except (ValueError, KeyError, TypeError, AttributeError, IndexError) as error:
            if fault := missing_choice(_scene_text(attrs[PLAN])):
                raise StoreError(f"{path} needs {fault}") from None
            fault = error if isinstance(error, SceneError) else f"{shown(attrs[PLAN])} is not written by tehl"
            raise StoreError(f"{path} is damaged: its plan cannot be read ({fault})") from None

    @classmethod
    def write(cls, path, plan):
        """Open the study of `plan` at `path` for writing, or create it. Raises StoreError if other results are there, Busy if
        another sweep is writing.
        """
        path = Path(path)
        cls.check(path, plan)
        with disk_errors(path, "cannot write to"):
            path.mkdir(parents=True, exist_ok=True)
        return locked_folder(path, lambda lock: cls._locked(path, plan, lock))

    @staticmethod
    def check(path, plan):
        """Raise StoreError if the study of `plan` cannot be written at `path`, because other results are there."""
        attrs = attributes(path)
        check_outside(path)
        if attrs is None and (os.path.isfile(path) or os.path.isdir(path) and not is_begun(path)):
            raise StoreError(f"{path} exists already and is not a study; choose another --out")
        if attrs is not None and (version := attrs.get("version", "unknown")) != __version__:
            raise StoreError(f"{path} was written by version {version}, this is {__version__}; cases of two versions are not "
                             f"mixed. Choose another --out, or use version {version}")
        if attrs is not None and not plan.matches(attrs[PLAN]):
            raise StoreError(f"{path} holds another study; choose another --out or remove it")

    @classmethod
    def _locked(cls, path, plan, lock):
        records.mend(path)
        study = cls(path, plan, lock)
        with study._disk_errors():
            if attributes(path) is None:
                study._publish()  # whatever ends the rest, the same command knows it for its own
            (path / CASES).mkdir(exist_ok=True)
        study.flush()
        return study

    @contextlib.contextmanager
    def _disk_errors(self):
        """Context manager: disk errors (full, read-only) become Interrupted, before the first store or result a StoreError."""
        try:
            yield
        except OSError as error:
            what = f"cannot write to {self.path}: {reason(error)}; stored cases are kept, and the same command resumes"
            has_data = self.status.any() or any((self.path / CASES).glob("*.zarr"))
            raise (Interrupted(what) if has_data else store_error(error, what)) from None

    def close(self) -> None:
        """Write all pending data and release the lock."""
        try:
            if self.lock:
                self.flush()
        finally:
            super().close()

    def __len__(self) -> int:
        return self.plan.count

    def __repr__(self):
        counts = ", ".join(f"{count} {word}" for word, count in self.counts.items() if count)
        return f"<Study {self.path}: {number_of(len(self), 'case')}, {counts}>"

    def __getitem__(self, name: str) -> np.ndarray:
        """Column of the table, as an array (cases,): study["judged_Fi"]. Raises UnknownName; `list(study)` has all names."""
        if not (isinstance(name, str) and name in self.values):
            raise UnknownName(f"{shown(name)} is no column of this study{nearest(name, self.values)}; "
                              f"{known_names(self.values, 'list(study)')}")
        return self.values[name]

    def __iter__(self) -> Iterator[str]:
        """Names of all columns with numbers."""
        return iter(self.values)

    def __contains__(self, name: object) -> bool:
        """Whether `study[name]` is a column."""
        return name in self.values

    def _ipython_key_completions_(self):
        return list(self)

    def _repr_html_(self):
        """Its table, for notebooks: keys, status and the usual numbers of the first cases."""
        names = (*self.plan.keys, "status", *summary_columns.usual_columns(self.values))
        heads = "".join(f"<th>{html.escape(name)}</th>" for name in ("case", *names))
        rows = "".join(f"<tr><td>{row['case']}</td>{''.join(f'<td>{_shown_cell(row[name])}</td>' for name in names)}</tr>"
                       for row in itertools.islice(self.rows(), MOST_SHOWN))
        return f"<table><caption>{html.escape(repr(self))}</caption><tr>{heads}</tr>{rows}</table>"

    def main_effects(self, name: str = JUDGED) -> dict:
        """Share of the spread of a column that each key accounts for, to see which key matters.

        Parameters
        ----------
        name : str
            A column of the table.

        Returns
        -------
        dict
            "shares": {key: 0 to 1} (keys that change together are one, "srr, speed"); "together": share of several keys
            together, None if cases of a grid have no result; "why": reason why there are no shares, else "".

        Raises
        ------
        UnknownName
            The study has no such column.

        Notes
        -----
        All combinations: first-order index of Sobol (1993), the variance of the mean over all other keys over the whole
        variance. Samples: variance of the key's part of a fit by a sum of parabolas; "together" is what the fit leaves.

        Examples
        --------
        >>> import tehl_taichi as tehl
        >>> line = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
        >>> study = tehl.sweep(line, {"speed": [5.0, 10.0], "load": ["800 N/mm", "900 N/mm"]}, "effects.zarr", workers=1)
        >>> shares = study.main_effects("steady_h_c_m")["shares"]
        >>> shares["speed"] > 0.9 > 0.1 > shares["load"]
        True
        """
        self[name]
        return main_effects(self, name).to_dict()

    @property
    def counts(self) -> dict[str, int]:
        """{status: number of cases}."""
        return {word: int(np.sum(self.status == number)) for word, number in records.STATUS.items()}

    @property
    def open_cases(self) -> list[int]:
        """Numbers of the cases without a final result."""
        final = [records.STATUS[word] for word in records.FINAL]
        return np.flatnonzero(~np.isin(self.status, final)).tolist()

    @property
    def table(self) -> Path:
        """Path of the CSV."""
        return self.path / TABLE

    def store_of(self, number: int) -> Path:
        """Path of the store of a case (which may not exist). Raises SceneError for a number without a case."""
        integer("number", number, 0, len(self) - 1)
        return self.path / CASES / f"{number:04d}.zarr"

    def results(self) -> list[dict]:
        """Last record of every completed case, by case number: "case", "changes", "status", "converged", "reason", "store",
        "seconds", "summary".
        """
        last = {record["case"]: record for record in records.read(self.path) if record["case"] < len(self)}
        return [{**last[n], "converged": last[n]["status"] == "converged", "store": self._full(last[n].get("store")),
                 "summary": summary_for_reader(last[n].get("summary"))}
                for n in sorted(last)]

    def _full(self, store):
        return str(self.path / store) if store else None

    def rows(self) -> Iterator[dict]:
        """Generator of one dictionary per case: its number, keys, status and numbers."""
        words, columns = {number: word for word, number in records.STATUS.items()}, self.columns
        for n in range(len(self)):
            yield {"case": n, **self.plan.changes(n), "status": words[int(self.status[n])],
                   **{name: float(self.values[name][n]) for name in columns}}

    def add(self, record):
        """Store the record of a completed case; the table is updated from time to time. Raises StoreError, Interrupted.
        """
        with self._disk_errors():
            records.append(self.path, record)
        self._take(record)
        if time.monotonic() >= self.due:
            self.flush()

    def _take(self, record):
        n = record["case"]
        self.status[n] = records.STATUS[record["status"]]
        for column in self.values.values():
            column[n] = np.nan
        for place, (name, value) in enumerate(summary_columns.of_case(record.get("summary") or {}).items()):
            self.values.setdefault(name, np.full(len(self), np.nan))[n] = value
            self.first[name] = min(self.first.get(name, (n, place)), (n, place))

    @property
    def columns(self) -> list[str]:
        """Names of the numbers of its cases, in the order of the cases, whichever ended first."""
        return sorted(self.values, key=self.first.__getitem__)

    def flush(self):
        """Write arrays and CSV in their present state. Raises StoreError, Interrupted."""
        with self._disk_errors():
            self._flush()

    def _flush(self):
        started = time.monotonic()
        if not self.written:
            self._write_coordinates()
        for name, values in self.values.items():
            self._write(name, values, summary_columns.unit_of(name), name.replace("_", " "))
        self._write("status", self.status, "1", "status of the case", flag_values=list(records.STATUS.values()),
                    flag_meanings=" ".join(word.replace(" ", "_") for word in records.STATUS))
        self._publish()
        replace(self.table, self._csv().encode())
        self.due = time.monotonic() + max(EVERY, (time.monotonic() - started) / SHARE)

    def _write_coordinates(self):
        for key in self.plan.keys:
            dim, values = self.plan.coordinate(key)
            values = np.array(values) if all_numbers(values) else np.array([word(value) for value in values], dtype=object)
            unit_ = unit(self.plan.scene, key)
            self._make(key, values, [dim], SPELLED.get(unit_, unit_), key)
        if ONE not in self.plan.keys:
            numbers = np.arange(len(self), dtype="i4").reshape(self.plan.shape)
            self._make(ONE, numbers, self.plan.dims, "1", f"number of the case: its store is {CASES}/NUMBER.zarr")

    def _write(self, name, values, unit_, text, **attrs):
        values = values.reshape(self.plan.shape)
        if name in self.written:
            array_file.write_values(self.path / name, values)
        else:
            self._make(name, values, self.plan.dims, unit_, text, **attrs)

    def _make(self, name, values, dims, unit_, text, **attrs):
        """Write an array in place of an existing one."""
        fill = float("nan") if values.dtype.kind == "f" else 0
        attributes = {"units": unit_, "long_name": text, **attrs}
        self.written[name] = array_file.write(self.path / name, values, dims, fill, attributes)

    def _publish(self):
        """Replace the group's metadata."""
        coordinates = [key for key in (*self.plan.keys, ONE) if key in self.written and key not in self.plan.dims]
        attrs = {PLAN: self.plan.text, "version": __version__, "commit": commit(), "coordinates": " ".join(coordinates)}
        array_file.publish(self.path, attrs, self.written)

    def _csv(self):
        text = io.StringIO()
        out = csv.DictWriter(text, ["case", *self.plan.keys, "status", *self.columns], restval="", lineterminator="\n")
        out.writerow({key: cell(key) for key in out.fieldnames})
        for row in self.rows():
            out.writerow({key: _cell(value) for key, value in row.items()})
        return text.getvalue()

    def to_dict(self) -> dict:
        """The JSON object of `tehl sweep --json`."""
        converged = self.counts["converged"]
        return {"cases": len(self), "converged": converged, "failed": len(self) - converged, "study": str(self.path),
                "table": str(self.table), "main_effects": {name: one.to_dict() for name, one in usual_effects(self).items()},
                "results": self.results()}

    def to_xarray(self) -> Any:
        """Table as an xarray.Dataset over the swept keys. Raises StoreError without xarray, and for a damaged file."""
        try:
            from tehl_taichi.store import checked_zarr
        except ImportError:
            raise StoreError(f"xarray is not installed: {extra('xarray')}") from None
        return checked_zarr.opened(self.path, {}, _arrays(self.path)).load()

    def plot(self, folder: str | PathLike | None = None, quantity: str | None = None, dpi: int = 160, format: str = "png",
             width: float = 17.0, force: bool = False) -> list:
        """Write its figures into `folder` (default: beside the study), of one column of the table or of the usual ones.

        dpi, format, width, force: as :meth:`Run.plot`. Returns their paths. Raises SceneError; StoreError without matplotlib,
        for an unknown column, or if writing fails.
        """
        from tehl_taichi.runs.sweep import study_figures
        from tehl_taichi.view.figures.figure_style import FigureStyle, default_folder

        return study_figures.write_all(self, folder or default_folder(self.path), quantity,
                                       FigureStyle(format, dpi, width, force))


def _shown_cell(value):
    """Value of a row for a notebook."""
    return "" if value != value else html.escape(short_word(value))


def _cell(value):
    """Value of a row for the CSV, as its coordinate has it; "" for nan."""
    if all_numbers([value]):
        return "" if math.isnan(value) else value
    return cell(word(value))


def _scene_text(plan):
    """JSON text of the scene in the text of a plan; "" without one."""
    try:
        return json.dumps(json.loads(plan)["scene"])
    except (TypeError, ValueError, KeyError):
        return ""


def _arrays(path):
    """{name: metadata} of the arrays of the study at `path`. Raises StoreError."""
    try:
        return dict(json_of(path / ROOT)["consolidated_metadata"]["metadata"])
    except (OSError, ValueError, KeyError, TypeError):
        raise StoreError(f"{path / ROOT} is damaged: it does not describe the arrays of a study") from None


def is_study(path):
    """Whether there is a study at `path`."""
    return attributes(path) is not None


def attributes(path):
    """Attributes of the study at `path`, or None."""
    try:
        attrs = json_of(Path(path) / ROOT)["attributes"]
        return attrs if PLAN in attrs else None
    except (OSError, ValueError, KeyError, TypeError):
        return None
