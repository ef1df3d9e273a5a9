"""The same scene in other units of length and time, seen in a mirror, on cells of another shape: the same answer."""

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment

pytestmark = pytest.mark.usefixtures("taichi_cpu")
SMALL = {"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 12, "fatigue.depths": ()}


def passage(scene):
    """The snapshots of a passage."""
    return list(tehl.march(scene))


def enlarged(scene, by):
    """The scene with every length and speed so many times as large: the pressures stay."""
    f = scene.features[0]
    return scene.replace(speed=by * scene.operation.u_m, **{
        "contact.radius_x": by * scene.contact.radius_x, "contact.load": by * scene.contact.load,
        **{f"feature.{key}": by * getattr(f, key) for key in ("height", "width", "x", "y")}})


@pytest.mark.parametrize("y", [0.0, 4e-5])
def test_lengths_and_speeds_twice_as_large_change_no_pressure(y):
    """Also beside the axis, where the whole domain is computed; films and places are twice as large, times as long."""
    scene = tehl.scene("gear").replace(srr=-0.3, **{**SMALL, "feature.y": y, "feature.x": 3e-5})
    one, two = passage(scene), passage(enlarged(scene, 2.0))
    assert len(one) == len(two) == 13
    for a, b in zip(one[::4], two[::4]):
        assert b.time == pytest.approx(a.time, rel=1e-9) and b.feature_x == pytest.approx(2 * a.feature_x, rel=1e-9)
        np.testing.assert_allclose(b.fields["pressure"], a.fields["pressure"], atol=2e-5 * a.scalars["p_max_Pa"])
        assert b.scalars["h_min_m"] == pytest.approx(2 * a.scalars["h_min_m"], rel=1e-4)
        assert b.scalars["friction_coefficient"] == pytest.approx(a.scalars["friction_coefficient"], rel=1e-4)
    own, large = (assessment.run(s, shots).summary for s, shots in ((scene, one), (enlarged(scene, 2.0), two)))
    assert large["Fi_max"] == pytest.approx(own["Fi_max"], rel=1e-4)
    assert large["x_m"] == pytest.approx(2 * own["x_m"], abs=1e-7) and large["y_m"] == pytest.approx(2 * own["y_m"], abs=1e-7)


def slower(scene, by):
    """Lengths so many times as large, speeds as many times as slow in oil of the square of it the viscosity: Péclet numbers,
    pressures, shear stresses and temperatures stay, times are squared.
    """
    wide = enlarged(scene, by)
    return wide.replace(speed=scene.operation.u_m / by, **{"oil.eta0": by**2 * scene.oil.eta0,
                                                           "fatigue.length": by * scene.fatigue.length})


def test_lengths_twice_as_large_at_half_the_speed_change_no_temperature():
    """With different bodies, thermal stress and stressed sizes."""
    scene = tehl.scene("gear").replace(srr=-0.3, **{
        **SMALL, "thermal.on": True, "feature.shape": "ridge", "height": 5e-7, "oil.viscosity": "barus", "oil.alpha": 1.2e-8,
        "oil.beta_eta": 0.03, "oil.Gamma0": 60.0, "bodies.a.k": 20.0, "bodies.b.E": 300e9, "fatigue.depths": "auto",
        "fatigue.weibull": 9.0, "fatigue.length": 0.0})
    one, two = passage(scene), passage(slower(scene, 2.0))
    for a, b in zip(one[::4], two[::4], strict=True):
        assert b.time == pytest.approx(4 * a.time, rel=1e-9)
        for name in ("pressure", "traction_x_a", "traction_x_b", "temperature_a", "temperature_b"):
            scale = np.abs(a.fields[name]).max()
            np.testing.assert_allclose(b.fields[name], a.fields[name], atol=1e-4 * scale, err_msg=name)
        assert b.scalars["h_min_m"] == pytest.approx(2 * a.scalars["h_min_m"], rel=1e-4)
    own, large = (assessment.run(s, shots).summary for s, shots in ((scene, one), (slower(scene, 2.0), two)))
    for part, other in ((own, large), (own["below"], large["below"]), (own["contact_alone"], large["contact_alone"])):
        assert other["Fi_max"] == pytest.approx(part["Fi_max"], rel=1e-4)
    assert large["below"]["depth_m"] == pytest.approx(2 * own["below"]["depth_m"], rel=1e-3)
    assert large["stressed"]["area_m2"] == pytest.approx(2 * own["stressed"]["area_m2"], rel=2e-3)  # per metre across


def test_a_passage_in_the_mirror():
    """Both sides of a whole domain are mirrors, as the side of a half domain is."""
    scene = tehl.scene("gear").replace(srr=-0.3, **{**SMALL, "feature.y": 6e-5, "time.steps": 16})
    one, other = passage(scene)[-1], passage(scene.replace(**{"feature.y": -6e-5}))[-1]
    for name in ("pressure", "film", "traction_x_a", "traction_x_b"):
        scale = np.abs(one.fields[name]).max()
        np.testing.assert_allclose(one.fields[name], other.fields[name][:, ::-1], atol=2e-4 * scale, err_msg=name)
    np.testing.assert_allclose(one.fields["traction_y_a"], -other.fields["traction_y_a"][:, ::-1],
                               atol=2e-4 * np.abs(one.fields["traction_x_a"]).max())


@pytest.mark.parametrize("nx, ny", [(128, 16), (64, 64)])
def test_cells_of_another_shape_have_the_same_film(nx, ny):
    """A steady circle on cells four times as long across, and half as long along, against others: within what grids differ."""
    ball = tehl.scene("ball-on-disc").replace(**{"thermal.on": False, "fatigue.on": False})
    square, other = (passage(ball.replace(**{"grid.nx": x, "grid.ny": y, "time.steady_only": True}))[0] for x, y in
                     ((128, 64), (nx, ny)))
    for name, rel in (("h_c_m", 0.04), ("p_max_Pa", 0.04), ("h_min_m", 0.12)):
        assert other.scalars[name] == pytest.approx(square.scalars[name], rel=rel), name
