"""Properties of bearings that need no published number: geometry, energy, powers of the load, and the numbers of records and
figures."""

import dataclasses
import math

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.runs.bearing import bearing_figure, bearing_table, kinematics, load_distribution, ring_contacts, stiffness
from tehl_taichi.runs.bearing.rolling_bearing import RollingBearing

STEEL = 206e9 / 0.91  # Pa, E' of two steel bodies
BALLS = dict(diameter=10e-3, count=9, pitch_diameter=50e-3)
ANGULAR = dict(BALLS, contact_angle=25.0)
ROLLERS = dict(element="roller", diameter=10e-3, count=14, pitch_diameter=65e-3, length=10e-3)
TAPERED = dict(ROLLERS, contact_angle=25.0, taper=10.0)


def solved(bearing, E=STEEL):
    return load_distribution.distribution(bearing, stiffness.of_bearing(bearing, ring_contacts.contacts(bearing), E))


def mechanics(folder, *named, **keys):
    """The bearing without its runs."""
    return tehl.bearing(*named, run=False, folder=folder / "b", **keys)


@pytest.fixture(scope="module")
def dry(tmp_path_factory):
    return mechanics(tmp_path_factory.mktemp("dry"), "6206", load=3000.0, speed=1500.0)


@pytest.mark.parametrize("keys", [BALLS, dict(BALLS, contact_angle=30.0), ROLLERS, TAPERED])
def test_both_contacts_lie_at_equal_distances_from_the_pitch_circle(keys):
    """They are the ends of one diameter of the element."""
    contacts = ring_contacts.contacts(RollingBearing(**keys))
    assert contacts["inner"].r + contacts["outer"].r == pytest.approx(keys["pitch_diameter"], rel=1e-12)


def cone_curvature(radius, nu, beside=1e-5):
    """Curvature (1/m) of a cone in the plane across its generator, by the depth of its surface `beside` it (m).

    At depth d the distance from the axis is hypot(radius - d cos(nu), beside), which the cone has where its radius is
    radius + d sin(nu) tan(nu).
    """
    c, grows = math.cos(nu), math.sin(nu) * math.tan(nu)
    return 2 * min(np.roots([c**2 - grows**2, -2 * radius * (c + grows), beside**2])) / beside**2


@pytest.mark.parametrize("ring, side", [("inner", 1), ("outer", -1)])
def test_tapered_rollers_have_the_curvature_of_their_section(ring, side):
    bearing = RollingBearing(**TAPERED)
    contact = ring_contacts.contacts(bearing)[ring]
    own = cone_curvature(bearing.diameter / 2, bearing.nu)
    assert 1 / contact.R_x == pytest.approx(own + side * math.cos(contact.angle) / contact.r, rel=1e-4)


def test_the_pressed_surface_has_the_mean_curvature_of_ball_and_groove():
    """Equal bodies bend equally (Hertz)."""
    bearing = RollingBearing(**BALLS)
    for ring, osculation in (("inner", bearing.osculation_inner), ("outer", bearing.osculation_outer)):
        R_d, groove = ring_contacts.contacts(bearing)[ring].R_d, osculation * bearing.diameter
        assert bearing.diameter / 2 < R_d < groove
        assert 1 / R_d == pytest.approx((2 / bearing.diameter + 1 / groove) / 2)


@pytest.mark.parametrize("keys, power", [(BALLS, 2 / 3), (ROLLERS, 0.9)])
def test_steel_of_twice_the_modulus_approaches_as_the_power_of_its_contact_says(keys, power):
    """Q = c delta^n with c proportional to E': delta falls with E'^(1/n), of lines as of points."""
    soft, stiff = (solved(RollingBearing(**keys, load=2000.0), E) for E in (STEEL, 2 * STEEL))
    assert soft.radial / stiff.radial == pytest.approx(2**power)


@pytest.mark.parametrize("keys", [dict(TAPERED, axial=3000.0), ROLLERS, dict(ANGULAR, axial=2000.0)])
def test_forces_are_the_slope_of_the_elastic_energy(keys):
    """Of sum c delta^(n + 1)/(n + 1), against both displacements of the ring."""
    bearing = RollingBearing(**keys, load=2000.0)
    c, n = stiffness.of_bearing(bearing, ring_contacts.contacts(bearing), STEEL)
    ring = load_distribution._Displaced(bearing, c, n)

    def energy(radial, axial):
        return np.sum(c / (n + 1) * np.maximum(ring.compression(radial, axial)[0], 0.0) ** (n + 1))

    radial, axial, step = 10e-6, 3e-6, 1e-9
    along = (energy(radial + step, axial) - energy(radial - step, axial)) / (2 * step)
    across = (energy(radial, axial + step) - energy(radial, axial - step)) / (2 * step)
    assert ring.forces(radial, axial) == pytest.approx((along, across), rel=1e-5, abs=1e-3)


def test_a_roller_as_long_as_thick_weighs_one_and_a_half_balls():
    """Archimedes: a cylinder around a sphere."""
    balls, rollers = (RollingBearing(**{**BALLS, **more}) for more in ({}, {"element": "roller", "length": 10e-3}))
    moving = dataclasses.replace(kinematics.speeds(balls, ring_contacts.contacts(balls)), cage=100.0)
    forces = [kinematics.centrifugal_force(bearing, moving, 7850.0) for bearing in (balls, rollers)]
    assert forces[1] / forces[0] == pytest.approx(1.5)


def test_the_torque_is_that_of_the_speed_between_the_rings():
    """Power over relative speed: a ring that turns back counts as the other one turning faster."""
    found = {"steady": {"friction_coefficient": 0.05}}
    ring = {"summary": found, "slip": {"mean_m_s": 0.02}, "load_N": 800.0, "spin_rad_s": 0.0}
    record = {"inner": ring, "outer": ring, "ball_load_max_N": 800.0, "loads_N": [800.0, 0.0]}

    def torque(speed, outer):
        return bearing_table.slip_torque({**record, "geometry": {"speed": speed, "outer_speed": outer}})[1]

    assert torque(2000.0, -1000.0) == pytest.approx(torque(3000.0, 0.0))


def test_lambda_is_that_of_the_central_film():
    ring = {"summary": {"steady": {"h_c_m": 4e-7, "h_min_m": 3e-7}}}
    assert bearing_table.film_ratio({"roughness_Sq_m": 1e-7}, ring) == pytest.approx(4.0)


@pytest.mark.parametrize("keys", [BALLS, ROLLERS])
def test_twice_the_load_halves_the_static_safety(keys, tmp_path):
    """It is a ratio of loads, for balls and for rollers: without clearance all loads grow with that of the bearing."""
    once, twice = (mechanics(tmp_path / str(load), "b", dimensions=keys, load=load, speed=1500.0).rings
                   for load in (1500.0, 3000.0))
    for ring in once:
        assert once[ring]["static_safety"] == pytest.approx(2 * twice[ring]["static_safety"], rel=1e-6)


def test_the_slip_of_a_record_reaches_to_the_end_of_the_ellipse(dry):
    for ring in dry.rings.values():
        assert ring["slip"]["y_m"][-1] == pytest.approx(ring["b_m"])


def test_the_cage_carries_all_balls_past_the_ring_at_rest(dry):
    """And they pass both rings together as often as the shaft turns, times their number."""
    passes = {name: ring["passes_per_s"] for name, ring in dry.rings.items()}
    count = dry.record["geometry"]["count"]
    assert dry.record["cage_speed_1_min"] / 60 * count == pytest.approx(passes["outer"])
    assert sum(passes.values()) == pytest.approx(count * 1500 / 60)


def test_balls_spin_at_the_contact_angle_under_load(tmp_path):
    found = mechanics(tmp_path, "218", load=0.0, axial=17800.0)
    angle, speed = math.radians(found.record["contact_angles_deg"][0]), found.record["geometry"]["speed"] * math.pi / 30
    assert found.rings["inner"]["spin_rad_s"] == pytest.approx(speed * math.sin(angle))


def test_the_drawn_pressure_carries_the_load(dry):
    """Along x each row is half an ellipse, pi/2 p a sqrt(1 - y^2/b^2)."""
    for name, (y, p) in bearing_figure.pressures(dry).items():
        ring = dry.rings[name]
        rows = np.pi / 2 * p * 1e9 * ring["a_m"] * np.sqrt(1 - (y * 1e-3 / ring["b_m"]) ** 2)
        assert np.trapezoid(rows, y * 1e-3) == pytest.approx(ring["load_N"], rel=2e-3)


def test_drawn_loads_stand_at_their_elements(dry):
    azimuth, loads = bearing_figure.azimuths(dry)
    drawn = dict(zip(azimuth.round(), loads))
    for at, load in zip(dry.record["azimuths_deg"], dry.record["loads_N"]):
        assert drawn[round((at + 180) % 360 - 180)] == load
    assert azimuth[np.argmax(loads)] == 0
