"""Features and the gap at the ends of the grid."""

import math
import re

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.errors import NotConverged, typed_options
from tehl_taichi.scene import SceneError, hertz
from tehl_taichi.scene.scales import Scales

# of FZG type C near its point E, on the grid of the gear: the undeformed gap has room, that beside the contact has not
TIGHT = {"contact.radius_x": 7.6645e-3, "contact.load": 186583.0, "speed": 0.5, "srr": 1.0273, "grid.nx": 64, "grid.ny": 16,
         "thermal.on": False}


def test_the_gap_beside_a_ball():
    """By the deflection of a Hertz pressure, summed up over rings of its circle at X = 2."""
    r = (np.arange(2000) + 0.5) / 2000
    phi = (np.arange(2000) + 0.5) / 2000 * math.pi
    distance = np.sqrt(4 + r[:, None] ** 2 - 4 * r[:, None] * np.cos(phi))
    pressure = np.sqrt(1 - r**2) * r
    bent = 2 / math.pi**2 * 2 * (pressure[:, None] / distance).sum() * (1 / 2000) * (math.pi / 2000)
    assert hertz.point_gap(2.0) == pytest.approx(2.0 - 1.0 + bent, rel=1e-5)
    assert hertz.point_gap(1.0) == pytest.approx(0.0, abs=1e-15)


def test_gap_reaches():
    for gap in (hertz.line_gap, hertz.point_gap):
        assert gap(hertz.gap_reaches(1.3, gap)) == pytest.approx(1.3)
    assert hertz.gap_reaches(1e9) == pytest.approx(10.0)


def settled(said):
    """The changes that the options of a sentence make."""
    from tehl_cli.scene_options import changes_of

    grid = re.search(r"--grid (\S+)", said)
    return changes_of({}, grid and grid[1], re.findall(r"--set (\S+)", said))


def test_a_feature_that_may_find_no_room_is_doubted():
    tight = tehl.scene("gear").replace(**TIGHT)
    [said] = [sentence for sentence in tight.typed_warnings if "grid.x_max" in sentence]
    assert "1.5e-06 m passes grid.x_max = 1.5 a, where the dry gap is" in said
    assert not any("grid.x_max" in sentence for sentence in tight.replace(**settled(said)).warnings())
    assert not any("grid.x_max" in sentence for sentence in tehl.scene("gear").warnings())


def test_surfaces_that_cross_at_the_border_end_the_run(taichi_cpu):
    tight, films = tehl.scene("gear").replace(**{**TIGHT, "time.x_start": -2.4}), []
    with pytest.raises(NotConverged, match=r"the surfaces cross at the border of the grid, a film of -\d.* m at X = 1.50"):
        for shot in tehl.march(tight):
            films.append(shot.fields["film"].min())
    assert min(films) > 0 and len(films) > 20


WIDE = {"shape": "rough", "height": 1.5e-6, "width": 120e-6, "extent_x": 400e-6, "extent_y": 900e-6, "taper": 40e-6}


@pytest.mark.slow
def test_one_sentence_settles_ends_and_sides_at_once(taichi_cpu):
    """A wide, high patch under a small load; with the options of the sentence nothing is said of the domain, and it runs."""
    small = {"grid.nx": 64, "grid.ny": 16, "load": 300e3, "thermal.on": False}
    tight = tehl.scene("gear").replace(feature=[WIDE], **small)
    said, = (sentence for sentence in tight.typed_warnings if sentence.code == "room")
    assert "passes grid.x_max = 1.5 a" in said and "reaches to 0.00045 m along y" in said
    assert "(feature.extent_y = 0.000378 makes the patch smaller)" in said
    changes = settled(said)
    assert {"grid.x_max", "grid.y_max", "grid.ny"} <= changes.keys()
    fitting = tight.replace(**changes)
    assert not any("grid." in sentence and ("passes" in sentence or "cut off" in sentence) for sentence in fitting.warnings())
    cells = [np.array(s.cell(described.grid)) for described in (tight, fitting) for s in [Scales.of(described)]]
    assert (cells[1] <= 1.05 * cells[0]).all()
    assert next(tehl.march(fitting)).y[-1] >= 450e-6


def test_a_refused_feature_is_told_the_whole_domain():
    """Not x_min first, then x_max, then y_max, then the cells."""
    high = {**WIDE, "height": 8e-6}
    with typed_options(), pytest.raises(SceneError, match="undeformed gap") as refused:
        tehl.scene("gear").replace(feature=[high], load=300e3, **{"grid.x_min": -2.5})  # auto begins farther
    changes = settled(str(refused.value))
    assert changes.keys() == {"grid.x_min", "grid.x_max", "grid.y_max", "grid.nx", "grid.ny"}
    fitting = tehl.scene("gear").replace(feature=[high], load=300e3, **changes)
    assert not any(sentence.code == "room" for sentence in fitting.warnings())


def test_where_no_domain_has_room_none_is_named():
    with pytest.raises(SceneError, match="more load") as refused:
        tehl.scene("gear").replace(load=1e3)
    assert "wider domain" not in str(refused.value) and "--set" not in str(refused.value)
