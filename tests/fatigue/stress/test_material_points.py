"""Histories of material points and what the fatigue summary says about them, by way of a reader whose fields are formulas."""

import itertools
import math

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment, findley
from tehl_taichi.fatigue.stress import row_histories
from tehl_taichi.fatigue.stress import thermal_stress as ts
from tehl_taichi.fatigue.stress.histories import COMPONENTS, StressHistories, between
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.sections import Body

AHEAD = 0.375  # a: the bump stands ahead of the feature's centre, so that its points are under load before the first entry,
BEHIND = -AHEAD  # or behind it, and they are after the last
FIRST, LAST, CELLS = -1.125, 1.125, 16  # path of the centre in a; cells per a


class Formula:
    """A Hertz line with a pressure bump ahead of the feature (none at the steady entry 0), shear 0.05 p along x."""

    def __init__(self, scene, rows=3, warmth=0.0, place=AHEAD):
        self.place = place
        self.a, self.p_H, self.warmth = Scales.of(scene).a, Scales.of(scene).p_H, warmth
        self.x = np.linspace(-2, 2, 4 * CELLS + 1) * self.a
        self.y = np.linspace(0, 0.5, rows) * self.a
        self.centres = np.linspace(FIRST, LAST, int((LAST - FIRST) * CELLS) + 1) * self.a
        self.time = (self.centres - self.centres[0]) / scene.operation.u_a

    def __len__(self):
        return self.centres.size

    def feature_x(self, n):
        return self.centres[n]

    def pressure(self, n, x):
        """At x (m) at entry n; it grows by a tenth along the passage, so that no two entries are alike."""
        bump = 0.5 * np.exp(-(((x - self.centres[n]) / self.a - self.place) ** 2) / 0.01) if n else 0.0
        return self.p_H * np.sqrt(np.maximum(1 - (x / self.a) ** 2, 0)) * (1 + bump + 0.1 * n / len(self))

    def temperature(self, n, x):
        """Warmer towards the outlet, with a hot spot under the bump."""
        spot = 40 * np.exp(-(((x - self.centres[n]) / self.a - self.place) ** 2) / 0.02) if n else 0.0
        return 90 + self.warmth * (10 * np.exp(-((x / self.a) ** 2) / 0.3) + spot)

    def fields(self, n, names):
        p, wide = self.pressure(n, self.x)[:, None], np.ones((1, self.y.size))
        found = {"pressure": p * wide, "traction_x_a": 0.05 * p * wide, "traction_y_a": 0 * p * wide,
                 "temperature_a": self.temperature(n, self.x)[:, None] * wide}
        found |= {"traction_x_b": -found["traction_x_a"], "traction_y_b": 0 * p * wide, "temperature_b": found["temperature_a"]}
        return {name: found[name] for name in names} if names else found


def gear(**changes):
    return tehl.scene("gear").replace(**{"thermal.on": False, "fatigue.surfaces": "a", **changes})


@pytest.fixture(scope="module", params=[AHEAD, BEHIND], ids=["ahead", "behind"])
def found(taichi_cpu, request):
    reader = Formula(gear(), place=request.param)
    return reader, assessment.run(gear(), reader)


def entry_at(reader, centre):
    """That of the moment; the steady entry 0 before the first and after the last."""
    n = round((centre - reader.centres[0]) / reader.a * CELLS)
    return n if 0 <= n < len(reader) else 0


def test_points_pass_the_steady_contact_before_and_after_the_stored_moments(found):
    """szz = -p and sxz = -q at the place of the point, one cell a moment, from unloaded to unloaded."""
    reader, result = found
    moments, stress = result.worst["x_a"][:-1], result.worst["stress"][:-1]
    assert abs(result.summary["x_m"] / reader.a - reader.place) < 0.3
    np.testing.assert_allclose(np.diff(moments), reader.a / CELLS, rtol=1e-9)
    p = np.array([reader.pressure(entry_at(reader, at), at + result.summary["x_m"]) for at in moments])
    np.testing.assert_allclose(-stress[:, 2], p, rtol=1e-6, atol=1e3)
    np.testing.assert_allclose(-stress[:, 4], 0.05 * p, rtol=1e-6, atol=1e3)
    outside = moments < reader.centres[0] - 1e-9 if reader.place == AHEAD else moments > reader.centres[-1] + 1e-9
    assert p[outside].max() > 0.3 * reader.p_H and p[0] == p[-1] == 0.0


def test_the_last_moment_is_unloaded_but_for_residual_stress(taichi_cpu):
    scene = gear(**{"fatigue.residual_xx": -120e6, "fatigue.residual_yy": 70e6})
    result = assessment.run(scene, Formula(scene))
    sxx, syy, szz = result.worst["stress"][:, :3].T
    np.testing.assert_allclose(result.worst["stress"][-1], (-120e6, 70e6, 0, 0, 0, 0), atol=1e-3)
    np.testing.assert_allclose((syy - 70e6) - 0.3 * (sxx + 120e6 + szz), 0, atol=1e-6 * np.abs(sxx).max())  # plane strain


def test_tension_across_alone_raises_the_findley_stress(taichi_cpu):
    """So does none along x: the two are not exchanged."""
    scene = gear()
    across = assessment.run(gear(**{"fatigue.residual_yy": 600e6}), Formula(scene))
    along = assessment.run(gear(**{"fatigue.residual_xx": 600e6}), Formula(scene))
    n_across, n_along = (abs(r.worst["normal"]) for r in (across, along))
    assert n_across[1] > n_across[0] and n_along[0] > n_along[1]


def test_an_endless_row_is_plane_strain_and_its_heat_presses_along_y(taichi_cpu):
    """Nothing varies along y, so syy = nu (sxx + szz) - E alpha (T - 90) at every moment, whatever the rest does."""
    scene = tehl.scene("gear")
    reader = Formula(scene, warmth=1.0)
    result = assessment.run(scene, reader)
    sxx, syy, szz = result.worst["stress"][:-1, :3].T
    T = np.array([reader.temperature(entry_at(reader, at), at + result.summary["x_m"]) for at in result.worst["x_a"][:-1]])
    inside = np.abs(result.worst["x_a"][:-1] + result.summary["x_m"]) < 1.9 * reader.a
    np.testing.assert_allclose((syy - 0.3 * (sxx + szz))[inside], (-206e9 * 12e-6 * (T - 90))[inside], atol=2e4)
    assert result.summary["thermal_stress"] and T.max() > 120


def smallest_circle(points):
    """(centre, radius) by all pairs and triples of the outermost points."""
    z = points[:, 0] + 1j * points[:, 1]
    out = z[sorted({int(np.argmax((z * np.exp(1j * t)).real)) for t in np.linspace(0, 2 * np.pi, 720)})]
    centres = [(a + b) / 2 for a, b in itertools.combinations(out, 2)]
    for a, b, c in itertools.combinations(out, 3):
        u, v = b - a, c - a
        area = 2 * (u.real * v.imag - u.imag * v.real)
        if abs(area) > 1e-9 * abs(u) * abs(v):
            centres.append(a + 1j * (abs(v) ** 2 * u - abs(u) ** 2 * v) / -area)
    radii = [np.abs(z - c).max() for c in centres]
    best = int(np.argmin(radii))
    return centres[best], radii[best]


def own_path(result):
    """Shear path (times, 2) and normal stress on the critical plane, by tensors in a frame of its own."""
    n = result.worst["normal"]
    xx, yy, zz, xy, xz, yz = result.worst["stress"].T
    tensors = np.moveaxis(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), -1, 0)
    first = np.linalg.svd(n[None])[2][1]
    return np.stack([tensors @ n @ first, tensors @ n @ np.cross(n, first)], axis=1), tensors @ n @ n


def test_the_stress_is_amplitude_plus_kappa_times_normal_stress(found):
    _, result = found
    path, normal = own_path(result)
    radius = smallest_circle(path)[1]
    s = result.summary
    assert s["tau_amp_Pa"] == pytest.approx(radius, rel=1e-6) and s["sigma_n_max_Pa"] == pytest.approx(normal.max(), rel=1e-6)
    assert s["findley_stress_max_Pa"] == pytest.approx(radius + 0.3 * normal.max(), rel=1e-6)
    assert s["Fi_max"] == pytest.approx(s["findley_stress_max_Pa"] / 400e6, rel=1e-12)


def test_first_and_last_extreme_of_the_shear(found):
    """Moments at which the path touches its smallest circle: the first and the last, and that of the largest normal stress."""
    _, result = found
    path, normal = own_path(result)
    centre, radius = smallest_circle(path)
    touching = np.flatnonzero(np.abs(path[:, 0] + 1j * path[:, 1] - centre) > radius * (1 - 1e-5))
    assert len(touching) >= 2
    where = np.append(result.worst["x_a"][:-1], result.worst["x_a"][-2])  # the unloaded moment counts as the last one
    s = result.summary
    assert s["feature_x_at_first_shear_extreme_m"] == pytest.approx(where[touching[0]])
    assert s["feature_x_at_last_shear_extreme_m"] == pytest.approx(where[touching[-1]])
    assert s["feature_x_at_normal_max_m"] == pytest.approx(where[int(np.argmax(normal))])
    assert s["feature_x_at_first_shear_extreme_m"] < s["feature_x_at_last_shear_extreme_m"]


def test_the_angle_of_the_critical_plane_to_the_surface(found):
    """Of planes it is that of their normals. Pull along z: tan 2 alpha = 1/kappa, so 36.65 deg at kappa = 0.3."""
    _, result = found
    s, n = result.summary, result.worst["normal"]
    assert np.linalg.norm(n) == pytest.approx(1) and n[2] >= 0
    assert s["surface_angle_deg"] == pytest.approx(math.degrees(math.acos(n[2])), abs=1e-6)
    assert s["plane_theta_deg"] == s["surface_angle_deg"]
    assert s["plane_phi_deg"] == pytest.approx(math.degrees(math.atan2(n[1], n[0])), abs=1e-6)
    pull = np.zeros((1, 36, 6))
    pull[0, :, 2] = 1e8 * np.cos(np.arange(36) * np.pi / 18)
    (theta,), _ = findley.angles(findley.search(pull, 0.3)[1])
    assert theta == pytest.approx(0.5 * math.degrees(math.atan(1 / 0.3)), abs=0.01)


def test_pressure_alone_and_a_part_of_the_passage(taichi_cpu):
    scene = gear(**{"fatigue.shear": False})
    alone = assessment.run(scene, Formula(scene))
    assert np.abs(alone.worst["stress"][:, 4]).max() == 0.0
    part = gear(**{"fatigue.from_x": -0.75, "fatigue.to_x": -0.25})
    reader = Formula(part)
    at = assessment.run(part, reader).worst["x_a"][:-1] / reader.a
    assert at == pytest.approx(np.arange(-12, -3) / CELLS, abs=1e-9)


def test_the_first_principal_stress_of_the_surface(found):
    """The largest of the passage at every point, by eigenvalues, for the worst point."""
    _, result = found
    xx, yy, zz, xy, xz, yz = result.worst["stress"].T
    tensors = np.moveaxis(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), -1, 0)
    largest = np.linalg.eigvalsh(tensors)[:, -1].max()
    values, x, y = (result.maps[name][0] for name in ("sigma1_max", "feature_frame_x", "feature_frame_y"))
    i, j = (int(np.argmin(np.abs(v - result.summary[key]))) for v, key in ((x, "x_m"), (y, "y_m")))
    assert values[i, j] == pytest.approx(largest, rel=1e-6, abs=1e3)
    assert result.maps["Fi"][0][i, j] == pytest.approx(result.summary["Fi_max"], rel=1e-9)


def test_temperatures_fade_out_behind_the_grid():
    """Nothing varies along y: T = -(syy - nu sxx)/(E alpha). On the grid as given, behind it half a cosine over one a, none in
    front of it."""
    steel, n, step, front = Body(), 64, 20e-6, 5
    x = np.arange(n) * step
    a, cells = 200e-6, 10
    stress = ts.ThermalStress(steel, 2.0, [np.full((n, 1), 30.0)], 1e-6, x, np.zeros(1), front, n + front + cells + 8, a, True)
    sxx, syy, _ = stress.on([0])(0)[:, 0].T
    T = -(syy - steel.nu * sxx) / (steel.E * steel.alpha)
    end = front + n
    np.testing.assert_allclose(T[front:end], 30.0, rtol=1e-5)
    assert np.abs(T[:front]).max() < 1e-3 and np.abs(T[end + cells - 1 :]).max() < 1e-3
    fade = T[end : end + cells - 1]
    assert fade[cells // 2 - 1] == pytest.approx(15.0, rel=1e-4) and (np.diff(fade) < 0).all()
    np.testing.assert_allclose(fade + fade[::-1], 30.0, rtol=1e-4)


class Sides(Formula):
    """Both sides of y = 0, with another load on every row; side -1: their mirror image."""

    def __init__(self, scene, side):
        super().__init__(scene, rows=7)
        self.y, self.side = np.linspace(-0.5, 0.5, 7) * self.a, side

    def fields(self, n, names):
        found = super().fields(n, ())
        across = np.linspace(1.0, 1.3, self.y.size)[:: self.side]
        found = {name: field * (1.0 if name.startswith("temp") else across) for name, field in found.items()}
        found["traction_y_a"] = 0.1 * self.side * found["pressure"]
        return {name: found[name] for name in names} if names else found


@pytest.mark.parametrize("depth", [0.0, 0.3])
def test_a_mirrored_line_has_mirrored_stresses(depth):
    """Also beside the domain, where both sides continue alike."""
    scene, signs, found = gear(), np.array([1, 1, 1, -1, 1, -1]), []
    for side in (1, -1):
        reader = Sides(scene, side)
        passage = StressHistories(scene, reader, reader.centres)
        history = row_histories.histories_of(passage, [depth * passage.a], [(row, False) for row in range(7)])
        one = passage.history(slice(0, 7), passage.stresses(depth * passage.a), depth=depth * passage.a)
        found.append(np.array(history)[:, 0])
        np.testing.assert_allclose(one.reshape(-1, 7, *one.shape[1:]).swapaxes(0, 1), found[-1], atol=3e-6 * np.abs(one).max())
    np.testing.assert_allclose(found[0], signs * found[1][::-1], atol=3e-6 * np.abs(found[0]).max())


def test_fields_between_moments_are_linear_in_time():
    ticks = np.array([2, 3, 7, 9])
    fields = (np.array([1.0, -2.0]) + np.array([3.0, 0.5]) * t for t in ticks)
    np.testing.assert_allclose(list(between(fields, ticks)), [[1 + 3 * t, -2 + 0.5 * t] for t in range(2, 10)])


def test_heat_of_an_entry_is_that_of_its_time():
    """Where steps between the stored ones are left out, entries are fewer than the equal steps of conduction."""
    scene = gear()
    reader = Formula(scene)
    reader.time = reader.time[0] + np.r_[0, 1, 3, np.arange(4.0, len(reader) + 1)] * (reader.time[1] - reader.time[0])
    passage, rows = StressHistories(scene, reader, reader.centres), slice(0, 1)
    field = passage.stress_field(2, rows, lambda *_: {name: np.zeros((1, 1)) for name in COMPONENTS},
                                  lambda tick, _: np.full((6, 1, 1), float(tick)))
    assert (field == 3.0).all()
