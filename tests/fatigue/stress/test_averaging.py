"""Stresses averaged over a length: the closed form of a jump, stresses of averages as averages of stresses, mirrors."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tehl_taichi.fatigue.stress.averaging import AveragedReader, averaged, weights
from tehl_taichi.fatigue.stress.half_space import HalfSpaceStress
from tehl_taichi.fatigue.stress.strip_stress import StripStress

WIDE, LENGTH = 200e-6, 10e-6  # m: of the part with shear, of the average


def at_the_jump(dx, length):
    """sigma_xx at the jump of q_x from 0 to 1 that ends WIDE behind it."""
    x = np.arange(-2 * WIDE, 2 * WIDE + dx / 2, dx)
    q = ((x > -1e-12) & (x < WIDE)).astype(float)
    reader = AveragedReader(Fields(x, np.zeros(1), {"traction_x_a": q[:, None]}), length)
    q = reader.fields(0, ["traction_x_a"])["traction_x_a"][:, 0]
    return float(StripStress(x, 0.3, [0.0])(0 * q[None], q[None])[0, :, 0, 0][np.argmin(np.abs(x + dx / 2))])


class Fields:
    """A reader of one entry."""

    def __init__(self, x, y, fields):
        self.x, self.y, self.time, self.feature_x, self.given = x, y, np.zeros(1), None, fields

    def __len__(self):
        return 1

    def fields(self, n, names):
        return {name: self.given[name] for name in names}


def test_a_jump_of_shear_has_no_stress_at_its_point_and_one_over_a_length():
    """sigma_xx is 2/pi ln(WIDE/|x|) around it: it grows by 2/pi ln 2 from grid to grid; its average over LENGTH is
    2/pi (ln(2 WIDE/LENGTH) + 1) (Johnson 1985, section 2.5)."""
    steps = 2e-6 / 2 ** np.arange(4)
    points, means = (np.array([at_the_jump(dx, length) for dx in steps]) for length in (0.0, LENGTH))
    assert_allclose(np.diff(points), 2 / np.pi * np.log(2), rtol=0.02)
    exact = 2 / np.pi * (np.log(2 * WIDE / LENGTH) + 1)
    assert_allclose(means[-1], exact, rtol=4e-3)
    assert (np.diff(np.abs(means - exact)) < 0).all()


@pytest.mark.parametrize("depth", [0.0, 6e-6])
def test_stresses_of_averages_are_averages_of_stresses(depth):
    """Off the axis, dx unlike dy, on the half domain whose mirror lies on the other side."""
    x, y = (np.arange(n) * d for n, d in ((40, 3e-6), (24, 2e-6)))
    whole = np.concatenate([-y[:0:-1], y])
    fields = dict(zip(("pressure", "traction_x_a", "traction_y_a"), bump(x, whole)))
    half = AveragedReader(Fields(x, y, {name: field[:, y.size - 1 :] for name, field in fields.items()}), LENGTH)
    loads = half.fields(0, list(fields)).values()
    found = HalfSpaceStress(x, y, 0.3, False, True, depth)(*loads)
    points = HalfSpaceStress(x, whole - whole[0], 0.3, False, False, depth)(*fields.values())
    for name, values in found.items():
        smooth = averaged(averaged(points[name], half.along), half.across, 1)[8:-8, y.size - 1 : -8]
        assert_allclose(values[8:-8, : smooth.shape[1]], smooth, atol=3e-6 * max(np.abs(v).max() for v in points.values()))


def bump(x, y):
    """(p, q_x, q_y) of a bump away from the ends, q_y odd across."""
    inside = np.exp(-(((x[:, None] - 62e-6) / 14e-6) ** 2) - (y / 12e-6) ** 2)
    return inside, 0.3 * inside * np.sin(x[:, None] / 7e-6), 0.2 * inside * y / 12e-6


@pytest.mark.parametrize("length, spacing, parts", [(10e-6, 4e-6, [0.3, 0.4, 0.3]), (3e-6, 4e-6, [1.0]), (0.0, 1e-6, [1.0])])
def test_weights_are_the_parts_of_the_length_in_each_cell(length, spacing, parts):
    assert_allclose(weights(length, spacing), parts, atol=1e-12)


def test_on_the_half_domain_even_fields_are_mirrored_and_odd_ones_turned():
    y = np.arange(12) * 1e-6
    for sign, odd in ((1, False), (-1, True)):
        half = np.sin(y / 3e-6) if odd else np.cos(y / 3e-6)
        whole = averaged(np.concatenate([sign * half[:0:-1], half]), weights(5e-6, 1e-6))
        assert_allclose(averaged(half, weights(5e-6, 1e-6), mirrored=True, odd=odd), whole[y.size - 1 :], atol=1e-12)
