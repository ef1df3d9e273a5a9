"""Scene files for scans, as `tehl new --scan` writes them."""

import numpy as np
import pytest
from commands import here as tehl

from tehl_taichi.scene import SceneError, scan_scene, scene_file
from tehl_taichi.scene.feature import Feature

HEADER = 'Instrument;"50x"\x07\nAbstand x [um];1,8\n\n'


@pytest.fixture
def scan(tmp_path):
    y, x = np.mgrid[-10:11, -20:21] * 2.0
    heights = 1.5 * np.exp(-(x**2 + y**2) / 200) + 1e-3 * x
    rows = "\n".join(";".join(f"{h:.4f}".replace(".", ",") for h in row) for row in heights)
    (tmp_path / "scans").mkdir()
    path = tmp_path / "scans" / "a.csv"
    path.write_text(HEADER + rows, encoding="utf-8")
    return path


def test_a_scene_for_a_scan(scan, tmp_path):
    file = tmp_path / "mine.toml"
    read, missing, refused = scan_scene.new(file, "gear", scan, "um", 8e-6, 10e-6)
    assert read == "21 rows of 41 points, 2 header lines skipped" and missing == [] and refused == ""
    text = file.read_text(encoding="utf-8")
    assert '#   its header: Instrument;"50x" \n#   its header: Abstand x [um];1,8\nunit' in text
    found, gear = scene_file.load(file), scene_file.scene("gear")
    feature, = found.features
    assert feature.heights.shape == (21, 41) and feature.steps == (8e-6, 10e-6) and feature.level == "form"
    assert feature.taper == pytest.approx(25e-6)  # an eighth of 200 um
    assert found.contact == gear.contact and found.operation.srr == pytest.approx(gear.operation.srr)
    assert found.operation.u_m == pytest.approx(gear.operation.u_m) and found.oil == gear.oil
    assert found.fatigue.torsion_limit == 380e6 and found.fatigue.endurance == pytest.approx(380e6 * np.sqrt(1.09))


@pytest.mark.parametrize("between, taper", [(0.4, 6e-6), (16.0, 40e-6)])
def test_its_rim_is_that_of_the_distances_in_the_file(tmp_path, between, taper):
    """121 rows, whose distance stands in the file alone; points of a row are 8 um apart."""
    heights = 1e-3 * np.random.default_rng(3).normal(size=(121, 61)).cumsum(axis=1)
    rows = "\n".join(",".join(f"{h:.5f}" for h in row) for row in heights)
    (tmp_path / "a.csv").write_text(f"# x pixel size: 8 um\n# y pixel size: {between:g} um\n# Value units: um\n{rows}")
    assert scan_scene.new(tmp_path / "mine.toml", "gear", tmp_path / "a.csv")[1:] == ([], "")
    for f in (*scene_file.load(tmp_path / "mine.toml").features, Feature(**scan_scene.scan_keys(tmp_path / "a.csv"))):
        assert f.steps == pytest.approx((8e-6, between * 1e-6)) and f.taper == pytest.approx(taper)


def test_its_oil_needs_no_more_than_numbers(scan, tmp_path):
    file = tmp_path / "mine.toml"
    scan_scene.new(file, "gear", scan, "um", 8e-6)
    lines = file.read_text(encoding="utf-8").splitlines()
    first = next(n for n, line in enumerate(lines) if line.startswith("# [oil]"))
    lines[first : first + 6] = [line.removeprefix("# ") for line in lines[first : first + 6]]
    file.write_text("\n".join(lines), encoding="utf-8")
    found = scene_file.load(file)
    assert (found.oil.name, found.oil.nu_40, found.oil.rho_15) == ("our gear oil", 220e-6, 890)
    assert found.features[0].steps == (8e-6, 8e-6)


def test_a_ball_has_both_radii(scan, tmp_path):
    file = tmp_path / "mine.toml"
    scan_scene.new(file, "ridge-on-ball", scan, "nm", 2e-6)
    found, ball = scene_file.load(file), scene_file.scene("ridge-on-ball")
    assert found.contact.radius_y == ball.contact.radius_y and found.load == ball.load
    assert found.body_b == ball.body_b and found.body_b.E < 100e9  # the disc stays glass
    assert found.body_a.material == "100Cr6"


def test_what_is_not_given_is_asked_for(scan, tmp_path):
    file = tmp_path / "mine.toml"
    assert scan_scene.new(file, "gear", scan)[1] == ["unit", "pixel"]
    with pytest.raises(SceneError, match="feature.unit is missing"):
        scene_file.load(file)


@pytest.mark.parametrize("words, said", [
    (("--scan", "none.csv"), "'none.csv' does not exist"),
    (("--scan", "scans/a.csv", "--unit", "um", "--pixel", "1.8"), "did you mean 1.8e-6 m"),
    (("--scan", "scans/a.csv", "--unit", "inch", "--pixel", "1e-6"), "inch"),
    (("--unit", "um"), "--unit um has no effect without a scan"), (("--pixel-y", "1e-6"), "--pixel-y 1e-06 has no effect")])
def test_nothing_is_written_of_what_is_refused(scan, tmp_path, words, said):
    done = tehl("new", "mine.toml", *words, cwd=tmp_path)
    assert done.returncode == 2 and said in done.stderr and not (tmp_path / "mine.toml").exists()


def test_a_scan_that_does_not_fit_the_contact_of_the_base(tmp_path):
    """The file is written: radii and load are those of the user."""
    y, x = np.mgrid[-40:41, -60:61] * 4.0
    np.savetxt(tmp_path / "high.csv", 60 * np.exp(-(x**2 + y**2) / 1e4), delimiter=",")
    missing, refused = scan_scene.new(tmp_path / "mine.toml", "gear", tmp_path / "high.csv", "um", 8e-6)[1:]
    assert missing == [] and "smaller than the height of a feature" in refused and (tmp_path / "mine.toml").exists()


def test_the_command_says_what_is_left_to_do(scan, tmp_path):
    done = tehl("new", "mine.toml", "--scan", "scans/a.csv", "--unit", "um", cwd=tmp_path)
    assert done.returncode == 0 and "fill in feature.pixel and enter the values of your contact" in done.stdout
    assert 'file = "scans/a.csv"' in (tmp_path / "mine.toml").read_text(encoding="utf-8")
    again = tehl("new", "mine.toml", "--scan", "scans/a.csv", cwd=tmp_path)
    assert again.returncode == 2 and "exists already" in again.stderr
