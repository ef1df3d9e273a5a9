"""Critical planes: closed forms, an independent oracle, invariances; histories in the frame of the feature."""

import numpy as np
import pytest
from rolling import Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment, critical_planes, findley, worst_point
from tehl_taichi.fatigue.stress import histories
from tehl_taichi.fatigue.stress.row_histories import at_the_surface
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.scene import SceneError

S = 100.0
T = np.linspace(0, 2 * np.pi, 360, endpoint=False)
NAMES = ("xx", "yy", "zz", "xy", "xz", "yz")
KAPPAS = (0.2, 0.3, 0.627)


def history(**components):
    out = np.zeros((1, T.size, 6))
    for name, values in components.items():
        out[0, :, NAMES.index(name)] = values
    return out


def rotating(k):
    s = (-1 + np.sqrt(1 + 32 * k * k)) / (8 * k)
    return S * np.sqrt(1 - s * s) * (1 + 2 * k * s)


wave, both = S * np.cos(T), S * (1 + np.cos(T))
CASES = {
    "uniaxial R=-1": (history(xx=wave), lambda k: S / 2 * (k + np.sqrt(1 + k * k))),
    "uniaxial R=0": (history(yy=both), lambda k: (200 * k + np.sqrt(S**2 + (200 * k) ** 2)) / 2),
    "compression only": (history(zz=-both), lambda k: S / 2),
    "torsion R=-1": (history(xy=wave), lambda k: S * np.sqrt(1 + k * k)),
    "torsion R=0": (history(xy=both), lambda k: np.sqrt(S**2 + (200 * k) ** 2)),
    "equibiaxial": (history(xx=wave, yy=wave), lambda k: S / 2 * (k + np.sqrt(1 + k * k))),
    "on hydrostatic pressure": (history(xx=wave - 300, yy=0 * T - 300, zz=0 * T - 300),
                                lambda k: S / 2 * (k + np.sqrt(1 + k * k)) - 300 * k),
    "axial and torsion, 90 degrees": (history(xx=wave, xy=S * np.sin(T)), lambda k: S + k * S),
    "rotating shear": (history(xz=wave, yz=S * np.sin(T)), rotating),
}


@pytest.mark.parametrize("kappa", KAPPAS)
@pytest.mark.parametrize("name", CASES)
def test_closed_forms(taichi_cpu, name, kappa):
    stress, exact = CASES[name]
    f, _ = findley.search(stress, kappa)
    assert f[0] == pytest.approx(exact(kappa), rel=2e-8, abs=1e-6)


@pytest.mark.parametrize("kappa,exact", [(0.3, 106.97452908), (0.627, 129.934653206)])
def test_triangular_path_has_the_circle_not_the_chord(taichi_cpu, kappa, exact):
    corners = np.array([0, 2, 4]) * np.pi / 3
    stress = np.zeros((1, 3, 6))
    stress[0, :, 4], stress[0, :, 5] = S * np.cos(corners), S * np.sin(corners)
    assert findley.search(stress, kappa)[0][0] == pytest.approx(exact, rel=1e-8)
    chord = {0.3: 101.4812, 0.627: 129.9347}[kappa]
    assert findley.search(stress, kappa, criterion="findley-chord")[0][0] == pytest.approx(chord, rel=1e-6)


# criterion: (history, value for kappa): on planes at 45 degrees amplitude and normal stress are S/2, the mean stress S/3
OTHERS = {"matake": (history(xx=wave), lambda k: S / 2 + k * S / 2),
          "dang-van": (history(xx=wave), lambda k: S / 2 + k * S / 3)}


@pytest.mark.parametrize("criterion", OTHERS)
def test_other_criteria(taichi_cpu, criterion):
    stress, exact = OTHERS[criterion]
    for prune in (True, False):
        f, _ = findley.search(stress, 0.3, prune=prune, criterion=criterion)
        assert f[0] == pytest.approx(exact(0.3), rel=1e-7)


def test_dang_van_of_torsion_on_pressure(taichi_cpu):
    stress = history(xy=wave, xx=0 * T - 60, yy=0 * T - 60, zz=0 * T - 60)
    assert findley.search(stress, 0.3, criterion="dang-van")[0][0] == pytest.approx(S - 0.3 * 60, rel=1e-7)


def test_limits_of_bending_and_torsion_give_the_constants(taichi_cpu):
    kappa, limit = CRITERIA["findley"].from_limits(500e6, 320e6)
    assert 500e6 / 2 * (kappa + np.sqrt(1 + kappa**2)) == pytest.approx(limit, rel=1e-12)
    assert 320e6 * np.sqrt(1 + kappa**2) == pytest.approx(limit, rel=1e-12)
    assert CRITERIA["findley"].from_limits(1.0, 0.643674)[0] == pytest.approx(0.3, rel=1e-4)
    with pytest.raises(SceneError, match="between 0.5 and 1"):
        CRITERIA["findley"].from_limits(500e6, 200e6)


def test_the_path_on_a_plane(taichi_cpu):
    stress = history(xz=wave, yz=S * np.sin(T), zz=-2 * both)[0]
    dip, strike, normal = findley.shear_path(stress, np.array([0.0, 0.0, 1.0]))
    u, v, radius = findley.smallest_circle(dip, strike)
    np.testing.assert_allclose(np.hypot(dip, strike), S, rtol=1e-12)
    assert radius == pytest.approx(S, rel=1e-9) and np.hypot(u, v) < 1e-6 * S and normal.max() == pytest.approx(0, abs=1e-9)
    assert worst_point.on_circle(dip, strike, (0.0, 0.0, S)).size == T.size


def test_planes_of_the_ten_degree_grid():
    normals = findley.planes()
    assert normals.shape == (211, 3) and (normals[:, 2] > -1e-15).all()
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, rtol=1e-14)


def passages(points=12, steps=60, seed=3):
    """Smooth stress histories like those of a passage, (points, steps, 6)."""
    rng = np.random.default_rng(seed)
    t = np.linspace(-3, 3, steps)
    centre, width = rng.uniform(-0.5, 0.5, (points, 6, 1)), rng.uniform(0.3, 1, (points, 6, 1))
    size = rng.standard_normal((points, 6, 1)) * 1e8
    return np.ascontiguousarray((size * np.exp(-(((t - centre) / width) ** 2))).transpose(0, 2, 1))


def tensors(h):
    xx, yy, zz, xy, xz, yz = np.moveaxis(h, -1, 0)
    return np.stack([np.stack(row, -1) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))], -2)


def vectors(s):
    return np.stack([s[..., i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))], -1)


def smallest_circle(points):
    """Radius by brute force: every pair and triple, the smallest circle that holds all points."""
    z = points[:, 0] + 1j * points[:, 1]
    scale = np.abs(z - z.mean()).max()
    i, j = np.triu_indices(len(z), 1)
    centres = [(z[i] + z[j]) / 2]
    for k in range(len(z)):
        u, v = z[j] - z[i], z[k] - z[i]
        with np.errstate(all="ignore"):
            centres.append(z[i] + (abs(u) ** 2 * v - abs(v) ** 2 * u) / (u.conjugate() * v - u * v.conjugate()))
    c = np.concatenate(centres)
    c = c[np.isfinite(c) & (np.abs(c - z.mean()) < 3 * scale)]
    return np.abs(c[:, None] - z[None]).max(axis=1).min()


def oracle(h, n, kappa):
    """tau_amp + kappa sigma_n,max of one history (times, 6) on the plane n."""
    s = tensors(h)
    e1 = np.linalg.svd(n[None])[2][1]
    e2 = np.cross(n, e1)
    path = np.stack([s @ n @ e1, s @ n @ e2], axis=1)
    return smallest_circle(path) + kappa * (s @ n @ n).max()


def test_patterns_have_eight_directions_and_turn():
    rings = findley.rings()
    found = rings[..., 0] + 1j * rings[..., 1]
    np.testing.assert_allclose(found[:, 1:] / found[:, :-1], np.exp(0.25j * np.pi), rtol=1e-12)
    np.testing.assert_allclose(found[1:, 0] / found[:-1, 0], np.exp(1j * findley.TURN), rtol=1e-12)
    assert found[0, 0] == 1 and len(found) == findley.SHEARED_SHRINKS * critical_planes.MOVES  # a longer walk reads beyond


def test_value_on_the_plane_found_agrees_with_the_oracle(taichi_cpu):
    h = passages(6, 40)
    f, normals = findley.search(h, 0.3)
    for point in range(len(h)):
        assert f[point] == pytest.approx(oracle(h[point], normals[point], 0.3), rel=1e-11)


def test_no_plane_of_a_scan_is_above_the_maximum(taichi_cpu):
    h = passages(1, 20)
    f, _ = findley.search(h, 0.3)
    for point in range(len(h)):
        scan = max(oracle(h[point], n, 0.3) for n in findley.planes(6.0))
        assert scan <= f[point] * (1 + 1e-12) and scan > 0.98 * f[point]


def test_pruning_changes_rounding_alone(taichi_cpu):
    """Of a circle that is found from fewer moments, in another order."""
    h = passages(40, 80)
    for one, all_ in zip(findley.search(h, 0.3), findley.search(h, 0.3, prune=False)):
        np.testing.assert_allclose(one, all_, rtol=1e-14, atol=1e-14)


def test_planes_of_more_moments_are_kept_where_these_have_as_much(taichi_cpu):
    h, effort = passages(40, 80), np.zeros(40)
    known, part = findley.search(h, 0.3), h[:, 20:]
    alone, kept = findley.search(part, 0.3), findley.search(part, 0.3, known=known, decided=effort)
    same = effort == 1
    assert 5 < same.sum() < 35 and effort[~same].min() > 200
    for one, other, more in zip(kept, alone, known):
        np.testing.assert_array_equal(one[same], more[same])
        np.testing.assert_array_equal(one[~same], other[~same])
    np.testing.assert_allclose(kept[0], alone[0], rtol=1e-7)
    assert (alone[0][~same] < known[0][~same] * (1 - 1e-9)).all()


@pytest.mark.parametrize("criterion", ["findley", "dang-van", "matake"])
def test_the_worst_alone_is_that_of_all_and_takes_a_part_of_the_planes(taichi_cpu, criterion):
    h, few, all_ = passages(60, 40), np.zeros(60), np.zeros(60)
    h *= (np.linspace(0.2, 1.0, 60) / findley.search(h, 0.3, criterion=criterion)[0])[:, None, None]  # eight are near the worst
    f, normals = findley.search(h, 0.3, criterion=criterion, decided=all_)
    worst, planes = findley.search(h, 0.3, criterion=criterion, decided=few, worst=True)
    near = f >= 0.9 * f.max()
    np.testing.assert_array_equal(worst[near], f[near])
    np.testing.assert_array_equal(planes[near], normals[near])
    left_out = np.isnan(planes[:, 0])
    assert (worst[left_out] < 0.9 * f.max()).all() and (worst <= f).all()
    if criterion != "matake":  # whose shear decides the plane, not its value
        assert left_out.sum() > 20 and few.sum() < 0.5 * all_.sum()


def test_needed_points_are_searched_besides_the_worst(taichi_cpu):
    h, needed = passages(60, 40), np.arange(60) % 5 == 2
    h *= (np.linspace(0.2, 1.0, 60) / findley.search(h, 0.3)[0])[:, None, None]
    f, normals = findley.search(h, 0.3)
    found, planes = findley.search(h, 0.3, worst=True, needed=needed)
    some = needed | (f >= 0.9 * f.max())
    np.testing.assert_array_equal(found[some], f[some])
    np.testing.assert_array_equal(planes[some], normals[some])
    assert np.isnan(planes[:, 0]).sum() > 20


def test_fewer_moments_search_the_points_that_the_worst_alone_left_out(taichi_cpu):
    h = passages(60, 40)
    known, part = findley.search(h, 0.3, worst=True), h[:, 20:]
    alone, kept = findley.search(part, 0.3), findley.search(part, 0.3, known=known)
    left_out = np.isnan(known[1][:, 0])
    np.testing.assert_array_equal(kept[0][left_out], alone[0][left_out])
    np.testing.assert_array_equal(kept[1][left_out], alone[1][left_out])


@pytest.mark.parametrize("criterion", ["matake", "dang-van"])
def test_criteria_that_fewer_moments_may_raise_keep_nothing(taichi_cpu, criterion):
    h = passages(10, 40)
    known, part = findley.search(h, 0.3, criterion=criterion), h[:, 10:]
    for one, other in zip(findley.search(part, 0.3, criterion=criterion, known=known),
                          findley.search(part, 0.3, criterion=criterion)):
        np.testing.assert_array_equal(one, other)


def test_mirror_and_rotation_change_nothing(taichi_cpu):
    h = passages(30, 80, seed=5)
    f, _ = findley.search(h, 0.3)
    mirrored = findley.search(h * np.array([1, 1, 1, -1, 1, -1]), 0.3)[0]
    np.testing.assert_allclose(mirrored, f, rtol=1e-6)
    q = np.linalg.qr(np.random.default_rng(7).standard_normal((3, 3)))[0]
    np.testing.assert_allclose(findley.search(vectors(q @ tensors(h) @ q.T), 0.3)[0], f, rtol=1e-6)


def test_bad_histories_are_refused(taichi_cpu):
    h = passages(1, 5)
    h[0, 2, 1] = np.nan
    with pytest.raises(ValueError, match="finite"):
        findley.search(h, 0.3)


def test_largest_principal_stress():
    h = passages(10, 30)
    exact = np.linalg.eigvalsh(tensors(h))[..., -1]
    np.testing.assert_allclose(findley.largest_principal(h), exact, atol=1e-7 * np.abs(h).max())


def test_angles():
    theta, phi = findley.angles(np.array([[0, 0, 1.0], [0, 1.0, 0], [np.sqrt(0.5), 0, np.sqrt(0.5)]]))
    np.testing.assert_allclose(theta, (0, 90, 45), atol=1e-6)
    np.testing.assert_allclose(phi, (0, 90, 0), atol=1e-12)


SURFACE = {"thermal.on": False, "fatigue.depths": []}


def moving(scene, cells=8, rows=5, stride=1.0):
    return Rolling(scene, cells, rows, stride, begin=-1.6)


def test_passage_in_the_frame_of_the_feature(taichi_cpu):
    scene = tehl.scene("gear").replace(**{"thermal.on": False})
    reader = moving(scene)
    result = assessment.run(scene, reader)
    assert set(result.summary) == {"surface", "von_mises", "carries_feature", "contact_alone", "rough", "statistics",
                                   "cycles_above_1", "Fi_max", "findley_stress_max_Pa",
                                   "x_m", "y_m", "plane_theta_deg", "plane_phi_deg", "surface_angle_deg", "sigma1_max_Pa",
                                   "sigma1_worst_Pa", "kappa_F", "sigma_eF_Pa", "tau_amp_Pa", "sigma_n_max_Pa",
                                   "criterion", "thermal_stress", "pit_angles_deg", "below", "feature_x_at_normal_max_m",
                                   "feature_x_at_first_shear_extreme_m", "feature_x_at_last_shear_extreme_m"}
    total = result.summary["tau_amp_Pa"] + result.summary["kappa_F"] * result.summary["sigma_n_max_Pa"]
    assert total == pytest.approx(result.summary["findley_stress_max_Pa"], rel=1e-6)
    assert abs(result.summary["x_m"]) < 0.5 * reader.s.a
    assert 0.15 < result.summary["findley_stress_max_Pa"] / reader.s.p_H < 0.5
    sizes = tuple(result.maps[name][0].size for name in ("feature_frame_x", "feature_frame_y"))
    assert result.maps["Fi"][0].shape == sizes


def test_history_of_whole_cells_is_exact_and_begins_and_ends_unloaded(taichi_cpu):
    scene = tehl.scene("gear").replace(**SURFACE)
    reader = moving(scene)
    passage = assessment.StressHistories(scene, reader, reader.centres)
    h = at_the_surface(passage)(slice(0, 1))
    n = int(np.argmin(np.abs(reader.centres)))
    t = int(np.flatnonzero(passage.entries == n)[0])
    point = passage.x.size // 2 + 3
    column = int(round((passage.centres[t] + passage.x[point] - reader.x[0]) / passage.dx))
    assert -h[point, t, 2] == np.float32(reader.fields(n, ("pressure",))["pressure"][column, 0]) > 0
    assert np.abs(h[:, 0, 2]).max() == np.abs(h[:, -2, 2]).max() == np.abs(h[:, -1]).max() == 0.0


def test_the_first_planes_are_close_enough(taichi_cpu):
    """Histories of a passage: four times as many planes to begin with find the same to 1e-6."""
    scene = tehl.scene("gear").replace(**SURFACE)
    passage = assessment.StressHistories(scene, reader := moving(scene, 16, 9), reader.centres)
    h = at_the_surface(passage)(slice(0, passage.y.size))
    np.testing.assert_allclose(findley.search(h, 0.3)[0], findley.search(h, 0.3, degrees=5.0)[0], rtol=1e-6)


def test_blocks_of_rows_change_nothing(taichi_cpu, monkeypatch):
    scene = tehl.scene("gear").replace(**SURFACE)
    reader = moving(scene, cells=8, rows=5)
    whole = assessment.run(scene, reader)
    monkeypatch.setattr(histories, "BLOCK_BYTES", 1.0)
    assert assessment.run(scene, reader).summary == whole.summary


def test_broken_shifts_are_interpolated(taichi_cpu):
    scene = tehl.scene("gear").replace(**SURFACE)
    one, other = (assessment.run(scene, moving(scene, 16, 9, stride)).summary["findley_stress_max_Pa"]
                  for stride in (1.0, 0.7))
    assert other == pytest.approx(one, rel=0.02)


def test_a_window_of_positions_counts_only_its_moments(taichi_cpu):
    scene = tehl.scene("gear").replace(**SURFACE)
    reader = moving(scene)
    entry, rest = (assessment.run(scene.replace(**{f"fatigue.{key}": 0.0}), reader).summary["findley_stress_max_Pa"]
                   for key in ("to_x", "from_x"))
    whole = assessment.run(scene, reader).summary["findley_stress_max_Pa"]
    assert max(entry, rest) <= whole * (1 + 1e-9) and entry != rest
    with pytest.raises(SceneError, match="no stored moment"):  # snapshots may be of a part of the passage
        assessment.run(scene.replace(**{"fatigue.to_x": 0.0}), Rolling(scene, 16, 9, begin=0.5))


def test_residual_stress_and_depths(taichi_cpu):
    scene = tehl.scene("gear").replace(**{"thermal.on": False, "fatigue.depths": [20e-6, 200e-6]})
    reader = moving(scene, cells=8, rows=5)
    free = assessment.run(scene, reader)
    pressed = assessment.run(scene.replace(**{"fatigue.residual_xx": -3e8, "fatigue.residual_yy": -3e8}), reader)
    levels = [layer["findley_stress_max_Pa"] for layer in free.summary["by_depth"]]
    assert free.maps["findley_stress_at_depth"][0].shape[0] == 3 and len(set(levels)) == 3
    assert all(b["findley_stress_max_Pa"] < a for a, b in zip(levels, pressed.summary["by_depth"]))
    deep = free.summary["below"]
    assert free.summary["findley_stress_max_Pa"] == levels[0] and deep["findley_stress_max_Pa"] >= max(levels[1:])


class Heated(Rolling):
    """The same with a warm spot under the bump."""

    def fields(self, n, names):
        warm = 50 + 40 * np.exp(-((self.x[:, None] - self.centres[n]) ** 2 + self.y**2) / (0.2 * self.s.a) ** 2) * (n > 0)
        out = {"temperature_a": 90.0 + warm * (np.abs(self.x[:, None]) < self.s.a) + 0 * self.y}
        return out if names == ("temperature_a",) else {**super().fields(n, names), **out}


def test_thermal_stress_counts_where_there_is_heat(taichi_cpu):
    scene = tehl.scene("gear").replace(**{"fatigue.depths": []})
    reader = Heated(scene)
    hot, cold = (assessment.run(scene.replace(**{"fatigue.thermal_stress": on}), reader) for on in ("auto", False))
    assert hot.summary["thermal_stress"] and not cold.summary["thermal_stress"]
    assert abs(hot.summary["findley_stress_max_Pa"] / cold.summary["findley_stress_max_Pa"] - 1) > 0.02
    with pytest.raises(SceneError, match="temperatures"):
        scene.replace(**{"thermal.on": False, "fatigue.thermal_stress": True})


class Still:
    """Reader of a run without feature."""

    def __len__(self):
        return 1

    def feature_x(self, n):
        return np.nan


def test_no_feature_is_refused():
    with pytest.raises(SceneError, match="passage of a feature"):
        assessment.run(tehl.scene("smooth-line"), Still())
