"""Animation of a run: GIF with the `plot` extra, MP4 if ffmpeg is available."""

import contextlib
import os
import shutil
import subprocess
from os import PathLike
from pathlib import Path
from typing import Any, Callable

import numpy as np

from tehl_taichi.disk import user_files
from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.store.store import Store
from tehl_taichi.values.checks import callback, choice, flag, integer
from tehl_taichi.values.path_arguments import folder_of, path_of
from tehl_taichi.view.figures.figure_style import FigureStyle, import_matplotlib
from tehl_taichi.view.figures.frames import SHOWN, Frames
from tehl_taichi.view.figures.moments import Moments

FORMATS = ("gif", "mp4")
FRAMES, FPS, DPI, WIDTH = 120, 15, 110, 17.0
EVEN = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white"  # numbers of rows and columns, which MP4 needs
NEARLY = 248  # of 255: Pillow distinguishes colours in steps of 4, and takes the nearest below
SAMPLES = 5  # frames that the colours of a GIF are taken from


def animate(source: str | PathLike | Any, out: str | PathLike | None = None, *, format: str | None = None, frames: int = FRAMES,
            fps: int = FPS, dpi: int = DPI, width: float = WIDTH, shown: str = "film", force: bool = False,
            progress: Callable[[int, int], None] | None = None) -> Path:
    """Write an animation: see :func:`tehl_taichi.animate`."""
    integer("frames", frames, 2, 2000)
    integer("fps", fps, 1, 50)
    choice("--map", shown, SHOWN)
    flag("force", force)
    callback("progress", progress)
    page, store = FigureStyle(dpi=dpi, width=width), Store.open(folder_of(source))
    path, format = _file(store, out, format, force)
    _check(store, shown)
    import_matplotlib()
    write = {"gif": _gif, "mp4": _mp4}[format]
    tool = _ffmpeg() if format == "mp4" else None
    entries = np.unique(np.linspace(0, store.steps - 1, frames).round().astype(int)).tolist()
    with page.style(), user_files.made(path, force, kind=format) as draft:
        write(draft, Frames(page, Moments(store), entries, shown if store.y.size > 1 else None), fps,
              progress or (lambda done, total: None), tool)
    return path


def _file(store, out, format, force):
    """(path, format) of the file to write. Raises SceneError, or StoreError if an existing file is in the way."""
    path = path_of("out", out) if out else store.path.with_name(store.path.name.removesuffix(".zarr"))
    if out and os.path.isdir(path):
        raise StoreError(f"{path} is a folder; --out takes the name of a file")
    ending = path.suffix[1:].lower() if out else ""
    format = format or ending or "gif"
    choice("format", format, FORMATS)
    if ending in FORMATS and ending != format:
        raise SceneError(f"out = {path} does not end in .{format}; omit --format, or choose another --out")
    path = path if ending == format else path.with_name(f"{path.name}.{format}")
    user_files.check(path, force, format)
    return path, format


def _check(store, shown):
    """Raise StoreError if there is nothing to animate."""
    if store.steps < 2:
        raise StoreError(f"{store.path} has only a steady state, so there is no passage to animate; use `tehl plot`")
    if shown == "temperature" and store.scene.isothermal:
        raise StoreError(f"{store.path} is isothermal and has no temperatures; use --map film or --map pressure")


def _with_progress(frames, progress):
    """Generator of the pictures; reports each."""
    for done, n in enumerate(frames.entries):
        progress(done, len(frames.entries))
        yield frames.picture(n)
    progress(len(frames.entries), len(frames.entries))


def _gif(path, frames, fps, progress, _):
    """Write a GIF frame by frame, with one common set of colours so that it does not flicker."""
    from PIL import Image

    some = [frames.entries[n] for n in np.linspace(0, len(frames.entries) - 1, SAMPLES).astype(int)]
    colours = _with_white(Image.fromarray(np.concatenate([frames.picture(n) for n in some])).quantize(256))
    plain = Image.Dither.NONE
    pictures = (Image.fromarray(picture).quantize(palette=colours, dither=plain)
                for picture in _with_progress(frames, progress))
    next(pictures).save(path, "GIF", save_all=True, append_images=pictures, duration=10 * round(100 / fps), loop=0,
                        comment=user_files.PROGRAM.encode())


def _with_white(image):
    """Picture with an exactly white page: averaged to 256 colours, white is slightly off."""
    colours = np.array(image.getpalette()).reshape(-1, 3)
    colours[(colours >= NEARLY).all(axis=1)] = 255
    image.putpalette(colours.ravel().tolist())
    return image


def _ffmpeg():
    """Path of ffmpeg. Raises StoreError without it."""
    found = shutil.which("ffmpeg")
    if not found:
        raise StoreError("MP4 needs the program ffmpeg, which was not found; install it, or use --format gif")
    return found


def _mp4(path, frames, fps, progress, ffmpeg):
    """Send the pictures to ffmpeg one by one; Ctrl-C reaches this process only. Raises StoreError with ffmpeg's message."""
    rows, columns, _ = frames.picture(frames.entries[0]).shape
    raw = f"-f rawvideo -pix_fmt rgb24 -s {columns}x{rows} -r {fps} -i -"
    film = f"-an -vf {EVEN} -pix_fmt yuv420p -movflags +faststart -metadata comment={user_files.PROGRAM} -f mp4"
    command = [ffmpeg, "-y", "-loglevel", "error", *raw.split(), *film.split(), str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True) as process:
        try:
            output = _send_pictures(process, _with_progress(frames, progress))
        except BaseException:
            process.kill()
            raise
    if process.returncode:
        raise StoreError(f"ffmpeg failed: {' '.join(output.decode(errors='replace').split()) or process.returncode}")


def _send_pictures(process, pictures):
    """Send the pictures to a process; returns its error output. The process may end before it has read all."""
    try:
        for picture in pictures:
            process.stdin.write(picture.tobytes())
    except BrokenPipeError:
        pass
    with contextlib.suppress(BrokenPipeError):
        process.stdin.close()
    return process.stderr.read()
