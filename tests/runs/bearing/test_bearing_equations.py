"""Equations of a bearing: published numbers, limits and balances."""

import dataclasses
import math

import numpy as np
import pytest

from tehl_taichi.runs.bearing import ellipse_slip, kinematics, load_distribution, ring_contacts, stiffness
from tehl_taichi.runs.bearing.designations import DESIGNATIONS
from tehl_taichi.runs.bearing.dry_contact import dry_contact
from tehl_taichi.runs.bearing.rolling_bearing import RollingBearing
from tehl_taichi.runs.bearing.static_safety import safety
from tehl_taichi.scene import hertz

STEEL = 206e9 / 0.91  # Pa, E' of two steel bodies
ISO_STEEL = 207e9 / 0.91  # of ISO/TR 10657
BALLS = dict(diameter=10e-3, count=9, pitch_diameter=50e-3)
ROLLERS = dict(element="roller", diameter=10e-3, count=14, pitch_diameter=65e-3, length=10e-3)


def published(name, **duty):
    return RollingBearing(**{**DESIGNATIONS[name].keys, **duty})


def solved(bearing, E=STEEL):
    contacts = ring_contacts.contacts(bearing)
    return load_distribution.distribution(bearing, stiffness.of_bearing(bearing, contacts, E))


def moving(bearing):
    return kinematics.speeds(bearing, ring_contacts.contacts(bearing))


@pytest.mark.parametrize("ratio, factor", [(0.1, 16.4), (0.15, 15.2), (0.2, 14.0), (0.25, 12.8)])
def test_the_static_factors_of_iso_76_give_its_hertz_pressure(ratio, factor):
    """f0 Z D^2 with Q_max = 5 F/Z is the load of 4200 MPa (osculations 0.52 and 0.53; ISO 76:2006, table 1)."""
    bearing = RollingBearing(diameter=10e-3, count=9, pitch_diameter=10e-3 / ratio)
    Q = 5 * factor * 10.0**2
    pressures = [dry_contact(bearing, contact, Q, ISO_STEEL).p_H for contact in ring_contacts.contacts(bearing).values()]
    assert max(pressures) == pytest.approx(4.2e9, rel=3e-3)
    assert safety(bearing, max(pressures)) == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("name, C0", [("6203", 4.75e3), ("6205", 7.8e3), ("6206", 11.2e3)])
def test_published_balls_have_the_static_rating_of_the_catalogue(name, C0):
    """SKF general catalogue, basic static load ratings: with Q = 5 C0/Z the inner ring has 4200 MPa."""
    bearing = published(name)
    inner = ring_contacts.contacts(bearing)["inner"]
    assert dry_contact(bearing, inner, 5 * C0 / bearing.count, ISO_STEEL).p_H == pytest.approx(4.2e9, rel=5e-3)


def test_curvatures_of_the_209_ball_bearing():
    """Sum and difference of curvatures of Harris & Kotzalas: 0.202 and 0.138 1/mm, 0.9399 and 0.9120."""
    for (ring, contact), (total, difference) in zip(ring_contacts.contacts(published("209")).items(),
                                                    ((202.0, 0.9399), (138.0, 0.9120))):
        rho = 1 / contact.R_x, 1 / contact.R_y
        assert sum(rho) == pytest.approx(total, rel=3e-3), ring
        assert (rho[0] - rho[1]) / sum(rho) == pytest.approx(difference, abs=2e-4), ring


def test_loads_of_three_textbook_bearings():
    """Harris & Kotzalas: 209 ball bearing under 8900 N: 4536 N; 209 roller bearing under 4450 N: 1915 N (Palmgren's line); 218
    under 17800 N thrust: 1676 N at 41.6 degrees."""
    assert solved(published("209", load=8900.0)).largest == pytest.approx(4536, rel=5e-3)
    assert solved(published("209-roller", load=4450.0)).largest == pytest.approx(1915, rel=0.025)
    thrust = solved(published("218", load=0.0, axial=17800.0))
    assert thrust.largest == pytest.approx(1676, rel=3e-3) and math.degrees(thrust.angle) == pytest.approx(41.6, abs=0.15)
    assert np.ptp(thrust.loads) < 1e-6 * thrust.largest and thrust.axial_load == pytest.approx(17800)


@pytest.mark.parametrize("name, inner, outer, cage, ball", [("6205", 5.4152, 3.5848, 0.39828, 4.7135),
                                                            ("6203", 4.9469, 3.0530, 0.3817, 3.9874)])
def test_passes_of_two_published_bearings(name, inner, outer, cage, ball):
    """Per turn of the shaft (Case Western Reserve University, defect frequencies)."""
    found = moving(published(name, speed=60.0))
    assert found.passes["inner"] == pytest.approx(inner, abs=2e-4) and found.passes["outer"] == pytest.approx(outer, abs=2e-4)
    assert found.cage / (2 * math.pi) == pytest.approx(cage, abs=1e-4)  # that of the 6203 is not 3.0530/8 = 0.38163
    assert found.element_passes == pytest.approx(ball, abs=5e-4)


def test_radii_and_speed_of_a_published_roller_bearing():
    """Nine rollers of 16 mm between 64 and 96 mm at 524 rad/s: R 6.4 and 9.6 mm, 10.06 m/s (Hamrock & Anderson 1983, NASA
    RP-1105)."""
    bearing = RollingBearing(element="roller", diameter=16e-3, count=9, pitch_diameter=80e-3, length=16e-3,
                             speed=524 * 30 / math.pi)
    inner, outer = ring_contacts.contacts(bearing).values()
    assert (inner.R_x, outer.R_x) == pytest.approx((6.4e-3, 9.6e-3))
    assert moving(bearing).u_m == pytest.approx(10.061, rel=1e-4)


@pytest.mark.parametrize("keys, constant", [(BALLS, 4.37), (ROLLERS, 4.08)])
def test_stribeck_constants_of_half_a_loaded_ring(keys, constant):
    """Q_max = 4.37 F/Z of balls, 4.08 F/Z of lines without clearance (many small elements)."""
    many = RollingBearing(**{**keys, "count": 301, "diameter": 1e-3, "pitch_diameter": 0.2, "load": 500.0})
    assert solved(many).largest * many.count / many.load == pytest.approx(constant, abs=5e-3)


@pytest.mark.parametrize("keys", [BALLS, {**BALLS, "clearance": 20e-6}, {**BALLS, "axial": 900.0, "clearance": 10e-6},
                                  {**BALLS, "contact_angle": 25.0, "axial": 4000.0}, ROLLERS,
                                  {**ROLLERS, "contact_angle": 15.0, "taper": 4.0, "axial": 1500.0}])
def test_the_loads_of_the_elements_balance_the_load(keys):
    bearing = RollingBearing(**keys, load=3000.0)
    found = solved(bearing)
    normal = np.cos(found.angles)
    assert np.sum(found.loads * normal * np.cos(found.azimuth)) == pytest.approx(3000.0, rel=1e-9)
    assert np.sum(found.loads * normal * np.sin(found.azimuth)) == pytest.approx(0.0, abs=1e-6)
    assert found.axial_load == pytest.approx(bearing.axial, rel=1e-8, abs=1e-6)
    assert found.largest == found.loads.max() and 1 <= found.loaded <= bearing.count


def test_clearance_narrows_the_loaded_zone_and_raises_the_largest_load():
    found = [solved(RollingBearing(**BALLS, load=3000.0, clearance=gap)) for gap in (0.0, 10e-6, 40e-6, 200e-6)]
    assert [one.loaded for one in found] == sorted((one.loaded for one in found), reverse=True)
    assert [one.largest for one in found] == sorted(one.largest for one in found) and found[-1].largest <= 3000 * (1 + 1e-12)


def test_both_displacements_count_from_the_middle_of_the_play():
    """Without axial load there is none along the axis; end play 2 A sin(alpha_0), cos(alpha_0) = 1 - s/(2 A) (Harris)."""
    loose = dict(BALLS, clearance=20e-6)
    A = RollingBearing(**BALLS).groove_distance
    end_play = 2 * A * math.sin(math.acos(1 - 20e-6 / (2 * A)))
    for load, axial, along in ((3000.0, 0.0, 0.0), (3000.0, 1e-3, 0.0), (0.0, 1e-3, end_play / 2)):
        assert solved(RollingBearing(**loose, load=load, axial=axial)).axial == pytest.approx(along, rel=1e-3, abs=1e-9)
    assert solved(RollingBearing(**loose, load=1e-6)).radial == pytest.approx(10e-6, rel=1e-3)
    assert solved(RollingBearing(**loose, load=3000.0)).end_play == pytest.approx(end_play)
    assert solved(RollingBearing(**BALLS, load=3000.0)).end_play == solved(RollingBearing(**ROLLERS, load=3000.0)).end_play == 0


def test_clearance_is_a_free_contact_angle():
    """A bearing with that contact angle counts from where its balls touch, half the end play from the middle."""
    A = RollingBearing(**BALLS).groove_distance
    given = {"clearance": 20e-6}, {"contact_angle": math.degrees(math.acos(1 - 10e-6 / A))}
    loose, touching = (load_distribution.distribution(RollingBearing(**BALLS, **key, load=0.0, axial=900.0), (1e10, 1.5))
                       for key in given)
    assert touching.end_play == 0 and touching.axial == pytest.approx(loose.axial - loose.end_play / 2)


@pytest.mark.parametrize("keys, power", [(BALLS, 1.5), (ROLLERS, 10 / 9)])
def test_without_clearance_all_loads_grow_with_the_load(keys, power):
    once, twice = (solved(RollingBearing(**keys, load=load)) for load in (1000.0, 2000.0))
    assert twice.loads == pytest.approx(2 * once.loads) and twice.radial == pytest.approx(once.radial * 2 ** (1 / power))


def test_equal_grooves_differ_by_the_rings_only():
    """On a very large circle both contacts of an element are equal; what the curvature of one ring adds, the other takes."""
    flat = RollingBearing(diameter=10e-3, count=9, pitch_diameter=5.0, osculation_inner=0.52, osculation_outer=0.52)
    inner, outer = ring_contacts.contacts(flat).values()
    assert inner.R_x == pytest.approx(outer.R_x, rel=5e-3) and inner.R_y == outer.R_y and inner.R_d == outer.R_d
    assert 1 / inner.R_x + 1 / outer.R_x == pytest.approx(4 / flat.diameter + math.cos(0) * (1 / inner.r - 1 / outer.r))


def test_turning_the_other_ring_exchanges_the_speeds():
    """Relative to the cage nothing changes but the sense; passes of a ring follow the ring."""
    inner, outer = moving(RollingBearing(**BALLS, speed=1000.0)), moving(RollingBearing(**BALLS, speed=0.0, outer_speed=1000.0))
    assert inner.u_m == pytest.approx(outer.u_m) and inner.passes == pytest.approx(outer.passes)
    assert inner.cage + outer.cage == pytest.approx(1000 * math.pi / 30)
    both = moving(RollingBearing(**BALLS, speed=1000.0, outer_speed=-1000.0))
    assert both.u_m == pytest.approx(2 * inner.u_m)


def test_both_surfaces_of_a_contact_have_the_entrainment_speed():
    """(omega_ring - omega_cage) r of either ring and omega_element D/2."""
    for keys in (BALLS, {**BALLS, "contact_angle": 30.0}, ROLLERS, {**ROLLERS, "contact_angle": 15.0, "taper": 4.0}):
        bearing = RollingBearing(**keys, speed=1500.0)
        contacts, found = ring_contacts.contacts(bearing), moving(bearing)
        turning = 1500 * math.pi / 30
        assert (turning - found.cage) * contacts["inner"].r == pytest.approx(found.u_m)
        assert found.cage * contacts["outer"].r == pytest.approx(found.u_m) == found.element * bearing.diameter / 2


def test_heathcote_bands_lie_at_a_third_of_the_ellipse():
    """Coulomb friction of a Hertz load balances at y/b = 2 sin 10 deg = 0.347 (Johnson, section 8.5); the slip is a parabola
    u y^2/(2 R_d R_x)."""
    contact = ring_contacts.contacts(RollingBearing(**BALLS))["inner"]
    found = ellipse_slip.slip_over(contact, 2e-3, 3.0)
    assert found.rolling == pytest.approx(2 * math.sin(math.radians(10)), abs=1.1e-3)
    assert np.sum(found.weight * np.sign(found.slip)) == pytest.approx(0.0, abs=2e-3)
    assert (found.edge - found.centre) == pytest.approx(4e-6 / (2 * contact.R_d * contact.R_x), rel=1e-9)
    assert found.centre < 0 < found.edge and found.mean < max(abs(found.slip))


def test_slip_of_both_bodies_follows_from_their_distances_to_their_axes():
    """Speeds of ring and ball at y on the pressed surface of radius R_d, without the formula."""
    for ring, side in (("inner", 1), ("outer", -1)):
        bearing = RollingBearing(**BALLS, speed=1500.0)
        contact, u = ring_contacts.contacts(bearing)[ring], moving(bearing).u_m
        y = 1e-3
        drop = contact.R_d - math.sqrt(contact.R_d**2 - y**2)
        own = u * (1 + side * drop / contact.r) - u * (1 - drop / (bearing.diameter / 2))
        found = ellipse_slip.slip_over(contact, y, u)
        assert found.slip[-1] - found.slip[found.y.size // 2] == pytest.approx(own, rel=0.02)


def test_spin_is_the_part_of_the_rotation_along_the_normal():
    bearing = RollingBearing(**BALLS, contact_angle=40.0, speed=1000.0)
    found = moving(bearing)
    assert found.spin["inner"] == pytest.approx(1000 * math.pi / 30 * math.sin(math.radians(40))) and found.spin["outer"] == 0
    contact = ring_contacts.contacts(bearing)["inner"]
    slip = ellipse_slip.slip_over(contact, 2e-3, found.u_m, found.spin["inner"])
    assert slip.slip[-1] - slip.slip[0] == pytest.approx(2 * found.spin["inner"] * 2e-3)
    assert moving(RollingBearing(**BALLS)).spin["inner"] == 0


def test_crowned_rollers_touch_in_an_ellipse_until_it_is_as_long_as_they_are():
    straight = RollingBearing(**ROLLERS)
    contact = ring_contacts.contacts(straight)["inner"]
    line = dry_contact(straight, contact, 2000.0, STEEL)
    assert line.kind == "line" and line.p_H == hertz.line(2e5, contact.R_x, STEEL)[1] and line.b == 5e-3
    round_ = dataclasses.replace(straight, crown=0.1)
    ellipse = dry_contact(round_, ring_contacts.contacts(round_)["inner"], 2000.0, STEEL)
    assert ellipse.kind == "elliptic" and "slender ellipse" in ellipse.words and 2 * ellipse.b < 10e-3
    crowned = dataclasses.replace(straight, crown=1.5)
    middle = dry_contact(crowned, ring_contacts.contacts(crowned)["inner"], 500.0, STEEL)
    assert middle.kind == "line" and "computed as the line contact of its middle" in middle.words
    a, p_H = hertz.line(middle.scene_load, contact.R_x, STEEL)
    assert p_H == pytest.approx(middle.p_H) and a == pytest.approx(middle.a, rel=0.02) and middle.load == 500.0
    wide = dry_contact(crowned, ring_contacts.contacts(crowned)["inner"], 20000.0, STEEL)
    assert wide.kind == "line" and "the ellipse of the crown would be" in wide.words and wide.scene_load == 2e6


def test_static_safety_grows_with_the_power_of_hertz():
    balls, rollers = RollingBearing(**BALLS), RollingBearing(**ROLLERS)
    assert safety(balls, 2.1e9) == pytest.approx(8) and safety(rollers, 2e9, line=True) == pytest.approx(4)


def test_centrifugal_force_of_a_ball():
    """4 pi/3 r^3 rho omega^2 R by hand: 4.11 g at 100 rad/s on 25 mm: 1.03 N."""
    bearing = RollingBearing(**BALLS, speed=1.0)
    found = dataclasses.replace(moving(bearing), cage=100.0)
    assert kinematics.centrifugal_force(bearing, found, 7850.0) == pytest.approx(7850 * math.pi / 6 * 1e-6 * 250)


@pytest.mark.parametrize("keys, said", [
    ({}, "bearing.diameter is not given; a ball bearing needs diameter, count, pitch_diameter"),
    ({"element": "roller", **BALLS}, "bearing.length is not given; a roller bearing needs"),
    ({**BALLS, "count": 20}, r"bearing.count = 20: balls of 0.01 m on a circle of 0.05 m; allowed: 3 to 15"),
    *(({**ROLLERS, key: 0}, f"bearing.{key} = 0( m)? is out of range; allowed: (more than 0|3 to)")
      for key in ("diameter", "count", "pitch_diameter", "length")),
    ({**BALLS, "count": 3, "diameter": 0.044}, r"circle of 0.05 m; allowed: a diameter of at most 0.0433 m"),
    ({**BALLS, "diameter": 9.5}, "bearing.diameter = 9.5 m is out of range.*did you mean"),
    ({**BALLS, "load": 0.0}, "without a load nothing touches"),
    ({**BALLS, "speed": 0.0}, "the elements do not roll, and there is no film"),
    ({**BALLS, "crown": 1.0}, "bearing.crown = 1 has no effect on a ball"),
    ({**ROLLERS, "osculation_inner": 0.54}, "bearing.osculation_inner = 0.54 has no effect on a roller"),
    ({**ROLLERS, "axial": 10.0}, "cylindrical rollers carry no axial load"),
    ({**ROLLERS, "contact_angle": 5.0, "taper": 12.0}, "allowed: a taper of less than twice the contact angle"),
    ({**BALLS, "contact_angle": 40.0, "clearance": 1e-5}, "the contact angle already includes the clearance"),
    ({**BALLS, "osculation_inner": 0.5}, "bearing.osculation_inner = 0.5 is out of range")])
def test_impossible_bearings_are_refused(keys, said):
    from tehl_taichi.errors import SceneError

    with pytest.raises(SceneError, match=said):
        RollingBearing(**keys)


def test_an_axial_load_that_tapered_rollers_cannot_balance_is_refused():
    from tehl_taichi.errors import SceneError

    bearing = RollingBearing(**ROLLERS, contact_angle=15.0, taper=4.0, load=3000.0, axial=100.0)
    with pytest.raises(SceneError, match=r"axial = 100 N is too little .* allowed: at least 8\d\d\.?\d* N, or 0 N") as said:
        solved(bearing)
    least = float(str(said.value).partition("at least ")[2].split()[0])
    assert solved(dataclasses.replace(bearing, axial=1.001 * least)).axial_load == pytest.approx(1.001 * least)
    with pytest.raises(SceneError, match="is too little"):
        solved(dataclasses.replace(bearing, axial=0.999 * least))
