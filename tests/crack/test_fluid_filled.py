"""Oil in a crack: its limits, what is kept when the mouth shuts, and a flow that is known in closed form."""

from types import SimpleNamespace

import numpy as np
import pytest
from values.test_registry import hold

from tehl_taichi.crack.compliance import CrackFaces
from tehl_taichi.crack.filling import Fluid
from tehl_taichi.crack.fillings import FILLINGS, along_crack
from tehl_taichi.crack.fluid_filled import FluidFilledCrack

SOLID = 1e60  # Pa s: does not flow
STIFF = Fluid(lambda p: 1.0 + 0 * p, lambda p: 1e-2 + 0 * p)
SOFT = Fluid(lambda p: 1 / (1 - p / 20e9), lambda p: 1e-2 + 0 * p)


def wet(loads, mouth, fluid=STIFF, friction=0.0, dt=1.0, degrees=60):
    """A crack of 20 um under loads (xx at the surface, xx per 20 um, xz) GPa, with these film pressures, GPa."""
    faces = CrackFaces(np.array([0, 20e-6 * np.exp(1j * np.radians(degrees))]), 226e9, 12)
    depth = faces.points.imag / 20e-6
    stress = 1e9 * np.stack([np.stack([a + b * depth, 0 * depth, c + 0 * depth], axis=-1) for a, b, c in loads], axis=1)
    times = dt * np.arange(len(loads))
    return FluidFilledCrack(faces, faces.forces(stress), 1e9 * np.array(mouth, float), 1.0, times, friction, fluid, 12)


@pytest.mark.parametrize("cell", [0, 4, 11])
def test_oil_resists_by_the_viscosity_of_its_own_cell(cell):
    """Twice as viscous in one cell: twice as much of its two halves, which belong to the flows on both of its sides."""
    filled = wet([(0.2, 0, 0)], [0.1], Fluid(lambda p: 1.0 + 0 * p, lambda p: 1.0 + p))
    shut = np.zeros(filled.faces.opening().shape[1])
    thin, thick = (along_crack._resistance(SimpleNamespace(wet=filled), shut, p) for p in (np.zeros(12), np.eye(12)[cell]))
    changed = np.flatnonzero(np.abs(thick - thin) > 1e-9 * thin)
    assert changed.tolist() == [n for n in (cell, cell + 1) if n < 12] and (thick <= 2 * thin * (1 + 1e-12)).all()


@pytest.mark.parametrize("name", FILLINGS)
def test_every_filling_has_a_number_that_comes_out(name):
    hold(FILLINGS[name])


# opened by a pull, shut at the mouth, pressed more, sheared
SHUT = [(0.2, 0, 0), (-1, 2, 0), (-2, 4, 0.3), (-3, 6, -0.3), (-3, 5, 0)]
FILM = [0.1, 0.2, 0.5, 0.5, 0.2]


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("fluid", [STIFF, SOFT], ids=["incompressible", "compressible"])
def test_what_is_shut_in_stays_what_it_was(fluid, friction):
    """Mass, and volume where the oil has one density: 1e-6, while the mouth is pressed together; where the crack has room for
    more, without pressure."""
    crack = wet(SHUT, FILM, fluid, friction)
    found = FILLINGS["sealed"].inside(crack)
    mass = fluid.compression(found.pressure) * (crack.faces.pushed() @ found.values)
    shut, empty = np.flatnonzero(found.held[0] > 0), found.pressure == 0
    assert 2 in shut and 0 not in shut and found.missed == 0 and found.pressure[2] > 3e8
    np.testing.assert_allclose(found.content[shut], found.content[shut - 1], rtol=1e-6)
    np.testing.assert_allclose(mass[~empty], found.content[~empty], rtol=1e-6)
    assert (mass[empty] > found.content[empty]).all() and empty.any() == (friction > 0)
    assert (found.pressure[found.held[0] == 0] >= crack.mouth[found.held[0] == 0]).all()


def test_oil_that_opens_the_mouth_is_let_out():
    """Evenly pressed with 1 GPa, a normal crack loses all of it, and the pressure that just holds the faces is that of the
    load."""
    found = FILLINGS["sealed"].inside(wet([(0.2, 0, 0), (-1, 0, 0)], [0.1, 0.0], degrees=90))
    assert found.pressure[1] == pytest.approx(1e9, rel=1e-6) and found.content[1] < 1e-6 * found.content[0]


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("name", ["sealed", "flow"])
def test_without_oil_it_is_dry(name, friction):
    """Shut at the mouth from the beginning, or with oil that does not flow: what opens below is empty. No suction."""
    loads, mouth = [(-1, 0, 0), (-2, 1, 0.4), (-1, 3, 0.4), (-2, 3, 0.2)], [0, 0.1, 0.1, 0.1]
    fluid = Fluid(SOFT.compression, lambda p: SOLID + 0 * p, 1e-11)
    dry, shut = (FILLINGS[one].inside(wet(loads, mouth, fluid, friction)) for one in ("dry", name))
    np.testing.assert_allclose(shut.values, dry.values, atol=1e-3 * np.abs(dry.values).max())
    assert dry.values[8].max() > 0 == shut.pressure.max() and shut.missed == 0


@pytest.mark.parametrize("friction,rel", [(0.0, 2e-6), (0.3, 1e-3)])
def test_slow_flow_is_the_films_pressure(friction, rel):
    """Minutes between two moments; faces that rub have gone another way there, but for little."""
    slow, film = (FILLINGS[one].inside(wet(SHUT, FILM, SOFT, friction, dt=100.0)) for one in ("flow", "film"))
    np.testing.assert_allclose(slow.values, film.values, atol=rel * np.abs(film.values).max())
    np.testing.assert_allclose(slow.pressure, film.pressure, rtol=2e-5)
    assert slow.missed == 0
    fast = FILLINGS["flow"].inside(wet(SHUT, FILM, SOFT, friction, dt=1e-6))
    assert abs(fast.pressure[1] - film.pressure[1]) > 0.5 * film.pressure[1]


def test_what_does_not_flow_stays():
    """A year in a crack whose oil is solid: content as at the first moment, at every moment."""
    found = FILLINGS["flow"].inside(wet(SHUT, FILM, Fluid(SOFT.compression, lambda p: SOLID + 0 * p)))
    np.testing.assert_allclose(found.content, found.content[0], rtol=1e-9)


def test_a_crack_that_is_filled_through_its_gap():
    """Faces so stiff that only their gap is open, its oil compressible: pressure diffuses with gap^2 K/(12 eta), and the tip
    has 1 - 4/pi sum (-1)^n/(2n + 1) exp(-((2n + 1) pi/2)^2 t) of that at the mouth (Carslaw & Jaeger), t in a^2/diffusivity."""
    gap, K, eta, a, count = 1e-6, 2e9, 0.1, 20e-6, 40
    faces = CrackFaces(np.array([0, 1j * a]), 1e20, 48)
    t = np.linspace(0, 1.5, 3 * count + 1)
    fluid = Fluid(lambda p: 1 / (1 - p / K), lambda p: eta + 0 * p, gap)
    mouth = np.where(t > 0, 1e6, 0.0)
    times = t * a * a * 12 * eta / (gap * gap * K)
    forces = np.zeros((2 * faces.nodes, t.size))
    found = FILLINGS["flow"].inside(FluidFilledCrack(faces, forces, mouth, 1.0, times, 0.0, fluid, 48))
    n = np.arange(60)[:, None]
    known = 1 - (4 / np.pi * (-1.0) ** n / (2 * n + 1) * np.exp(-(((2 * n + 1) * np.pi / 2) ** 2) * t)).sum(axis=0)
    np.testing.assert_allclose(found.pressure[1:] / 1e6, known[1:], atol=0.01)
    assert found.missed == 0 and known[10] < 0.1 and known[-1] > 0.9
