"""Stored sets of contacts: a folder with one JSON object, its table, its figure."""

import contextlib
import json
import os
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, ClassVar, Self

from tehl_taichi.disk import files, links, user_files
from tehl_taichi.errors import StoreError


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
            record = files.json_of(file)
            inside = {name: dict(record[name]) for name in cls.TABLES}
            found = cls(Path(folder), {**record, "name": str(record["name"]), **inside})
            found._complete()
            return found
        except OSError as error:
            raise StoreError(f"cannot read {file}: {error.strerror or error}") from None
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
            raise StoreError(f"{file} is damaged ({type(error).__name__}: {error}); repeat the tehl {cls.KIND} command to "
                             "write it again") from None

    @classmethod
    def _file(cls, folder):
        return Path(folder) / f"{cls.KIND}.json"

    @classmethod
    def lies_in(cls, folder: str | PathLike) -> bool:
        """Whether the folder contains results of this kind."""
        return cls._file(folder).is_file()

    @classmethod
    def check_writable(cls, folder: Path) -> None:
        """Raise StoreError if no set can be made or resumed in `folder`."""
        user_files.check_outside(folder)
        if not os.path.lexists(folder):
            return
        links.refuse(folder)
        if cls.lies_in(folder):
            cls.open(folder)
            files.remove_temporaries(folder)
        else:
            cls._check_free(folder)

    @classmethod
    def _check_free(cls, folder):
        """Refuse a folder with other contents."""
        if any(Path(folder).iterdir()):
            raise StoreError(f"{folder} exists and is not the folder of a {cls.KIND}; choose another --out")

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
        """The readable :class:`tehl_taichi.store.store.Store` of a contact, or None."""
        from tehl_taichi.store.store import Store

        path = self.folder / Path(self._contacts[number].get("store") or "none").name
        with contextlib.suppress(StoreError):
            return Store.open(path) if path.is_dir() else None
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
    """Base of sets whose contacts form a sequence, as along a flank; a subclass reads one contact with :meth:`_position`."""

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
        return [(self._position(one), one["p_Hertz_Pa"], one["summary"]) for one in self.record["positions"]]

    @property
    def failed(self) -> list:
        """(position, reason) of all without a result."""
        return [(self._position(one), one["reason"]) for one in self.record["positions"] if one["summary"] is None]
