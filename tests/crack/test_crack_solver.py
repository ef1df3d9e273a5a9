"""A crack in a half-plane against handbooks, a second formula, and itself on finer elements; faces that touch and rub."""

import numpy as np
import pytest

from tehl_taichi.crack import closure, complementarity, face_friction
from tehl_taichi.crack.compliance import CrackFaces
from tehl_taichi.crack.dislocations import stresses
from tehl_taichi.crack.elements import Elements
from tehl_taichi.crack.stiffness import stiffness

UNIT = np.sqrt(np.pi)  # K of a crack of length 1 under stress 1 is F times this


def slanted(degrees):
    """A crack of length 1 at this angle to the surface."""
    return np.array([0.0, np.exp(1j * np.radians(degrees))])


def forces(faces, xx=0.0, zz=0.0, xz=0.0):
    """Nodal forces (2 nodes, 1) of stresses at the faces' points, numbers or arrays."""
    return faces.forces(np.stack(np.broadcast_arrays(xx, zz, xz, faces.points.real)[:3], axis=-1)[:, None])


def factors(faces, **stress):
    """(F_I, F_II) of faces that may pass through each other."""
    return faces.intensities(faces.compliance @ forces(faces, **stress))[:, 0] / UNIT / np.sqrt(faces.a)


@pytest.mark.parametrize("count", [12, 40])
def test_a_normal_edge_crack(count):
    """1.1215 in tension and in shear, 0.6829 under a stress that grows with depth (Tada, Paris & Irwin)."""
    faces = CrackFaces(slanted(90), 1.0, count)
    tension, shear = factors(faces, xx=1.0), factors(faces, xz=1.0)
    assert tension[0] == pytest.approx(1.1215, rel=1e-3) and abs(tension[1]) < 1e-12
    assert -shear[1] == pytest.approx(1.1215, rel=1e-3) and abs(shear[0]) < 1e-12
    assert factors(faces, xx=faces.points.imag)[0] == pytest.approx(0.6829, rel=2e-3)


@pytest.mark.parametrize("degrees,expected,rel", [(45, (0.7050, 0.3645), 2e-3), (30, (0.4625, 0.3362), 5e-3)])
def test_an_inclined_edge_crack(degrees, expected, rel):
    """Handbooks; at 30 degrees to the surface the limit of Gauss-Chebyshev collocation. Twelve elements."""
    found = factors(CrackFaces(slanted(degrees), 1.0, 12), xx=1.0)
    np.testing.assert_allclose(np.abs(found), expected, rtol=rel)
    mirrored = factors(CrackFaces(slanted(180 - degrees), 1.0, 12), xx=1.0)
    np.testing.assert_allclose(mirrored, (found[0], -found[1]), rtol=1e-9)


@pytest.mark.parametrize("path", [slanted(90), slanted(30), slanted(15), np.array([0, 1j, 0.3 + 1.4j])], ids=str)
def test_stress_intensities_are_those_of_the_energy(path):
    """(K_I^2 + K_II^2)/E* is what the energy of the body under constant stress loses per length (Irwin): 0.2 %."""
    def energy(a):
        longer = path.copy()
        longer[-1] = path[-2] + (path[-1] - path[-2]) * a
        faces = CrackFaces(longer, 1.0, 24)
        load = forces(faces, xx=1.0, xz=0.3)
        return 0.5 * float((load * (faces.compliance @ load)).sum()), faces, load

    last, h = abs(path[-1] - path[-2]), 0.01
    _, faces, load = energy(1.0)
    K = faces.intensities(faces.compliance @ load)
    assert float((K**2).sum()) == pytest.approx((energy(1 + h)[0] - energy(1 - h)[0]) / (2 * h * last), rel=2e-3)


KINK, ZIGZAG = np.cumsum([0, 1j, 0.2 * np.exp(2.6j)]), np.cumsum([0, 1j, 0.3 * np.exp(2.5j), 0.3j, 0.3 * np.exp(2.5j)])


@pytest.mark.parametrize("path", [slanted(15), KINK, ZIGZAG], ids=["15", "kink", "zigzag"])
def test_shallow_and_kinked_cracks_need_few_elements(path):
    """Twelve elements against ninety-six: 0.2 %."""
    coarse, fine = (factors(CrackFaces(path, 1.0, count), xx=1.0) for count in (12, 96))
    np.testing.assert_allclose(coarse, fine, atol=2e-3 * np.abs(fine).max())


def test_an_arc_and_the_same_arc_on_finer_elements():
    """From 90 to 150 degrees in chords of 10 degrees: 24 against 96 elements, 0.5 %."""
    arc = 1 - np.exp(-1j * np.radians(np.arange(0, 61, 10)))
    np.testing.assert_allclose(*(factors(CrackFaces(arc, 1.0, count), xx=1.0) for count in (24, 96)), rtol=5e-3)


def test_points_on_a_straight_crack_change_nothing():
    one, six = (factors(CrackFaces(np.exp(1j) * np.linspace(0, 1, count), 1.0, 12), xx=1.0) for count in (2, 7))
    np.testing.assert_allclose(one, six, rtol=1e-10)


@pytest.mark.parametrize("b", [1.0, 1j])
def test_the_surface_pulls_a_dislocation(b):
    """With mu b^2/(4 pi (1 - nu) d) (Head 1953); its own stress is odd, so it falls out of the mean of two sides."""
    nu, mu, depth, h = 0.3, 1.0, 0.7, 1e-4
    E_star, z0 = 2 * mu / (1 - nu), 0.2 + 1j * depth
    xx, zz, xz = np.mean([stresses(z0 + side * h, z0, b, E_star) for side in (-1, 1)], axis=0)
    force = np.array([xz * b.real + zz * b.imag, -(xx * b.real + xz * b.imag)])
    np.testing.assert_allclose(np.abs(force), (0, mu / (4 * np.pi * (1 - nu) * depth)), rtol=1e-6, atol=1e-9)


def test_the_surface_is_free():
    xx, zz, xz = stresses(np.linspace(-3, 3, 7) + 0j, 0.4 + 0.6j, 1.0 + 0.5j, 1.0)
    assert np.abs(xx).max() > 0.01 and max(np.abs(zz).max(), np.abs(xz).max()) < 1e-12 / 0.6


def test_open_faces_carry_nothing_and_the_body_around_is_in_balance():
    """Traction of body and crack together on the middle of a face, and the far stress unchanged."""
    faces, n = CrackFaces(slanted(50), 1.0, 24), 1j * np.exp(1j * np.radians(50))
    values = (faces.compliance @ forces(faces, xx=1.0))[:, 0]
    near = 0.5 * np.exp(1j * np.radians(50)) + n * np.array([-0.05, 0.05])
    xx, zz, xz = faces.around(near) @ values + np.array([[1.0], [0.0], [0.0]])
    across, along = xx * n.real + xz * n.imag, xz * n.real + zz * n.imag
    assert max(np.abs(across).max(), np.abs(along).max()) < 0.05  # 0.77 without the crack
    assert np.abs(faces.around(np.array([40.0 + 30j])) @ values).max() < 1e-3


def test_the_energy_is_symmetric_and_positive():
    for path in (slanted(15), np.cumsum([0, 1j, 0.3 * np.exp(2.6j), 0.3 * np.exp(0.7j)])):
        A = stiffness(Elements(path, 24), 1.0)
        np.testing.assert_allclose(A, A.T, atol=1e-12 * np.abs(A).max())
        assert np.linalg.eigvalsh(A).min() > 0


@pytest.mark.parametrize("shear,expected", [(1.0, 1.1215 * (1.0 - 0.3)), (0.2, 0.0)])
def test_closed_faces_rub(shear, expected):
    """Pressed with 1: F_II = 1.1215 (tau - mu sigma) where they slide, nothing where they stick."""
    faces = CrackFaces(slanted(90), 1.0, 40)
    values, held, missed = face_friction.with_friction(faces, forces(faces, xx=-1.0, xz=shear), 0.3)
    K_I, K_II = np.abs(faces.intensities(values)[:, 0]) / UNIT
    assert K_I == 0 and K_II == pytest.approx(expected, rel=3e-3, abs=1e-9) and missed == 0 and (held > 0).all()


def test_slip_that_was_stays_when_the_shear_goes():
    """Sheared with 1 and let go under a pressure whose friction holds it: the slip is locked; without friction it goes back."""
    faces = CrackFaces(slanted(90), 1.0, 12)
    steps = np.concatenate([forces(faces, xx=-1.0, xz=shear) for shear in (0.0, 1.0, 0.8)], axis=1)
    values, _, _ = face_friction.with_friction(faces, steps, 0.3)
    K_II = faces.intensities(values)[1]
    assert K_II[2] == pytest.approx(K_II[1], rel=1e-9)
    assert faces.intensities(closure.frictionless(faces, steps)[0])[1][2] == pytest.approx(0.8 / 0.7 * K_II[1], rel=1e-6)


@pytest.mark.parametrize("degrees", [90, 45, 15])
def test_faces_touch_where_they_would_pass_through_each_other(degrees):
    """Pressed at the mouth and pulled deeper, and the other way round, seven moments: no overlap, no force on open faces; a
    tip that touches has no K_I. The same on finer elements: 1 %."""
    found = []
    for count in (24, 48):
        faces = CrackFaces(slanted(degrees), 1.0, count)
        deep = faces.points.imag / faces.points.imag.max()
        load = np.concatenate([forces(faces, xx=a + b * deep, xz=0.2) for a, b in
                               ((1, 0), (-1, 3), (-1, 1.5), (1, -3), (0.5, -3), (-1, 0), (0.1, -1))], axis=1)
        values, held = closure.frictionless(faces, load)
        opening = values[: faces.nodes]
        assert opening.min() > -1e-9 * np.abs(values).max() and held.min() >= 0
        assert np.abs(held * opening).max() < 1e-9 * held.max() * opening.max() and (held > 0).any() and opening.max() > 0
        found.append(faces.intensities(values))
        assert (found[-1][0] >= 0).all() and found[-1][0][5] == 0
    np.testing.assert_allclose(*found, atol=0.01 * np.abs(found[1]).max())


@pytest.mark.parametrize("mu,error", [(0.0, 0.01), (0.3, 0.04)])
def test_closed_kinks_need_few_elements(mu, error):
    """A zigzag pressed and sheared to and fro, twelve elements against forty-eight, of the largest K_II: 1 %, with friction
    (none at the kinks themselves) 4 %; faces do not pass through each other on either side of a kink."""
    found = []
    for count in (12, 48):
        faces = CrackFaces(np.cumsum([0, 1j, 0.5 * np.exp(2.3j), 0.5j]), 1.0, count)
        depth = faces.points.imag
        load = np.concatenate([forces(faces, xx=a + b * depth, zz=-0.5, xz=c) for a, b, c in
                               ((-1, 0, 1), (-1, 0, -1), (0.3, -1, 0.5), (-0.5, 0.8, 1), (-2, 1, -0.6))], axis=1)
        values, held = closure.frictionless(faces, load) if mu == 0 else face_friction.with_friction(faces, load, mu)[:2]
        opening = (faces.contact @ values)[: len(held)]
        assert len(held) == faces.nodes + 2 and opening.min() > -1e-9 * np.abs(values).max()
        assert held.min() >= 0 and np.abs(held * opening).max() < 1e-9 * held.max() * np.abs(values).max()
        found.append(faces.intensities(values))
    np.testing.assert_allclose(*found, atol=error * np.abs(found[1][1]).max())


def test_bounded_forces_are_found_from_any_first_guess():
    """Within their bounds, with displacements that press against them; hard matrices, thirty times."""
    rng = np.random.default_rng(5)
    for _ in range(30):
        M = rng.standard_normal((18, 18))
        M, gap = M @ M.T + 0.02 * np.eye(18), rng.standard_normal(18)
        low, high = -rng.random(18), np.where(rng.random(18) < 0.5, np.inf, rng.random(18))
        found = [complementarity.solve_bounded(M, gap, low, high, np.full(18, at))
                 for at in (complementarity.LOW, complementarity.FREE)]
        for r, at in found:
            w = gap + M @ r
            assert (r >= low).all() and (r <= high).all()
            np.testing.assert_allclose(w[at == complementarity.FREE], 0, atol=1e-9)
            assert (w[r == low] > -1e-9).all() and (w[r == high] < 1e-9).all()
        np.testing.assert_allclose(found[0][0], found[1][0], atol=1e-9)


@pytest.mark.parametrize("tries", [0, 8])
def test_bounded_forces_of_long_cracks_take_few_steps(monkeypatch, tries):
    """Forces that act on many neighbours alike: one exchange at a time took hours for 242 of them."""
    apart, rng, solves = np.subtract.outer(np.arange(120), np.arange(120)), np.random.default_rng(7), []
    M, plain = np.exp(-((apart / 4) ** 2)) + 1e-8 * np.eye(120), complementarity._forces
    monkeypatch.setattr(complementarity, "TRIES", tries)
    monkeypatch.setattr(complementarity, "_forces", lambda *given: solves.append(1) or plain(*given))
    for _ in range(10):
        gap, low, high = rng.standard_normal(120), np.where(rng.random(120) < 0.5, 0.0, -rng.random(120)), rng.random(120)
        r, at = complementarity.solve_bounded(M, gap, low, high, np.full(120, complementarity.FREE))
        w, small = gap + M @ r, 1e-9 * np.abs(gap).max()
        assert (r >= low).all() and (r <= high).all() and np.abs(w[at == complementarity.FREE]).max(initial=0) < 1e-6
        assert (w[at == complementarity.LOW] >= -small).all() and (w[at == complementarity.HIGH] <= small).all()
    assert len(solves) < 10 * 3 * 120


def test_friction_settles_where_exchanging_states_goes_round(monkeypatch):
    """All moments by bounds alone give what exchanged states give; a crack at 45 degrees pressed, sheared to and fro."""
    faces, turns = CrackFaces(slanted(45), 1.0, 24), np.linspace(0, 4 * np.pi, 40)
    depth = faces.points.imag
    load = np.concatenate([forces(faces, xx=-1 - np.cos(3 * turn) * depth, xz=np.sin(turn)) for turn in turns], axis=1)
    values, held, missed = face_friction.with_friction(faces, load, 0.4)
    monkeypatch.setattr(face_friction, "TRIES", 1)
    other, held_too, missed_too = face_friction.with_friction(faces, load, 0.4)
    assert missed == missed_too == 0
    np.testing.assert_allclose(values, other, atol=1e-5 * np.abs(values).max())
    np.testing.assert_allclose(held, held_too, atol=1e-5 * held.max())


def test_moments_at_once_and_one_by_one_rub_alike(monkeypatch):
    """Eight moments of one state at a time, and a second passage that ends where it meets the first, against each by itself;
    half of the solves at least are saved."""
    faces, turns, solves = CrackFaces(slanted(45), 1.0, 24), np.linspace(0, 4 * np.pi, 80), []
    depth = faces.points.imag
    load = np.concatenate([forces(faces, xx=-1 - np.cos(3 * turn) * depth, xz=np.sin(turn)) for turn in turns], axis=1)
    plain = face_friction._forces
    monkeypatch.setattr(face_friction, "_forces", lambda *given: solves.append(1) or plain(*given))
    values, held, _ = face_friction.with_friction(faces, load, 0.4)
    few = len(solves)
    monkeypatch.setattr(face_friction, "AHEAD", 1)
    monkeypatch.setattr(face_friction, "FORGOT", -1.0)
    other, held_too, _ = face_friction.with_friction(faces, load, 0.4)
    assert few < 0.5 * (len(solves) - few)
    np.testing.assert_allclose(values, other, atol=1e-9 * np.abs(values).max())
    np.testing.assert_allclose(held, held_too, atol=1e-9 * held.max())


def test_pressure_inside_opens_as_much_as_the_same_pull():
    faces = CrackFaces(slanted(60), 1.0, 12)
    n = 1j * np.exp(1j * np.radians(60))
    pull = forces(faces, xx=n.real**2, zz=n.imag**2, xz=n.real * n.imag)[:, 0]  # sigma . n = n
    np.testing.assert_allclose(faces.pushed(), pull, atol=1e-12)


def test_a_matrix_that_is_positive_only_to_rounding_ends():
    """Next to no oil, shut in: its pressure comes out below zero, and without it the faces lack 1e-21 m."""
    M, gap = np.array([[1.0, 1.0], [1.0, 1.0 - 2.0**-53]]), np.array([0.0, -1e-21])
    r, _ = complementarity.solve_bounded(M, gap, np.zeros(2), np.full(2, np.inf),
                                         np.array([complementarity.FREE, complementarity.LOW]))
    assert (r >= 0).all() and abs(gap + M @ r).max() <= 1e-20


def test_forces_that_mean_the_same_share_the_load():
    """Faces that touch and the oil shut in between them: a singular matrix is no end."""
    M, gap = np.ones((2, 2)), np.array([-1.0, -1.0])
    with pytest.raises(np.linalg.LinAlgError):
        np.linalg.solve(M, -gap)
    r, at = complementarity.solve_bounded(M, gap, np.zeros(2), np.full(2, np.inf), np.full(2, complementarity.FREE))
    assert r == pytest.approx([0.5, 0.5], rel=1e-3) and (at == complementarity.FREE).all()
    against = complementarity.solve_compliant(M, np.array([1.0, 2.0]))  # no forces do that: large ones, apart
    assert against[1] > 1e9 and against[0] < -1e9
    faces = face_friction._forces(M, gap[:, None], 0.0, np.full(2, face_friction.UP), np.zeros(0))
    assert faces[:, 0] == pytest.approx([0.5, 0.5], rel=1e-3)
