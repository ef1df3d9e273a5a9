"""Tables and figure of a bearing against its record, of which every number is another one: values, units, places."""

import math
import re

import pytest

import tehl_taichi as tehl
from tehl_taichi.runs.bearing import bearing_figure, bearing_table
from tehl_taichi.runs.bearing.stored_bearing import Bearing
from tehl_taichi.scene.scales import Scales

FACTORS = {"mm": 1e3, "um": 1e6, "GPa": 1e-9, "MPa": 1e-6}  # of printed units, from SI
RESULTS = {"steady": ("h_c_m", "h_min_m", "film_max_C", "friction_coefficient"), "transient": ("p_max_Pa", "h_min_m"),
           "fatigue": ("Fi_max",), "below": ("Fi_max",), "von_mises": ("max_Pa",), "life": ("passages", "hours")}
PARTS = {"passage_": "transient", "von_mises_": "von_mises"}  # that a name of a row begins with


def numbered():
    """Summary whose numbers and errors all differ: {part: {key: value, "error": ...}}."""
    counted = iter(range(1, 100))
    found = {part: {key: 1.01 * next(counted) for key in keys} for part, keys in RESULTS.items()}
    for numbers in found.values():
        numbers["error"] = {key: 0.001 * next(counted) for key in numbers}
    found["fatigue"]["below"] = found.pop("below")
    return {**found, "lambda": 2.5}


@pytest.fixture(scope="module")
def loaded(tmp_path_factory):
    """An angular-contact bearing with slip and both displacements, and made-up results."""
    found = tehl.bearing("218", load=9000.0, axial=17800.0, speed=1500.0, run=False,
                         folder=tmp_path_factory.mktemp("b") / "b218", changes={"bodies.b.E": 310e9, "bodies.b.nu": 0.27})
    rings = {name: {**one, "summary": numbered()} for name, one in found.rings.items()}
    return Bearing(found.folder, {**found.record, **rings})


def number_of(ring, name):
    """(value, error) in the record of a ring that the name of a row means."""
    part = next((part for begin, part in PARTS.items() if name.startswith(begin)), "")
    key = re.sub("^(passage|von_mises|slip)_|_below$", "", name)
    found = {"below": ring["summary"]["fatigue"]["below"]} if name.endswith("_below") else {
        one: ring["summary"][one] for one in ([part] if part else RESULTS) if one in ring["summary"]}
    own = [(one[key], one["error"][key]) for one in found.values() if key in one]
    return own[0] if own else (ring["slip"][key] if key in ring["slip"] else ring.get(key), None)


@pytest.mark.parametrize("row", bearing_table.ROWS, ids=lambda row: row.name)
def test_a_row_shows_the_number_of_its_name_in_the_unit_of_its_label(loaded, row):
    assert row.factor == FACTORS.get(row.head.split()[-1], 1)
    for ring in loaded.rings.values():
        if row.name not in ("lambda", "sliding_loss_W", "Fi_judged", "contact"):
            value, error = number_of(ring, row.name)
            assert (row.value(loaded.record, ring) or 0.0, row.error(loaded.record, ring)) == (value, error)


def test_facts_are_in_the_units_that_they_name(loaded):
    """The torque and the speed give the loss."""
    one, facts = loaded.record, dict(bearing_table.facts(loaded))
    for label, key, factor in (("radial displacement", "radial_displacement_m", 1e6), ("axial load", "axial_load_N", 1),
                               ("axial displacement", "axial_displacement_m", 1e6)):
        assert float(facts[label].split()[0]) == pytest.approx(one[key] * factor, abs=0.06), label
    assert abs(one["axial_displacement_m"] - one["radial_displacement_m"]) > 1e-6
    still = {ring: {**part, "spin_rad_s": 0.0} for ring, part in loaded.rings.items()}
    facts = dict(bearing_table.facts(Bearing(loaded.folder, {**one, **still})))
    power, torque = facts["sliding loss of all contacts"], facts["friction torque of the slip"]
    assert power.endswith(" W") and torque.endswith(" N mm")
    power, torque = (float(text.split()[0]) for text in (power, torque))
    assert torque * 1e-3 * 1500 * math.pi / 30 == pytest.approx(power, rel=0.01)


def test_elements_are_listed_under_the_heads_of_their_numbers(loaded):
    heads, rows = bearing_table.elements(loaded)
    columns = dict(zip(heads, zip(*rows)))
    for head, key in (("azimuth, deg", "azimuths_deg"), ("load, N", "loads_N"), ("contact angle, deg", "contact_angles_deg")):
        assert list(map(float, columns[head])) == pytest.approx(loaded.record[key], abs=0.06), head


def test_displacements_load_the_element_under_the_load(loaded):
    """Its compression, of grooves that move apart along both axes, and the stiffness of the contacts give its load."""
    from tehl_taichi.runs.bearing import ring_contacts, stiffness
    from tehl_taichi.runs.bearing.bearing_source import bearing_source
    from tehl_taichi.scene.scales import reduced_modulus

    one = loaded.record
    which = bearing_source("218", {}).bearing
    E = reduced_modulus(tehl.scene(one["inner"]["scene_file"]))
    c, n = stiffness.of_bearing(which, ring_contacts.contacts(which), E)
    A = which.groove_distance
    delta = math.hypot(A * math.sin(which.alpha) + one["axial_displacement_m"],
                       A * math.cos(which.alpha) + one["radial_displacement_m"]) - A
    assert c * delta**n == pytest.approx(one["ball_load_max_N"])


def test_materials_are_those_of_the_scene_by_body(loaded):
    """Body a is the ring, body b the element."""
    scene = tehl.scene(loaded.rings["inner"]["scene_file"])
    assert scene.body_b.E == 310e9 != scene.body_a.E
    assert loaded.record["materials"]["element"].endswith("E = 310 GPa, nu = 0.27")
    assert loaded.record["materials"]["ring"].endswith(f"E = {scene.body_a.E / 1e9:g} GPa, nu = {scene.body_a.nu:g}")


def test_a_centrifugal_force_is_compared_with_the_largest_load(tmp_path):
    found = tehl.bearing("218", load=1000.0, speed=6000.0, run=False, folder=tmp_path / "b")
    said, = (one for one in found.record["assumptions"] if "centrifugal" in one)
    force, share = map(float, re.search(r"\((\S+) N per element, (\S+)% of", said).groups())
    assert share / 100 == pytest.approx(force / found.record["ball_load_max_N"], abs=0.006)


def test_both_panels_of_a_contact_end_where_it_ends(loaded):
    """Hertz pressure and slip over y in mm, at the half-axis of the scene."""
    pressures, slip = bearing_figure.pressures(loaded), bearing_figure.slip(loaded)
    for name, ring in loaded.rings.items():
        b = Scales.of(tehl.scene(ring["scene_file"])).b * 1e3
        for y, _ in (pressures[name], slip[name]):
            assert (y[0], y[-1]) == pytest.approx((-b, b))


def test_rollers_of_a_common_apex_are_cones_through_it():
    """Their lines are L = D/(2 sin nu) long up to the contact, where the radius of curvature of a cone is L tan(half angle)."""
    from tehl_taichi.runs.bearing import ring_contacts
    from tehl_taichi.runs.bearing.rolling_bearing import RollingBearing

    D, alpha, nu = 10e-3, math.radians(15), math.radians(2)
    bearing = RollingBearing(element="roller", diameter=D, count=10, length=10e-3, contact_angle=15.0, taper=4.0,
                             pitch_diameter=D / math.tan(nu) * math.sin(alpha - nu))
    L = D / (2 * math.sin(nu))
    for (ring, contact), angle, side in zip(ring_contacts.contacts(bearing).items(), (alpha - 2 * nu, alpha), (1, -1)):
        assert contact.r == pytest.approx(L * math.sin(angle)) and contact.angle == pytest.approx(angle), ring
        assert 1 / contact.R_x == pytest.approx((1 / math.tan(nu) + side / math.tan(angle)) / L), ring


def test_the_slip_at_the_end_is_that_of_the_faster_end():
    """Of the driven side of a spin, whichever it is."""
    from tehl_taichi.runs.bearing import ring_contacts
    from tehl_taichi.runs.bearing.ellipse_slip import slip_over
    from tehl_taichi.runs.bearing.rolling_bearing import RollingBearing

    contact = ring_contacts.contacts(RollingBearing(diameter=10e-3, count=9, pitch_diameter=50e-3, contact_angle=30.0))["inner"]
    one, other = (slip_over(contact, 2e-3, 3.0, spin) for spin in (50.0, -50.0))
    assert one.edge == pytest.approx(other.edge) == pytest.approx(one.slip.max() / 3.0) and one.edge > abs(one.slip.min() / 3.0)


def test_a_slender_ellipse_is_named_with_its_length_and_its_ratio():
    from tehl_taichi.runs.bearing import ring_contacts
    from tehl_taichi.runs.bearing.dry_contact import dry_contact
    from tehl_taichi.runs.bearing.rolling_bearing import RollingBearing

    rollers = RollingBearing(element="roller", diameter=10e-3, count=14, pitch_diameter=65e-3, length=12e-3, crown=1.5)
    contact = ring_contacts.contacts(rollers)["inner"]
    found = dry_contact(rollers, contact, 500.0, 226e9)
    numbers = re.search(r"ellipse, (\S+) mm of (\S+) mm; .* R_y/R_x = (\S+) exceeds", found.words)
    length, whole, ratio = map(float, numbers.groups())
    assert (length / 2e3, whole / 1e3, ratio) == pytest.approx((found.b, 12e-3, contact.R_y / contact.R_x), rel=5e-3)
