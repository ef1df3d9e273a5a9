"""tehl animate: what a frame shows, which frames there are, files that are whole or not there."""

import os
import stat

import numpy as np
import pytest
from made_figures import Made, made
from small_stores import store

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.view.figures.figure_style import INCH, FigureStyle
from tehl_taichi.view.figures.moments import Moments

pytest.importorskip("matplotlib")
SMALL = dict(dpi=40, width=8.5)
PAGE = FigureStyle(**SMALL)


def frames(built_in, shown):
    from tehl_taichi.view.figures.frames import Frames

    with PAGE.style():
        return Frames(PAGE, Moments(made(built_in)), [0, 1, 2, 3], shown)


def test_a_frame_shows_its_entry_on_axes_with_room_for_all():
    film = frames("gear", "pressure")
    limits = {name: (ax.get_xlim(), ax.get_ylim()) for name, ax in film.axes.items()}
    pictures = [film.picture(n) for n in (3, 1)]
    assert pictures[0].shape == pictures[1].shape and (pictures[0] != pictures[1]).any() and pictures[0].dtype == np.uint8
    fields = film.store.fields(1, film.fields)
    for line, name, factor in film.lines:
        np.testing.assert_allclose(line.get_ydata(), fields[name][:, 0] * factor)
    image, *_ = film.map
    np.testing.assert_allclose(image.get_array()[12:], fields["pressure"].T / 1e9)  # the other half is its mirror image
    assert film.title.get_text() == f"gear (a = {film.moments.a * 1e3:.3g} mm): feature at -0.80 a"
    assert {name: (ax.get_xlim(), ax.get_ylim()) for name, ax in film.axes.items()} == limits
    largest = film.store.fields(3, ["pressure"])["pressure"].max() / 1e9  # of the last entry
    assert image.get_clim() == pytest.approx((2.0, largest))
    assert film.axes["pressure"].get_ylim() == pytest.approx((0.0, 1.05 * largest))


def test_a_frame_has_the_map_and_the_feature_at_their_places_in_half_widths():
    """A value of the map stands in the middle of its picture element; the other half is its mirror image."""
    film = frames("gear", "film")
    film.picture(3)
    store, (image, *_) = film.store, film.map
    left, right, low, high = np.array(image.get_extent()) * store.a
    dx, dy = (np.diff(at[:2]).item() / 2 for at in (store.x, store.y))
    assert (left, right) == pytest.approx((store.x[0] - dx, store.x[-1] + dx))
    assert (low, high) == pytest.approx((-store.y[-1] - dy, store.y[-1] + dy))
    for place in film.places:
        assert list(np.array(place.get_xdata()) * store.a) == pytest.approx([store.at[3]] * 2)


def test_frames_of_a_whole_domain_say_which_row_their_lines_show():
    from tehl_taichi.view.figures.frames import Frames

    store = Made(made("gear").scene, whole=True)
    with PAGE.style():
        film = Frames(PAGE, Moments(store), [0, 2], "film")
    film.picture(2)
    np.testing.assert_allclose(film.lines[0][0].get_ydata(), store.fields(2, ["pressure"])["pressure"][:, 3] / 1e9)
    assert film.axes["temperature"].get_xlabel().endswith(" µm, through the largest pressure")


@pytest.mark.slow
def test_a_line_has_no_map_and_a_tall_map_stands_beside_the_lines():
    assert set(frames("furrow-line", None).axes) == {"pressure", "film", "temperature"}
    low, tall = ({name: ax.get_position() for name, ax in frames(built_in, "film").axes.items()}
                 for built_in in ("gear", "ridge-on-ball"))
    assert low["map"].y1 < low["temperature"].y0 and abs(low["map"].x0 - low["film"].x0) < 0.05
    assert tall["map"].x0 > tall["film"].x1


def test_a_gif_has_as_many_frames_as_asked_for_evenly_over_the_passage(tmp_path):
    from PIL import Image

    told = []
    five = store(tmp_path / "a.zarr", 5).path
    path = tehl.animate(five, frames=3, fps=10, progress=lambda *done: told.append(done), **SMALL)
    assert path == tmp_path / "a.gif" and told == [(0, 3), (1, 3), (2, 3), (3, 3)]
    with Image.open(path) as film:
        assert film.n_frames == 3 and film.info["duration"] == 100 and film.info["loop"] == 0
        assert film.size[0] == int(8.5 / INCH * 40) and film.convert("RGB").getpixel((0, 0)) == (255, 255, 255)
    with pytest.raises(StoreError, match="a.gif exists already"):
        tehl.open(five).animate(tmp_path / "a.gif")


def test_what_cannot_be_animated_is_refused_in_a_sentence(tmp_path):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    path, steady = str(store(tmp_path / "a.zarr").path), str(store(tmp_path / "steady.zarr", 1).path)
    for options, said in (([steady], "has only a steady state"), ([path, "--frames", "1"], "frames = 1 is out of"),
                          ([path, "--fps", "60"], "fps = 60"), ([path, "--map", "Fi"], "map = 'Fi' is not known"),
                          ([path, "--map", "temperature"], "is isothermal"), ([path, "--format", "avi"], "format = 'avi'"),
                          ([path, "--out", str(tmp_path)], "is a folder"), ([path, "--out", "a.txt"], "format = 'txt'"),
                          ([path, "--out", "a.gif", "--format", "mp4"], "not end in .mp4"), ([path, "--dpi", "4"], "dpi = 4")):
        found = CliRunner().invoke(app, ["animate", *options]).exception
        assert isinstance(found, (SceneError, StoreError)) and found.exit_code == 2 and said in str(found)
    assert not list(tmp_path.glob("*.gif*"))


def test_a_film_is_replaced_only_when_asked_and_never_left_half(tmp_path):
    path = store(tmp_path / "a.zarr").path
    other = tehl.animate(path, **SMALL).read_bytes()

    def stop(done, total):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(StoreError, match="a.gif exists already; choose another path, or use force=True"):
        tehl.animate(path, **SMALL)
    with pytest.raises(KeyboardInterrupt):
        tehl.animate(path, force=True, progress=stop, **SMALL)
    assert {p.name for p in tmp_path.iterdir()} == {"a.zarr", "a.gif"} and (tmp_path / "a.gif").read_bytes() == other
    assert tehl.animate(path, force=True, **SMALL).read_bytes()[:6] == b"GIF89a"


def test_mp4_needs_ffmpeg(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(StoreError, match="MP4 needs the program ffmpeg"):
        tehl.animate(store(tmp_path / "a.zarr").path, format="mp4", **SMALL)


def program(folder, text):
    """A program named ffmpeg, first on the path."""
    (folder / "ffmpeg").write_text(f"#!/bin/sh\n{text}\n")
    (folder / "ffmpeg").chmod(stat.S_IRWXU)
    return f"{folder}{os.pathsep}{os.environ['PATH']}"


def test_every_picture_goes_to_ffmpeg(tmp_path, monkeypatch):
    (tmp_path / "bin").mkdir()
    monkeypatch.setenv("PATH", program(tmp_path / "bin", f'echo "$@" > {tmp_path}/told; eval "cat > \\${{$#}}"'))
    path = tehl.animate(store(tmp_path / "a.zarr").path, tmp_path / "film.mp4", **SMALL)
    told = (tmp_path / "told").read_text().split()
    columns, rows = map(int, told[told.index("-s") + 1].split("x"))
    assert columns == int(8.5 / INCH * 40) and path.stat().st_size == 3 * rows * columns * 3
    picture = np.frombuffer(path.read_bytes(), np.uint8).reshape(3, rows, columns, 3)
    assert (picture[0] != picture[2]).any() and (picture[:, 0, 0] == 255).all()


def test_what_ffmpeg_complains_of_is_told(tmp_path, monkeypatch):
    path = store(tmp_path / "a.zarr").path
    monkeypatch.setenv("PATH", program(tmp_path, 'echo "no such codec" >&2; exit 3'))
    with pytest.raises(StoreError, match="ffmpeg failed: no such codec"):
        tehl.animate(path, tmp_path / "film.mp4", **SMALL)
    assert not list(tmp_path.glob("film*"))
