"""Export of stored runs to other tools: tables (CSV), NetCDF, a time series for ParaView (VTK).

A format is a file here that declares a `file_format` entry; `selection` holds the chosen moments and points.
"""

from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tehl_taichi.view.export.file_format import Format

__all__ = ["export", "formats"]


def export(of: Any, format: str = "csv", path: str | PathLike | None = None, *, at: float | Sequence[float] = (),
           point: Sequence = (), force: bool = False) -> Path:
    """Export a run: see :func:`tehl_taichi.export`."""
    from tehl_taichi.disk import user_files
    from tehl_taichi.errors import SceneError
    from tehl_taichi.store.reader import Reader
    from tehl_taichi.values.checks import choice, flag
    from tehl_taichi.values.coerce import plain
    from tehl_taichi.values.path_arguments import folder_of, path_of
    from tehl_taichi.view.export.selection import Selection

    flag("force", force)
    known = formats()
    choice("format", format, list(known))
    reader, chosen = Reader.open(folder_of(of)), known[format]
    if not chosen.chosen and (plain(at), plain(point)) != ((), ()):
        raise SceneError(f"at and point apply to csv only; {format} holds every moment and every point")
    places = Selection.of(reader, at, point)
    target = path_of("path", path) if path is not None else chosen.default_path(Path(reader.path))
    with user_files.made(target, force, kind=chosen.ending[1:], parts=chosen.parts) as draft:
        chosen.write(reader, draft, places)
    return target


def formats() -> "dict[str, Format]":
    """{name: Format} of all formats."""
    import sys

    from tehl_taichi.values.registry import collect
    from tehl_taichi.view.export.file_format import Format

    return collect(sys.modules[__name__], Format)
