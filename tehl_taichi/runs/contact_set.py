"""Several contacts and their results as a folder keeps them: one JSON object, its table, its figure."""

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

    A class of them has its KIND, which names command and files, the TABLES inside its record, its :meth:`_csv` and
    :meth:`_drawn`.
    """

    folder: Path
    record: dict

    KIND: ClassVar[str]
    TABLES: ClassVar[tuple[str, ...]] = ()

    @classmethod
    def open(cls, folder: str | PathLike) -> Self:
        """The one in a folder. Raises StoreError."""
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
        """Whether the results of one lie in the folder."""
        return cls._file(folder).is_file()

    @classmethod
    def check_writable(cls, folder: Path) -> None:
        """Raises StoreError where none can be made in `folder`, nor one in it be resumed."""
        user_files.check_outside(folder)
        if not os.path.lexists(folder):
            return
        links.refuse(folder)
        if cls.lies_in(folder):
            cls.open(folder)
            files.tidy(folder)
        else:
            cls._check_free(folder)

    @classmethod
    def _check_free(cls, folder):
        """Refuse a folder in which something else lies."""
        if any(Path(folder).iterdir()):
            raise StoreError(f"{folder} exists and is not the folder of a {cls.KIND}; choose another --out")

    def _complete(self):
        """Read what a record may lack, which raises what that raises."""
        self._csv()

    def _csv(self) -> str:
        """The table as CSV."""
        raise NotImplementedError

    @property
    def name(self) -> str:
        return self.record["name"]

    @property
    def _contacts(self) -> list:
        """Entries of the record, one for each contact, with its "store"."""
        raise NotImplementedError

    def stores(self) -> list:
        """The :meth:`store_of` each contact that has one."""
        return [store for n in range(len(self._contacts)) if (store := self.store_of(n))]

    def store_of(self, number: int) -> Any:
        """The readable :class:`tehl_taichi.store.store.Store` of a contact, None where it has none."""
        from tehl_taichi.store.store import Store

        path = self.folder / Path(self._contacts[number].get("store") or "none").name
        with contextlib.suppress(StoreError):
            return Store.open(path) if path.is_dir() else None
        return None

    def to_dict(self) -> dict:
        """The JSON object of the command with --json, in SI units."""
        return self.record

    def write(self) -> list:
        """JSON object and table into the folder, under the name of the command; returns their paths. Raises StoreError."""
        texts = {self._file(self.folder): json.dumps(self.record, indent=1, allow_nan=False),
                 self.folder / f"{self.KIND}.csv": self._csv()}
        with files.blamed(self.folder, "cannot write to"):
            self.folder.mkdir(parents=True, exist_ok=True)  # where no contact converged there are no stores
            for path, text in texts.items():
                files.replace(path, text.encode())
        return list(texts)

    def plot(self, path: str | PathLike | None = None, dpi: int = 160, format: str = "png", width: float = 17.0,
             force: bool = False) -> Path:
        """The figure (default: in the folder, under the name of the command); returns its path.

        dpi, format (where the path has no suffix), width, force: as :meth:`Run.plot`. Raises SceneError, or StoreError without
        matplotlib, or where something is in the way.
        """
        from tehl_taichi.view.figures import folder_figure
        from tehl_taichi.view.figures.figure_style import FigureStyle

        return folder_figure.write(self.folder, path or self.folder / self.KIND, FigureStyle(format, dpi, width, force),
                                   self._drawn)

    def _drawn(self, page):
        """Its matplotlib Figure on a page (:class:`tehl_taichi.view.figures.figure_style.FigureStyle`)."""
        raise NotImplementedError


class PositionSet(ContactSet):
    """Base of those whose contacts follow each other, as along a flank; a class of them reads one with :meth:`_position`."""

    @staticmethod
    def _position(one):
        """The position of an entry of the record."""
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
        """(position, reason) of those without a result."""
        return [(self._position(one), one["reason"]) for one in self.record["positions"] if one["summary"] is None]
