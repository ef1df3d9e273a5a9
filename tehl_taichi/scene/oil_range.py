"""Whether the laws of an oil have values at the pressures and the temperature of a scene, and what they leave out."""

import dataclasses
import math

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.limits import GAMMA_MEASURED, P_MEASURED
from tehl_taichi.scene.oil import OILS
from tehl_taichi.scene.scales import Scales

SPARE = 0.3  # least density over rho0 and least factor of the heat capacity that its laws may leave
BARUS_HOLDS = 0.5e9  # Pa: beyond it exp(alpha p) is orders of magnitude above what viscometers find
FREE_OF_TEMPERATURE = {"roelands": (), "table": (), "barus": ("beta_eta",), "houpert": ("S0",)}  # where these numbers are 0
HEAT = ("rho0", "D1", "D2", "beta0", "beta_c", "k0", "k1", "k2", "c0", "c1", "c2", "b0", "b1", "b2")


def check(scene):
    """Refuse an oil whose laws have no value between 0 and the Hertz pressure at the inlet temperature. Raises SceneError."""
    oil, T, p_H = scene.oil, scene.operation.temperature, Scales.of(scene).p_H
    at = f"at the inlet temperature of {T:g} deg C"
    if oil.viscosity == "roelands-temperature":
        Z = oil.Dz + oil.Cz * math.log10(1 + T / 135)
        if Z <= 0:
            raise SceneError(f"oil.Dz = {oil.Dz:g}, Cz = {oil.Cz:g}: the viscosity does not rise with pressure {at}, Z = Dz + "
                             f"Cz log10(1 + T/135) = {Z:.3g}; allowed: more than 0")
    if oil.viscosity == "houpert" and math.log(oil.eta0) + 9.67 <= 0:
        raise SceneError(f"oil.eta0 = {oil.eta0:g} Pa s: Houpert's law needs ln(eta0) + 9.67 > 0; allowed: more than 6.32e-05 "
                         "Pa s")
    if oil.viscosity == "yasutomi":
        _check_yasutomi(oil, T, p_H, at)
    _check_heat(oil, T, at)


def _check_yasutomi(oil, T, p_H, at):
    for p in (p_H * n / 20 for n in range(21)):
        F, Tg = yasutomi_F(oil, p), yasutomi_Tg(oil, p)
        if F <= 0 or oil.C2 + (T - Tg) * F <= 0:
            raise SceneError(f"oil: Yasutomi's law has no value at {p:.3g} Pa {at}: F = 1 - B1 ln(1 + B2 p) = {F:.3g}, C2 + "
                             f"(T - Tg) F = {oil.C2 + (T - Tg) * F:.3g} K; allowed: both more than 0 up to the Hertz pressure "
                             f"of {p_H:.3g} Pa")


def yasutomi_F(oil, p):
    """Expansivity of the free volume at p over that at 0."""
    return 1 - oil.B1 * math.log(1 + oil.B2 * p)


def yasutomi_Tg(oil, p):
    """Glass transition, deg C."""
    return oil.Tg0 + oil.A1 * math.log(1 + oil.A2 * p)


def _check_heat(oil, T, at):
    density = 1 - oil.beta0 * (T - 40)
    if oil.expansion != "never" and density < SPARE:
        raise SceneError(f"oil.beta0 = {oil.beta0:g} 1/K leaves {density:.3g} of the density {at}; allowed: at least {SPARE:g}")
    for p in (P_MEASURED * n / 10 for n in range(11)):
        rise = 1 + oil.b0 * (1 + oil.b1 * p + oil.b2 * p * p) * (min(T, GAMMA_MEASURED) - 22)
        if rise < SPARE:
            raise SceneError(f"oil.b0, b1, b2: the heat capacity falls to {rise:.3g} of its value at 22 deg C {at} and "
                             f"{p:.3g} Pa; allowed: at least {SPARE:g}")


def warnings(scene):
    """What is doubtful about the oil of a scene."""
    return [*_name(scene.oil), *_beyond(scene), *_without_temperature(scene), *_moes(scene)]


def _name(oil):
    """A known name with other numbers, or a new name with the numbers of a known oil."""
    values = dataclasses.asdict(oil)
    if oil.name in OILS:
        known = dataclasses.asdict(OILS[oil.name])
        other = [key for key in values if key not in ("name", "source") and values[key] != known[key]]
        if other:
            yield (f"oil.name = {oil.name} with other numbers than that oil ({', '.join(other)}): it is another oil; give it "
                   "a name of its own")
        return
    for known in OILS.values():
        if all(values[key] == getattr(known, key) for key in HEAT):
            numbers = (*oil.law_numbers, "viscosity")
            same = "all its numbers" if all(values[key] == getattr(known, key) for key in numbers) else (
                "its density, conductivity and heat capacity")
            yield f"oil.name = {oil.name}: {same} are those of {known.name}"
            return


def _beyond(scene):
    oil, T, p_H = scene.oil, scene.operation.temperature, Scales.of(scene).p_H
    if oil.viscosity == "barus" and p_H > BARUS_HOLDS:
        yield (f"oil.viscosity = barus at a Hertz pressure of {p_H / 1e9:.2f} GPa: the law is used beyond its range, some "
               f"{BARUS_HOLDS / 1e9:g} GPa")
    if oil.viscosity == "table" and p_H > oil.table[-1][0]:
        yield (f"oil.table ends at {oil.table[-1][0] / 1e9:.3g} GPa, the Hertz pressure is {p_H / 1e9:.3g} GPa: its last "
               "slope is continued")
    if oil.viscosity == "yasutomi" and yasutomi_Tg(oil, p_H) > T:
        yield (f"oil.viscosity = yasutomi: at the Hertz pressure the glass transition lies at {yasutomi_Tg(oil, p_H):.0f} deg "
               f"C, above the inlet's {T:g}: the law is used beyond its range")


def _without_temperature(scene):
    """Laws without temperature where the user speaks of one."""
    oil, T = scene.oil, scene.operation
    numbers = FREE_OF_TEMPERATURE.get(oil.viscosity)
    if numbers is None or any(getattr(oil, key) for key in numbers):
        return
    if not scene.isothermal or T.temperature != type(T).temperature:
        why = f"oil.viscosity = {oil.viscosity}" + "".join(f", {key} = 0" for key in numbers)
        yield f"{why}: this viscosity changes neither with the temperature of the inlet nor with that of the film"


def _moes(scene):
    oil = scene.oil
    if scene.contact.moes_M > 0 and not {"eta0", "alpha"} <= set(oil.law_numbers):
        yield (f"contact.moes_L takes oil.eta0 and oil.alpha, which the law of this oil ({oil.viscosity}) does not use: M and "
               "L are not those of its film; oil.name = moes-test-fluid has them")
