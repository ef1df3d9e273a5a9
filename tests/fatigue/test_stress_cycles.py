"""Rainflow cycles of histories that repeat, and those of a critical plane that exceed the limit."""

from types import SimpleNamespace

import numpy as np
import pytest

from tehl_taichi.fatigue import stress_cycles
from tehl_taichi.fatigue.stress_cycles import from_largest, rainflow

pytestmark = pytest.mark.usefixtures("taichi_cpu")
ASTM = [-2, 1, -3, 5, -1, 3, -4, 4, -2]  # figure 6 of ASTM E1049-85
FATIGUE = SimpleNamespace(criterion="findley", kappa=0.3, endurance=100e6)


def ranges(values):
    found, = from_largest(np.asarray(values, float))
    return sorted(float(abs(found[a] - found[b])) for a, b, _ in rainflow(found))


def test_the_example_of_the_standard():
    """From its largest value on (figure 7 there): 3 (1 to -2), 4 (-1 to 3), 7 (4 to -3) and 9 (5 to -4), one each."""
    assert ranges(ASTM) == [3.0, 4.0, 7.0, 9.0]


@pytest.mark.parametrize("start", [1, 4, 7])
def test_the_beginning_of_a_history_that_repeats_changes_nothing(start):
    assert ranges(np.roll(ASTM, start)) == ranges(ASTM) == ranges([*ASTM, *ASTM])[::2]


@pytest.mark.parametrize("count", [1, 5])
def test_waves_are_as_many_cycles(count):
    x = np.linspace(0, 2 * np.pi * count, 400)
    found = ranges(np.sin(x))
    assert found == pytest.approx([2.0] * count, rel=1e-3)


def test_small_waves_on_a_large_one_are_cycles_of_their_own():
    x = np.linspace(0, 2 * np.pi, 2000)
    found = ranges(-10 * np.cos(x) + np.sin(20 * x))
    assert len(found) == 20 and found[-1] > 20 and max(found[:-1]) < 2.1


def history(shear, normal):
    """sxz and szz of the plane along the surface; the last moment unloaded."""
    out = np.zeros((shear.size + 1, 6))
    out[:-1, 4], out[:-1, 2] = shear, normal
    return out


@pytest.mark.parametrize("amplitude, count", [(90e6, 0), (101e6, 4)])
def test_cycles_above_the_limit_are_those_of_their_amplitude(amplitude, count):
    x = np.linspace(0, 2 * np.pi * 4, 801)
    found = stress_cycles.above(history(amplitude * np.sin(x), 0 * x), np.array([0.0, 0.0, 1.0]), FATIGUE)
    assert found == count


def test_tension_counts_while_a_cycle_lasts():
    """Waves of 90 MPa, and 50 MPa of tension during the second of them: 90 + 0.3 50 > 100 MPa there and for the outermost."""
    x = np.linspace(0, 2 * np.pi * 4, 801)
    during = np.where((x > 2.6 * np.pi) & (x < 4.4 * np.pi), 50e6, -50e6)
    found = [stress_cycles.above(history(90e6 * np.sin(x) * (1 + 1e-3 * x), one), np.array([0.0, 0.0, 1.0]), FATIGUE)
             for one in (during, 0 * x - 50e6, 0 * x + 50e6)]
    assert found[1] == 0 and found[2] == 4 and 1 <= found[0] <= 3


@pytest.mark.parametrize("moment, count", [(1.5, 1), (2.5, 2), (3.5, 2), (3.85, 2), (3.97, 1)],
                         ids=["before it begins", "on its way", "on its way back", "as it closes", "after it is closed"])
@pytest.mark.parametrize("sign", [1, -1])
def test_a_cycle_lasts_until_the_shear_is_back_at_its_beginning(moment, count, sign):
    """From 90 to -90 MPa and back, beside the cycle of -110 to 110 MPa, which always counts; 50 MPa of tension for a moment."""
    x = np.linspace(0, 4, 1601)
    shear = sign * np.interp(x, np.arange(5), [110e6, -110e6, 90e6, -90e6, 110e6])  # it is back at 90 MPa at x = 3.9
    tension = np.where(abs(x - moment) < 0.02, 50e6, 0.0)
    assert stress_cycles.above(history(shear, tension), np.array([0.0, 0.0, 1.0]), FATIGUE) == count


@pytest.mark.parametrize("size, counts", [(50e6, {1, 2, 3, 4}), (20e6, {0})])
def test_under_an_equal_stress_in_all_directions_normal_and_mean_stress_are_one(size, counts):
    """Four waves of up to 90 MPa, the third the largest; tension while a half of one lasts."""
    x = np.linspace(0, 2 * np.pi * 4, 801)
    shear, found = 90e6 * np.sin(x) * (1 - 1e-3 * abs(x - 14)), []
    for first in np.pi * np.arange(8):
        stress = history(shear, np.where((x > first + 0.2) & (x < first + 2.9), size, -size))
        stress[:, :2] = stress[:, 2:3]
        each = [SimpleNamespace(criterion=name, kappa=0.3, endurance=1e8) for name in ("findley", "dang-van")]
        one, other = (stress_cycles.above(stress, np.array([0.0, 0.0, 1.0]), local) for local in each)
        assert one == other
        found.append(one)
    assert set(found) <= counts and len(set(found)) > (size > 3e7)


def test_the_direction_of_the_shear_does_not_matter():
    x = np.linspace(0, 2 * np.pi * 3, 601)
    turned = np.zeros((602, 6))
    turned[:-1, 4], turned[:-1, 5] = 110e6 * np.sin(x) * np.cos(0.7), 110e6 * np.sin(x) * np.sin(0.7)
    assert stress_cycles.above(turned, np.array([0.0, 0.0, 1.0]), FATIGUE) == 3


@pytest.mark.parametrize("share, count", [(0.04, 1), (0.06, 21)])
def test_cycles_of_less_than_a_twentieth_of_the_limit_are_noise(share, count):
    """Under a tension by which every cycle exceeds the limit: twenty small waves inside one of 60 MPa."""
    small = share * 100e6 * np.tile([1.0, -1.0], 20)
    shear = np.concatenate([[60e6, -60e6], small])
    assert stress_cycles.above(history(shear, 400e6 + 0 * shear), np.array([0.0, 0.0, 1.0]), FATIGUE) == count


@pytest.mark.parametrize("moment, count", [(2, 2), (4, 2), (5, 1)])
def test_the_moments_at_which_a_cycle_begins_and_closes_are_its_own(moment, count):
    """From 90 to -90 MPa and back, with tension at one moment; the cycle of 110 MPa around it always counts."""
    shear, tension = np.array([110.0, -110.0, 90.0, -90.0, 90.0, 100.0, 110.0]) * 1e6, np.zeros(7)
    tension[moment] = 50e6
    assert stress_cycles.above(history(shear, tension), np.array([0.0, 0.0, 1.0]), FATIGUE) == count
