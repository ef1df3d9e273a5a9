"""Features and the gap at the ends of the grid."""

import math

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.errors import NotConverged
from tehl_taichi.scene import hertz

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


def test_a_feature_that_may_find_no_room_is_doubted():
    tight = tehl.scene("gear").replace(**TIGHT)
    [said] = [sentence for sentence in tight.warnings() if "grid.x_max" in sentence]
    assert "1.5e-06 m passes grid.x_max = 1.5 a, where the dry contact leaves" in said
    farther = float(said.split("grid.x_max = ")[-1].split()[0])
    assert not any("grid.x_max" in sentence for sentence in tight.replace(**{"grid.x_max": farther}).warnings())
    assert not any("grid.x_max" in sentence for sentence in tehl.scene("gear").warnings())


def test_surfaces_that_cross_at_the_border_end_the_run(taichi_cpu):
    tight, films = tehl.scene("gear").replace(**{**TIGHT, "time.x_start": -2.4}), []
    with pytest.raises(NotConverged, match=r"the surfaces cross at the border of the grid, a film of -\d.* m at X = 1.50"):
        for shot in tehl.march(tight):
            films.append(shot.fields["film"].min())
    assert min(films) > 0 and len(films) > 20
