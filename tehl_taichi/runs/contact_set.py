"""Stored sets of contacts: a folder with one JSON object, its table, its figure."""

import contextlib
import itertools
import json
import os
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, ClassVar, Self

from tehl_taichi.disk import files, links, user_files
from tehl_taichi.disk.drafts import PART, staging_path
from tehl_taichi.disk.locks import LOCK
from tehl_taichi.errors import StoreError
from tehl_taichi.store.store import Store
from tehl_taichi.store.store_draft import check_room, writable_folder
from tehl_taichi.values.checks import integer
from tehl_taichi.values.coded_warning import summary_for_reader
from tehl_taichi.values.escape import typed

DAMAGES = ValueError, KeyError, TypeError, AttributeError, RecursionError  # of a JSON file that tehl did not write


@dataclass(frozen=True, repr=False)
class ContactSet:
    """Base of flanks, bearings and cams. folder; record: the JSON object of `tehl KIND --json`.

    A subclass has a KIND, which names its command and files, the TABLES in its record, a :meth:`_csv` and a :meth:`_drawn`.
    """

    folder: Path
    record: dict

    KIND: ClassVar[str]
    TABLES: ClassVar[tuple[str, ...]] = ()

    @classmethod
    def open(cls, folder: str | PathLike) -> Self:
        """Open the set in a folder. Raises StoreError."""
        file = cls._file(folder)
        try:
            return cls._read(folder)
        except DAMAGES as error:
            raise StoreError(f"{file} is damaged ({type(error).__name__}: {error}); repeat the tehl {cls.KIND} command to "
                             f"write it again with --out {typed(folder)}, which keeps a copy of this file") from None

    @classmethod
    def _read(cls, folder):
        """The set in a folder. Raises StoreError if its file cannot be read, one of DAMAGES for other contents."""
        file = cls._file(folder)
        try:
            record = files.json_of(file)
        except OSError as error:
            raise StoreError(f"cannot read {file}: {error.strerror or error}") from None
        inside = {name: dict(record[name]) for name in cls.TABLES}
        found = cls(Path(folder), {**record, "name": str(record["name"]), **inside})
        found._complete()
        return found

    @classmethod
    def _file(cls, folder):
        return Path(folder) / f"{cls.KIND}.json"

    @classmethod
    def lies_in(cls, folder: str | PathLike) -> bool:
        """Whether the folder contains results of this kind."""
        return os.path.isfile(cls._file(folder))

    @classmethod
    def check_writable(cls, folder: Path, own: Self | None = None) -> None:
        """Raise StoreError if no set can be made or resumed in `folder`, or if its set is another than `own`; DiskError without
        room for its stores.
        """
        user_files.check_outside(folder)
        if os.path.lexists(folder):
            cls._check_content(folder, own)
        check_room(writable_folder(folder))

    @classmethod
    def _check_content(cls, folder, own):
        if not os.path.isdir(folder) and not os.path.islink(folder):
            raise StoreError(f"{folder} exists and is not a folder; choose another --out")
        links.refuse(folder)
        if cls.lies_in(folder):
            cls._check_set(folder, own)
        else:
            cls._check_kind(folder)
            cls._check_free(folder, own)

    @classmethod
    def _check_kind(cls, folder):
        """Refuse the store of a run or a study, and the folder of a set of another kind."""
        from tehl_taichi.runs.open_results import kind

        if links.marks_of(folder):
            raise StoreError(f"{folder} exists and is the folder of a {kind(folder)}; choose another --out")

    @classmethod
    def _check_free(cls, folder, own):
        """Refuse a folder with other contents than a lock and stores of `own`, which a killed command may just have begun."""
        stores = [Path(one["store"]) for one in own._contacts if one.get("store")] if own else []
        left = {LOCK, *(path.name for path in stores), *(staging_path(path, PART).name for path in stores)}
        if any(path.name not in left and not files.TEMPORARY.fullmatch(path.name) for path in Path(folder).iterdir()):
            raise StoreError(f"{folder} exists and is not the folder of a {cls.KIND}; choose another --out")

    @classmethod
    def _check_set(cls, folder, own):
        """Refuse the folder of another set, whose results would be lost; keep a copy of a damaged file of this one."""
        try:
            found = cls._read(folder)
        except DAMAGES:
            return cls._keep_copy(folder)
        if own and found.name != own.name:
            raise StoreError(f"{folder} holds {cls.KIND} {found.name}; choose another --out")
        if own and (lost := own._lost(found)):
            raise StoreError(f"{folder} holds {cls.KIND} {found.name} with the result of a contact that this command does not "
                             f"have ({lost}); choose another --out")

    @classmethod
    def _keep_copy(cls, folder):
        """Copy a damaged file to the first free name cam.json.damaged-N. Raises StoreError."""
        file = cls._file(folder)
        names = (file.with_name(f"{file.name}.damaged-{n}") for n in itertools.count(1))
        with files.disk_errors(folder, "cannot write to"):
            files.replace(next(name for name in names if not os.path.lexists(name)), files.content(file))

    def _lost(self, stored):
        """Words for a contact with a result in the `stored` set that this one has not; "" without one."""
        return ""

    def _complete(self):
        """Access all values that a damaged record may lack, so that their errors are raised."""
        self._csv()

    def _csv(self) -> str:
        """CSV text of the table."""
        raise NotImplementedError

    @property
    def name(self) -> str:
        return self.record["name"]

    @property
    def _contacts(self) -> list:
        """Entries of the record, one per contact, with its "store"."""
        raise NotImplementedError

    def stores(self) -> list:
        """Stores of all contacts that have one."""
        return [store for n in range(len(self._contacts)) if (store := self.store_of(n))]

    def store_of(self, number: int) -> Any:
        """The readable :class:`tehl_taichi.store.store.Store` of a contact, or None. Raises SceneError for a number without a
        contact.
        """
        integer("number", number, 0, len(self._contacts) - 1)
        path = self.folder / Path(self._contacts[number].get("store") or "none").name
        with contextlib.suppress(StoreError):
            return Store.open(path) if os.path.isdir(path) else None
        return None

    def to_dict(self) -> dict:
        """The JSON object of the command with --json, in SI units."""
        return self.record

    def write(self) -> list:
        """Write the JSON object and the table into the folder, named after the command; returns their paths. Raises
        StoreError.
        """
        texts = {self._file(self.folder): json.dumps(self.record, indent=1, allow_nan=False),
                 self.folder / f"{self.KIND}.csv": self._csv()}
        with files.disk_errors(self.folder, "cannot write to"):
            self.folder.mkdir(parents=True, exist_ok=True)  # where no contact converged there are no stores
            for path, text in texts.items():
                files.replace(path, text.encode())
        return list(texts)

    def plot(self, path: str | PathLike | None = None, dpi: int = 160, format: str = "png", width: float = 17.0,
             force: bool = False) -> Path:
        """Write the figure (default: in the folder, named after the command); returns its path.

        dpi, format (if the path has no suffix), width, force: as :meth:`Run.plot`. Raises SceneError; StoreError without
        matplotlib, or if a file is in the way.
        """
        from tehl_taichi.view.figures import folder_figure
        from tehl_taichi.view.figures.figure_style import FigureStyle

        return folder_figure.write(self.folder, path or self.folder / self.KIND, FigureStyle(format, dpi, width, force),
                                   self._drawn)

    def _drawn(self, page):
        """Its matplotlib Figure on a page (:class:`tehl_taichi.view.figures.figure_style.FigureStyle`)."""
        raise NotImplementedError


class PositionSet(ContactSet):
    """Base of sets whose contacts form a sequence, as along a flank; a subclass reads one contact with :meth:`_position`, and
    names in CONTACT the keys that describe it.
    """

    CONTACT: ClassVar[tuple[str, ...]] = ()

    @staticmethod
    def _position(one):
        """Position of an entry of the record."""
        raise NotImplementedError

    @property
    def _contacts(self):
        return self.record["positions"]

    @property
    def rows(self) -> list:
        """(position, Hertz pressure in Pa, summary or None) of every position."""
        return [(self._position(one), one["p_Hertz_Pa"], summary_for_reader(one["summary"]))
                for one in self.record["positions"]]

    @property
    def failed(self) -> list:
        """(position, reason) of all without a result."""
        return [(self._position(one), one["reason"]) for one in self.record["positions"] if one["summary"] is None]

    def _lost(self, stored):
        own = [self._description(one) for one in self._contacts]
        lost = (one for one in stored._contacts if one["summary"] and self._description(one) not in own)
        return next((f"{self._position(one).words}, {one['load_N_m']:g} N/m" for one in lost), "")

    def _description(self, one):
        return [one[key] for key in self.CONTACT]
