"""What a terminal shows of a run: curves of braille letters, how often they are drawn, and where they are not."""

import io
import re
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console
from tehl_cli import live_display
from tehl_cli.live_curves import ROWS, Curves, braille, shown_row

from tehl_taichi.runs.progress import ERRORS, FATIGUE, PASSAGE, STEADY


def dots(lines):
    """The lit dots of lines of braille letters, (4 rows, 2 width), by the table of Unicode."""
    bits = ((0, 3), (1, 4), (2, 5), (6, 7))
    out = np.zeros((4 * len(lines), 2 * len(lines[0])), bool)
    for j, line in enumerate(lines):
        for i, letter in enumerate(line):
            for row, pair in enumerate(bits):
                for column, bit in enumerate(pair):
                    out[4 * j + row, 2 * i + column] = (ord(letter) - 0x2800) >> bit & 1
    return out


def test_a_straight_line_is_a_diagonal():
    found = dots(braille(np.linspace(0.0, 1.0, 9), 4, 2, 0.0, 1.0))
    assert np.array_equal(found.argmax(axis=0), [6, 5, 4, 3, 3, 2, 1, 0])  # highest dot of each column
    assert found[-1, 0] and found.sum() <= 16


def test_one_node_is_enough_to_be_seen_and_what_is_beyond_is_not_drawn():
    values = np.zeros(513)
    values[300] = 1.0
    found = dots(braille(values, 10, 3, 0.0, 1.0))
    assert found[0].sum() == 1 and found[0, 300 * 20 // 512] and found[:, 300 * 20 // 512].all()
    assert not dots(braille(values + 5.0, 10, 3, 0.0, 1.0)).any()


def snapshot(step=1, thermal=True):
    """Half an ellipse of pressure over 1 mm in a domain of 4 mm; the feature in the middle."""
    x, y = np.linspace(-2e-3, 2e-3, 81), np.array([-1e-3, 0.0, 1e-3])
    p = 2e9 * np.sqrt(np.maximum(1 - (x / 0.5e-3) ** 2, 0))
    rows = [0 * p, p, 0 * p]
    fields = {"pressure": np.stack(rows, 1), "film": np.stack([0.4e-6 + 0 * p] * 3, 1)}
    if thermal:
        fields["temperature_mid"] = np.stack([90 + 0 * p, 90 + 50 * p / 2e9, 90 + 0 * p], 1)
    scalars = {"h_c_m": 0.4e-6, "p_max_Pa": 2e9, "h_min_m": 0.4e-6, "residual": 1e-9, "cycles": 7}
    return SimpleNamespace(step=step, x=x, y=y, feature_x=0.0, fields=fields, scalars=scalars)


def shown(width=100, height=30, encoding="utf-8", **options):
    """The lines that a terminal shows of curves."""
    curves, file = Curves(), io.TextIOWrapper(io.BytesIO(), encoding)
    curves.take(snapshot(**options))
    console = Console(file=file, force_terminal=True, width=width, height=height, color_system=None, legacy_windows=False)
    console.print(curves)
    file.seek(0)
    return file.read().splitlines()


def test_curves_name_their_axes_and_the_place_of_the_feature():
    lines = shown()
    assert len(lines) == ROWS + 3
    assert [text.strip() for text in lines[0].split("  ") if text.strip()] == [
        "pressure 0 to 2 GPa", "film 0 to 1 µm", "mid-film 90 to 140 °C"]
    axis, ends = lines[-2][:30].rstrip(), lines[-1][:31].rstrip()
    assert axis.index("▲") == pytest.approx(len(axis) / 2, abs=1)
    assert ends.startswith("-0.75") and ends.endswith("+0.75")  # the contact and 0.3 of its width on both sides


@pytest.mark.parametrize("place", [0.0, 0.1, 0.37, 0.63, 0.9, 0.99, 1.0])
def test_the_feature_is_marked_in_the_letter_nearest_to_it(place):
    """Letters have equal widths; the curve above has its spike in the same letter."""
    curves, one, width = Curves(), snapshot(), 41
    curves.take(one)
    curves.feature = curves.x[0] + place * np.ptp(curves.x)
    mark = curves._foot(width).index("▲")
    assert abs(mark + 0.5 - place * width) <= 0.5 + 1e-9
    spike = np.eye(1, 1001, round(place * 1000))[0]
    (line,) = braille(spike, width, 1, 0.0, 1.0)
    assert ord(line[mark]) & 0b1001, "a dot of the upper row"


def test_whole_domains_are_drawn_through_their_largest_pressure():
    half, whole = snapshot(), snapshot()
    half.y = np.array([0.0, 1e-3, 2e-3])
    whole.fields["pressure"] = np.roll(whole.fields["pressure"], 1, axis=1)
    assert (shown_row(half), shown_row(snapshot()), shown_row(whole)) == (0, 1, 2)


def test_no_more_curves_than_there_is_room_for():
    assert "mid-film" not in shown(width=70)[0] and "film" in shown(width=70)[0]
    assert len(shown(thermal=False)[0].split(" to ")) == 3
    assert shown(width=20) == shown(height=10) == shown(encoding="ascii") == []
    assert all(len(line) <= 70 for line in shown(width=70))


class Terminal(io.StringIO):
    encoding = "utf-8"

    def isatty(self):
        return True


@pytest.fixture
def terminal(monkeypatch):
    """Called by a test: stdout and stderr become terminals of 100 x 30, or what it gives; returns stderr."""

    def put(stdout=None, stderr=None):
        for name, value in (("COLUMNS", "100"), ("LINES", "30"), ("TERM", "xterm")):
            monkeypatch.setenv(name, value)
        monkeypatch.setattr(sys, "stdout", stdout or Terminal())
        monkeypatch.setattr(sys, "stderr", stderr or Terminal())
        return sys.stderr

    return put


def passed(stderr, steps=1, **options):
    """What stderr has before and after the end of a passage of so many steps."""
    with live_display.Live(**options) as shows:
        shows.stage(PASSAGE, 0, 1000)
        for step in range(1, steps + 1):
            shows.stage(PASSAGE, step, 1000)
            shows.step(snapshot(step))
        before = stderr.getvalue()
    assert shows.bar is None
    return before, stderr.getvalue()[len(before):]


def test_curves_are_drawn_beside_the_bar_and_stay(terminal):
    text, end = passed(terminal())
    assert "pressure 0 to 2 GPa" in text and "▲" in text and "1/1000" in text and "p_max 2.000 GPa" in text
    assert "pressure 0 to 2 GPa" in end and "1/1000" in end


def test_a_status_line_says_what_is_done_before_the_first_step(terminal):
    """From the start: loading, then the steady contact; messages take its place, and nothing of it stays."""
    stderr = terminal()
    with live_display.Live() as shows:
        assert stderr.getvalue().endswith("loading")
        shows.say("left out: half")
        assert stderr.getvalue().endswith("\r\x1b[Kleft out: half\n\r\x1b[Kloading")
        shows.stage(STEADY, 0, 1)
        assert stderr.getvalue().endswith("\r\x1b[Ksteady contact: loading kernels (new ones are compiled), then solving")
        shows.stage(STEADY, 1, 1)
        assert stderr.getvalue().endswith("\r\x1b[K")
    for options, other in (({"quiet": True}, None), ({}, io.StringIO())):
        stderr = terminal(stderr=other)
        with live_display.Live(**options) as shows:
            shows.stage(STEADY, 0, 1)
        assert stderr.getvalue() == ""
    with pytest.raises(ValueError), live_display.Live() as shows:
        stderr = terminal()
        shows.status.on = True
        raise ValueError
    assert stderr.getvalue() == "\r\x1b[K"


def test_drawing_takes_half_a_percent_at_most(terminal, monkeypatch):
    """Steps of 10 ms that draw nothing; a picture takes 1 ms, then 20 ms."""
    now, pictures = [0.0], []
    terminal()
    monkeypatch.setattr(live_display.time, "perf_counter", lambda: now[0])
    for cost, wait in ((1e-3, 0.5), (20e-3, 4.0)):
        pictures.clear()

        def draw(self, snapshot, cost=cost):
            pictures.append(now[0])
            now[0] += cost

        monkeypatch.setattr(live_display.Live, "_draw", draw)
        with live_display.Live() as shows:
            shows.stage(PASSAGE, 0, 10**6)
            for step in range(1, 1001):
                now[0] += 10e-3
                shows.step(snapshot(step))
        gaps = np.diff(pictures)
        assert 1 < len(gaps) and gaps.min() >= wait + cost - 1e-9 and gaps.max() < wait + cost + 11e-3


def test_a_bar_alone_without_curves_and_lines_without_a_terminal(terminal, monkeypatch):
    for options, stdout in (({"curves": False}, None), ({}, io.StringIO())):  # the latter as in `--json | jq`
        text = "".join(passed(terminal(stdout), **options))
        assert "1/1000" in text and "pressure" not in text and "▲" not in text
    monkeypatch.setattr(live_display.Live, "EVERY", -1.0)
    text = passed(terminal(stderr=io.StringIO()), 2)[0]
    assert text.splitlines()[0].startswith("step 1/1000  p_max 2.000 GPa") and "\x1b" not in text
    assert passed(terminal(), quiet=True) == ("", "")


@pytest.mark.parametrize("name", [FATIGUE, ERRORS])
def test_what_comes_after_the_passage_has_a_bar_too(terminal, monkeypatch, name):
    stderr, ends = terminal(), []
    with live_display.Live() as shows:
        shows.stage(PASSAGE, 999, 1000)
        shows.stage(PASSAGE, 1000, 1000)
        shows.step(snapshot(1000))
        steps = shows.bar
        monkeypatch.setattr(steps, "stop", lambda: ends.append(name))
        before = len(stderr.getvalue())
        for done in range(401):
            shows.stage(name, done, 400)
        assert ends == [name] and shows.bar not in (None, steps)
    text = re.sub(r"\x1b\[[0-9;]*m", "", stderr.getvalue()[before:])
    assert f"{name}   0/400" in text and f"{name} 400/400" in text and "pressure" not in text
    assert text.count("/400") <= 4 and shows.bar is None  # not a picture of every part


def test_what_comes_after_the_passage_has_lines_without_a_terminal(terminal, monkeypatch):
    """Every five seconds, with the time left; a part takes one, companions tell nothing but that they are waited for."""
    now = [0.0]
    monkeypatch.setattr(live_display.time, "perf_counter", lambda: now[0])
    lines = [f"{FATIGUE}: 36%, about 9 s left", f"{FATIGUE}: 79%, about 3 s left", f"{ERRORS}: 0%"]
    for quiet, expected in ((False, lines), (True, [])):
        stderr = terminal(stderr=io.StringIO())
        with live_display.Live(quiet) as shows:
            for part in (*((FATIGUE, n, 14) for n in range(15)), *[(ERRORS, 0, 1)] * 3):
                now[0] += 1.0
                shows.stage(*part)
        assert stderr.getvalue().splitlines() == expected
    with live_display.Live() as shows:
        shows.stage(ERRORS, 0, 0)  # all of them are refused
        shows.stage(STEADY, 0, 1)
        assert shows.bar is None


def test_commands_that_run_can_do_without_curves(monkeypatch, tmp_path):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    import tehl_taichi as tehl

    seen = []
    monkeypatch.setattr(tehl, "run", lambda *words, progress, **more: seen.append(progress.shows_curves) or sys.exit(0))
    made = live_display.Live.__init__
    for more in ([], ["--no-live"]):
        monkeypatch.setattr(live_display.Live, "__init__", lambda self, quiet, curves: made(self, quiet, curves) or setattr(
            self, "shows_curves", curves))
        CliRunner().invoke(app, ["run", "smooth-line", *more])
    assert seen == [True, False]
