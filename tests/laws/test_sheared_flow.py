"""What a film carries by pressure while its walls slide: closed laws against sums across one column, their derivatives."""

import numpy as np
import pytest
from one_column import carreau, column, limiting

from tehl_taichi.laws import sheared_flow as flows
from tehl_taichi.laws.circular_law import MOST_R, circular_flow, circular_slip, circular_stress
from tehl_taichi.laws.rheology import shear_stress
from tehl_taichi.laws.tangent_circle import touching_flow, touching_slip, touching_stress
from tehl_taichi.scene.sections import Rheology

P = 1e9
LAWS = {"limiting": Rheology(law="limiting"), "eyring": Rheology(law="eyring", tau_0=5e6),
        "carreau": Rheology(law="carreau", tau_0=5e6, carreau_n=0.5), "thin carreau": Rheology(law="carreau", carreau_n=0.3)}
SCALE = {"limiting": 85e6, "eyring": 5e6, "carreau": 5e6, "thin carreau": 10e6}  # of the stresses at 1 GPa
RATES = {"limiting": limiting, "eyring": np.sinh, "carreau": carreau(0.5), "thin carreau": carreau(0.3)}
WALLS = {"limiting": (1e-3, 0.03, 0.3, 0.6, 0.9, 0.99)}
SLIDING = (0.0, 0.3, 1.0, 5.0, 15.0)
of_every_law = pytest.mark.parametrize("law", LAWS)


def walls_of(law):
    return WALLS.get(law, (0.01, 0.3, 1.0, 3.0, 8.0))


def whole(rheology, wall, newtonian, p=P):
    return flows.flow(rheology, wall, newtonian, p)[0] + flows.beyond(rheology, wall, newtonian, p)[0]


@of_every_law
def test_a_law_carries_what_the_sum_across_a_column_does(law):
    """Closed laws to the sum's own digits (Carreau's five nodes to half a per cent), and so the stress in the middle."""
    rheology, scale, most = LAWS[law], SCALE[law], 5e-3 if "carreau" in law else 1e-6
    for wall in walls_of(law):
        for r in SLIDING:
            carried, mean, slip = column(RATES[law], wall, r, 1.0 if law == "limiting" else np.inf)
            smooth = flows.flow if law == "limiting" else lambda *known: (whole(*known),)
            found = smooth(rheology, wall * scale, r * scale, P)[0]
            assert found == pytest.approx(carried, rel=most), (wall, r)
            stress = flows.mean_stress(rheology, wall * scale, r * scale, P) / scale
            assert stress == pytest.approx(mean, rel=4 * most, abs=most), (wall, r)
            assert flows.wall_slip(rheology, wall * scale, r * scale, P) * r == pytest.approx(slip * r, abs=1e-6 * (1 + r))


@of_every_law
@pytest.mark.parametrize("steep", [False, True])
@pytest.mark.parametrize("across", [False, True])  # there by differences of a thousandth
def test_derivatives_are_those_of_the_flow(law, across, steep):
    """By both stresses and the pressure, against differences."""
    rheology, scale, parts = LAWS[law], SCALE[law], flows.across if across else flows.along

    def function(rheology, wall, newtonian, p):
        return parts(rheology, wall, wall, newtonian, p)[steep]

    for wall in walls_of(law):
        for r in (0.0, 0.3, 5.0, 14.9, 60.0):
            at = np.array((wall * scale, r * scale, P))
            value, *slopes = (float(one) for one in function(rheology, *at))
            for n, slope in enumerate(slopes):
                step = np.zeros(3)
                step[n] = 1e-5 * at[n] if n < 2 else 1e5
                more, less = (float(function(rheology, *(at + sign * step))[0]) for sign in (1, -1))
                exact = (more - less) / (2e-5 if n < 2 else 2e5)
                most = (2e-3 if across and n == 1 else 1e-4) * (abs(value) + 1) * (1 if n < 2 else 1e-9)
                assert slope == pytest.approx(exact, rel=1e-4, abs=most), (wall, r, n)


def test_the_flow_has_one_slope_where_the_oil_begins_to_slip():
    """s (1 + r^2) = 1: neither flow nor derivatives jump."""
    for r in (0.1, 1.0, 8.0, 14.0):
        s = 1 / (1 + r * r)
        before, behind = (np.array(circular_flow(s * (1 + d), r)) for d in (-1e-10, 1e-10))
        np.testing.assert_allclose(before, behind, rtol=1e-5)
        assert circular_slip(0.999 * s, r) == 0 < circular_slip(1.001 * s, r)


def test_no_wall_of_a_limiting_film_holds_more_than_the_limit():
    for r in (*SLIDING, 1e3, 1e6):
        for s in (1e-9, 1e-3, 0.3, 0.9, 1.0, 3.0):
            mean = circular_stress(s, r)
            assert 0 <= mean <= r and mean + min(s, 1.0) <= 1 + 1e-12


@of_every_law
def test_what_slides_adds_at_most_half_of_its_speed(law):
    """Plug flow with one wall is the most that hard sliding adds to what the gradient carries by itself."""
    rheology, scale, gains = LAWS[law], SCALE[law], []
    for wall in walls_of(law):
        for newtonian in (1e3 * scale, 1e5 * scale):
            more = [flows.flow(rheology, wall * scale, one, P)[0] for one in (newtonian, 0.0)]
            gains.append((more[0] - more[1]) * wall * scale / 6 / newtonian)
    assert 0 < min(gains) and max(gains) < 0.5
    assert max(gains) > {"limiting": 0.499, "eyring": 0.43}.get(law, 0.05)


@of_every_law
def test_across_the_sliding_it_is_the_secant(law):
    """For a small gradient across: the viscosity that the law leaves at the stress of the sliding."""
    for r in SLIDING[1:]:
        newtonian = r * SCALE[law]
        left = shear_stress(LAWS[law], newtonian, P) / newtonian
        assert flows.across(LAWS[law], 1.0, 0.0, newtonian, P)[0][0] == pytest.approx(1 / left, rel=1e-5)
        along = whole(LAWS[law], 1e-3 * SCALE[law], newtonian)
        more, less = (shear_stress(LAWS[law], newtonian * one, P) for one in (1.0001, 0.9999))
        slope = (more - less) / 2e-4 / newtonian
        if along < 1e3:  # beyond, a thousandth of the scale on the walls is no small gradient
            assert along == pytest.approx(1 / slope, rel=5e-3)
            assert along > 1 / left


@of_every_law
def test_without_sliding_both_directions_are_one(law):
    for wall in walls_of(law):
        along, across = (parts(LAWS[law], wall * SCALE[law], 0.0, 0.0, P)[0][0] for parts in (flows.along, flows.across))
        assert along == pytest.approx(across, rel=1e-12) and along >= 1.0


def test_a_law_with_only_a_stress_flows_by_the_circle_that_touches_it():
    """Of the circular law it is that law itself; of others it has their slope at small gradients."""
    rheology, scale = LAWS["limiting"], SCALE["limiting"]
    for wall in (1e-3, 0.03, 0.3, 0.9):
        for r in SLIDING:
            known = rheology, wall * scale, r * scale, P
            same = touching_flow(*known)
            assert same[0] == pytest.approx(circular_flow(wall, r)[0], rel=1e-5)
            assert touching_stress(*known) == pytest.approx(scale * circular_stress(wall, r), rel=1e-5, abs=1.0)
            assert touching_slip(*known) == pytest.approx(circular_slip(wall, r), abs=1e-4)
    for law in ("eyring", "carreau"):
        for r in (0.3, 1.0, 3.0):
            found = touching_flow(LAWS[law], 1e-3 * SCALE[law], r * SCALE[law], P)[0]
            assert found == pytest.approx(whole(LAWS[law], 1e-3 * SCALE[law], r * SCALE[law]), rel=1e-3)


def test_a_switch_is_softened_only_beyond_its_bound():
    """One slope at the bound; far beyond it frozen oil is a plug, 1 % less than that of one wall from a small gradient on, and
    the film never carries more than without."""
    for s in (1e-4, 1e-3, 0.3):
        below, above = (np.array(circular_flow(s, MOST_R * (1 + d))) for d in (-1e-9, 1e-9))
        np.testing.assert_allclose(below, above, rtol=1e-6)
        assert below[0] == pytest.approx(column(limiting, s, MOST_R, 1.0)[0], rel=1e-7)
    for r in (100.0, 1e3, 1e5):
        for s in (1e-4, 1e-3, 0.04, 0.1, 0.5):
            carried = circular_flow(s, r)[0] / column(limiting, s, r, 1.0)[0]
            assert carried < 1 + 1e-7 and (carried > 0.99 or s < 0.04)
