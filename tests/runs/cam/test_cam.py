"""A cam: its table, its scenes, files, figure and page, and a cycle that is computed."""

import dataclasses
import json
import math

import numpy as np
import pytest
from commands import here
from fake_cases import position

import tehl_taichi as tehl
from tehl_taichi.disk.locked_folder import only_writer
from tehl_taichi.disk.locks import Busy
from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.report import cam_page, place_page
from tehl_taichi.runs.cam import cam_columns, cam_figure, cam_table
from tehl_taichi.runs.open_results import kind
from tehl_taichi.runs.sweep import case
from tehl_taichi.scene.feature import SHAPES
from tehl_taichi.view.figures.figure_style import FigureStyle

HEAD = "angle_deg, load_N_per_mm, R_a_mm, R_b_mm, u_a_m_s, u_b_m_s, note\n"
ROWS = "20, 100, 20, inf, 3.0, 1.0, right\n-20, 80, 12, 12, -1.5, -0.5, left\n0, 120, 18, inf, 2.0, -2.0, top\n" \
       "40, 0, 18, inf, 2.0, 1.0, \n60, 50, 18, inf, 2.0, -1.0, \n"


def table(folder, rows=ROWS, head=HEAD):
    path = folder / "cam.csv"
    path.write_text(head + rows)
    return path


@pytest.fixture(scope="module")
def cycle(tmp_path_factory):
    """A cam of five angles, two of which have a film, with made-up results."""
    folder = tmp_path_factory.mktemp("cam")

    def work(job, *_):
        made = position(job)
        steady = {"h_c_m": 2e-7, "h_min_m": 1e-5 * job.scene.contact.radius_x, "error": {"h_min_m": 1e-9}}
        return {**made, "summary": {"steady": steady, "version": "0.9", "wall_s": 2.0, "warnings": ["thick film"]}}

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(case, "run_case", work)
        return tehl.cam(table(folder), folder=folder / "c", changes={"oil.name": "mineral-vg100"}, workers=1)


def test_angles_are_contacts_in_si_and_by_angle(tmp_path):
    found = cam_table.load(table(tmp_path))
    assert [at.angle for at in found] == [-20, 0, 20, 40, 60]
    left, top, right = found[:3]
    assert (left.R, right.R) == pytest.approx((6e-3, 20e-3)) and right.load == 1e5 and right.more["note"] == "right"
    assert (right.u_m, right.srr) == (2.0, 1.0) and (left.u_m, left.srr) == (1.0, 1.0), "the mirror image has its slip"
    assert top.u_m == 0 and math.isinf(top.srr)
    reduced = cam_table.load(table(tmp_path, "0,100,6,1,1\n", "angle_deg,load_N_per_mm,R_mm,u_a_m_s,u_b_m_s\n"))
    assert reduced[0].R == pytest.approx(left.R) and reduced[0].srr == 0


def test_angles_without_a_film_say_why(cycle):
    assert [(at.angle, reason.partition(":")[0].partition(" (")[0]) for at, reason in cycle.failed] == [
        (0, "entrainment speed 0 m/s"), (40, "no load"), (60, "the surfaces move against each other")]
    assert cycle.not_converged == [] and [at.angle for at, _, summary in cycle.rows if summary] == [-20, 20]


def test_scenes_have_the_contact_of_the_angle(cycle):
    for (at, p_H, summary), one in zip(cycle.rows, cycle.record["positions"]):
        if summary:
            assert p_H == pytest.approx(math.sqrt(at.load * 206e9 / 0.91 / (2 * math.pi * at.R)))
            assert one["u_a_m_s"] == at.u_a and one["srr"] == pytest.approx(at.srr) and one["note"] == at.more["note"]


def test_a_cam_opens_again(cycle):
    again = tehl.open(cycle.folder)
    assert kind(cycle.folder) == "cam" and again.record == cycle.record == json.loads((cycle.folder / "cam.json").read_text())
    (heads, lines) = cam_columns.tables(again.rows)["steady film"]
    assert heads[0] == "angle deg" and lines[0][:3] == ["-20.00", "0.200 ± ?", "0.0600 ± 0.0010"]
    assert (cycle.folder / "cam.csv").read_text().splitlines()[0].endswith("error_steady_h_min_m,note")


def test_figure_and_page_follow_the_angle(cycle):
    pytest.importorskip("matplotlib")
    axes = cam_figure.drawn(FigureStyle(), cycle).axes
    x, y = axes[0].containers[1].lines[0].get_data()
    assert list(x) == [-20, 0, 20, 40, 60] and np.isnan(y[1]) and y[2] == pytest.approx(0.2)
    page = cam_page.of(cycle.folder)
    assert page.answer.headline == "The smallest film is 0.0600 ± 0.0010 µm, at -20 deg."
    assert page.answer.doubts[0].startswith("3 of 5 angles have no result") and "cam-0" in page.figures
    assert place_page.warnings(cycle) == ["-20 deg, 20 deg: thick film"]
    assert page.answer.doubts[2:] == ("Number of warnings, listed below: 1.",)
    drawn = [line.lines[0].get_data() for line in axes[0].containers]
    for (x, y), trace in zip(drawn, page.figures["cam-0"].traces, strict=True):
        assert list(x) == list(trace["x"]) and list(y) == pytest.approx(
            [np.nan if value is None else value for value in trace["y"]], nan_ok=True)


@pytest.mark.parametrize("head, rows, said", [
    (HEAD.replace("load_N_per_mm", "load_N_mm"), ROWS, "no column load_N_per_mm .did you mean .load_N_mm...; needed: angle"),
    (HEAD, "0, x, 18, inf, 1, 1,\n", "row 2: load_N_per_mm = 'x' is not a number; allowed: 0 to 100000 N/mm"),
    (HEAD, "0, 100, 18, inf, 1, 1\n", "row 2 has 6 columns; allowed: 7, as in the line of names"),
    (HEAD, "0, 100, inf, inf, 1, 1,\n", "makes no contact; allowed: one curved surface"),
    (HEAD, "0, 100, -3, inf, 1, 1,\n", "R_a_mm = -3 mm is out of range"), (HEAD, "", "has 0 rows"),
    (HEAD, "0, 0, 18, inf, 1, 1,\n", "no angle has a film; the first one: no load"),
    (HEAD.replace("note", "angle_deg"), ROWS, "has the column angle_deg twice"),
    (HEAD.replace("note", "p_Hertz_Pa"), ROWS, "p_Hertz_Pa is a name of the results; rename or remove"),
    (HEAD.replace("note", "error_steady_h_c_m"), ROWS, "error_steady_h_c_m is a name of the results")])
def test_wrong_tables_are_refused_in_a_sentence(tmp_path, head, rows, said):
    with pytest.raises(SceneError, match=said):
        tehl.cam(table(tmp_path, rows, head), folder=tmp_path / "c")
    assert not (tmp_path / "c").exists()


@pytest.mark.parametrize("first, second", [("0", "0.0"), ("20", "2e1"), ("-20", "-20")])
def test_an_angle_has_one_row(tmp_path, first, second):
    rows = [f"{angle}, 100, 20, inf, 3.0, 1.0, \n" for angle in (first, "33", second)]
    with pytest.raises(SceneError, match=f"rows 2 and 4: both have the angle {first} deg; allowed: one row for each angle"):
        cam_table.load(table(tmp_path, "".join(rows)))


@pytest.mark.parametrize("own", ["R_a_mm", "R_b_mm", "R_a_mm, R_b_mm"])
def test_radii_are_of_one_kind(tmp_path, own):
    head = f"angle_deg, load_N_per_mm, R_mm, {own}, u_a_m_s, u_b_m_s\n"
    with pytest.raises(SceneError, match="has the columns R_mm and R_[ab]_mm; allowed: the reduced radius R_mm, or R_a_mm and"):
        cam_table.load(table(tmp_path, "0, 100, 5, " + "12, " * len(own.split(",")) + "2, 1\n", head))


def test_wrong_changes_and_folders_are_refused(tmp_path):
    path = table(tmp_path)
    with pytest.raises(SceneError, match="contact.load has no effect"):
        tehl.cam(path, changes={"load": 1e5}, folder=tmp_path / "c")
    with pytest.raises(StoreError, match="is not the folder of a cam"):
        tehl.cam(path, folder=tmp_path)
    assert "cannot read table" in here("cam", "none.csv", cwd=tmp_path).stderr


@pytest.mark.parametrize("text", ["{", '{"name": 1}', '{"name": "c", "positions": [{"angle_deg": 1}]}'])
def test_a_damaged_folder_is_refused_in_a_sentence(tmp_path, text):
    (tmp_path / "cam.json").write_text(text)
    with pytest.raises(StoreError, match="cam.json is damaged .*; repeat the tehl cam command to write it again"):
        tehl.open(tmp_path)


def test_the_command_again_writes_a_damaged_file_and_more_angles_but_no_other_cam(tmp_path, monkeypatch):
    monkeypatch.setattr(case, "run_case", lambda job, *_: position(job))
    keys = dict(folder=tmp_path / "c", workers=1)
    first = tehl.cam(table(tmp_path), **keys)
    (tmp_path / "c" / "cam.json").write_text('{"name": 1}')
    assert tehl.cam(table(tmp_path), **keys).record == first.record == tehl.open(tmp_path / "c").record
    assert (tmp_path / "c" / "cam.json.damaged-1").read_text() == '{"name": 1}'
    assert len(tehl.cam(table(tmp_path, f"{ROWS}70, 50, 18, inf, 2.0, 1.0, \n"), **keys).rows) == 6
    with pytest.raises(StoreError, match="c holds cam cam with the result of a contact that .* .70 deg, 50000 N/m.; choose"):
        tehl.cam(table(tmp_path), **keys)
    (tmp_path / "other.csv").write_text((tmp_path / "cam.csv").read_text())
    with pytest.raises(StoreError, match="c holds cam cam; choose another path"):
        tehl.cam(tmp_path / "other.csv", **keys)
    assert len(tehl.open(tmp_path / "c").rows) == 6


def test_a_cam_that_was_stopped_in_its_first_angle_is_resumed(tmp_path, cycle):
    """Its folder has a store, or the draft of one and a lock, and no cam.json."""
    (tmp_path / ".cam-01.zarr.part").mkdir()
    (tmp_path / ".lock").touch()
    tehl.Cam.check_writable(tmp_path, cycle)
    (tmp_path / "cam-01.zarr").mkdir()
    (tmp_path / ".cam.json.0123456789abcdef.tmp").touch()
    tehl.Cam.check_writable(tmp_path, cycle)
    (tmp_path / "cam-99.zarr").mkdir()
    with pytest.raises(StoreError, match="is not the folder of a cam"):
        tehl.Cam.check_writable(tmp_path, cycle)


def test_a_cam_has_one_writer_at_a_time(tmp_path, monkeypatch):
    """Both would write the record, the last one without the contacts that the other had."""
    monkeypatch.setattr(case, "run_case", lambda job, *_: position(job))
    with only_writer(tmp_path / "c"), pytest.raises(Busy, match="c is still being written by process .*; wait for it"):
        tehl.cam(table(tmp_path), folder=tmp_path / "c", workers=1)
    assert tehl.cam(table(tmp_path), folder=tmp_path / "c", workers=1).rows and not (tmp_path / "c" / ".lock").exists()


def test_a_cam_that_stores_nothing_leaves_no_folder(tmp_path, monkeypatch):
    from tehl_taichi.runs.flank import outcomes

    def stop(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(outcomes, "summaries", stop)
    with pytest.raises(KeyboardInterrupt):
        tehl.cam(table(tmp_path), folder=tmp_path / "c", workers=1)
    assert [path.name for path in tmp_path.iterdir()] == ["cam.csv"]


@pytest.mark.slow
def test_a_cycle_is_computed(taichi_cpu, tmp_path):
    """The faster, rounder side has the thicker film; a mirrored contact equals its image."""
    rows = "0, 100, 20, inf, 3.0, 1.0, a\n10, 100, 20, inf, -3.0, -1.0, b\n20, 100, 10, inf, 1.5, 0.5, c\n"
    table(tmp_path, rows)
    found = here("cam", "cam.csv", "--grid", "64", "--isothermal", "--workers", 1, "--json", "--quiet", "--no-figure", "--out",
                 "c", cwd=tmp_path)
    assert found.returncode == 0, found.stderr
    first, image, slow = (one["summary"]["steady"] for one in json.loads(found.stdout)["positions"])
    assert first["h_c_m"] == image["h_c_m"] > 1.5 * slow["h_c_m"] and first["friction_coefficient"] > 0


@pytest.mark.parametrize("keys", [{}, {"mirror_x": True}, {"offset_x": 3e-5, "extent_x": 1e-4}])
def test_a_contact_that_moves_backwards_has_the_mirror_image_of_its_feature(keys):
    """A steep and a flat side, whichever way and in part: turned round, and on the other side; shapes that are even along x
    stay as they are."""
    from tehl_taichi.runs.cam.cam_run import _as_it_moves
    from tehl_taichi.runs.cam.cam_table import CamPosition

    wave = 1e-6 * np.exp(-((np.linspace(-1, 1, 60) - 0.3) / 0.2) ** 2)
    tooth = tehl.Feature.from_heights(np.tile(wave, (40, 1)), 5e-6, x=2e-5, level="none", **keys)
    dent = tehl.Feature(height=-1e-6, x=2e-5)
    base = dataclasses.replace(tehl.scene("gear"), features=(tooth, dent))
    ahead, back = (_as_it_moves(base, CamPosition(0.0, 0.02, 1e5, sign * 2.0, sign * 0.8)) for sign in (1, -1))
    assert ahead is base and back.features[1] == dataclasses.replace(dent, x=-2e-5)
    x, y = np.linspace(-2e-4, 2e-4, 81)[None, :], np.linspace(-5e-5, 5e-5, 9)[:, None]
    heights = [sum(f.height_at(side * x - f.x, y) for f in scene.features) for scene, side in ((ahead, 1), (back, -1))]
    np.testing.assert_allclose(heights[0], heights[1], atol=1e-12)
    ahead_of_it, behind_it = (tooth.height_at(side * x, y) for side in (1, -1))
    assert np.abs(ahead_of_it - behind_it).max() > 5e-7 and not [one for one in back.warnings() if "mirror" in one]


@pytest.mark.parametrize("shape", SHAPES)
def test_every_shape_has_a_mirror_image(shape):
    from tehl_taichi.runs.cam.cam_run import _mirrored

    slope = np.linspace(0.0, 1.0, 40)
    heights = tehl.Feature.from_heights(slope if shape == "profile" else np.tile(slope, (40, 1)), 5e-6, unit="um", level="none")
    f = heights if SHAPES[shape].measured else tehl.Feature(**SHAPES[shape].example)
    f = dataclasses.replace(f, x=2e-5)
    x, y = np.linspace(-2e-4, 2e-4, 81)[None, :], np.linspace(-5e-5, 5e-5, 9)[:, None]
    there, image, back = f.height_at(x - f.x, y), _mirrored(f).height_at(-x + f.x, y), _mirrored(_mirrored(f))
    np.testing.assert_allclose(image, there, atol=1e-9 * np.abs(there).max())
    assert _mirrored(f).x == -f.x and back == f and np.abs(there).max() > 0


def test_a_follower_at_rest_has_a_film():
    """Sliding alone, slide-roll ratio 2: the surfaces do not move against each other."""
    at = cam_table.CamPosition(angle=0.0, R=0.02, load=1e5, u_a=2.0, u_b=0.0)
    assert at.srr == 2.0 and at.without_film == ""


def test_a_cam_without_features_gives_the_index_of_its_smooth_contacts(tmp_path, monkeypatch):
    def work(job, *_):
        steady = {"h_c_m": 2e-7, "h_min_m": 1e-7, "error": {"h_min_m": 2e-8}}
        alone = {"a": {"Fi_max": 0.9, "depth_m": 70e-6, "error": {"Fi_max": 0.01}}}
        summary = {"steady": steady, "contact_alone_by_surface": alone, "version": "0.9", "wall_s": 2.0}
        return {**position(job), "summary": summary}

    monkeypatch.setattr(case, "run_case", work)
    answer = cam_page.answer(tehl.cam(table(tmp_path), folder=tmp_path / "c", workers=1))
    assert answer.sentences == ("The smooth contacts alone: Fi = 0.900 ± 0.010 at most, 70 µm below the surface at -20 deg.",)


def test_bars_of_the_figure_are_in_the_unit_of_their_line(tmp_path, monkeypatch):
    """A fifth of every film."""
    def work(job, *_):
        steady = {"h_c_m": 2e-7, "h_min_m": 1e-7, "error": {"h_min_m": 2e-8, "h_c_m": 4e-8}}
        return {**position(job), "summary": {"steady": steady, "version": "0.9", "wall_s": 2.0}}

    monkeypatch.setattr(case, "run_case", work)
    rows = "0, 100, 20, inf, 3.0, 1.0, \n10, 100, 20, inf, 3.0, 1.0, \n"
    axes = cam_figure.drawn(FigureStyle(), tehl.cam(table(tmp_path, rows), folder=tmp_path / "c", workers=1)).axes
    assert len(axes[0].containers) == 2
    for line in axes[0].containers:
        bars = np.array(line.lines[2][0].get_segments())[..., 1]
        assert np.ptp(bars, axis=1) / 2 / line.lines[0].get_ydata() == pytest.approx(0.2)
