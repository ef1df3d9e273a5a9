"""Validity of the laws of an oil at the pressures and the temperature of a scene."""

import dataclasses

from tehl_taichi.errors import SceneError
from tehl_taichi.laws import rheology, viscosity
from tehl_taichi.laws.law import declared
from tehl_taichi.scene import data_sheet, mineral_alpha
from tehl_taichi.scene.named_oils import OILS
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.scales import Scales

NOT_HEAT = ("name", "source", "viscosity", "expansion", *declared(viscosity.LAWS), *data_sheet.KEYS)


def check(scene):
    """Refuse an oil whose laws have no value between 0 and the Hertz pressure at the inlet temperature. Raises SceneError."""
    for sentence in _law_warnings(scene, "refused"):
        raise SceneError(sentence)


def _law_warnings(scene, what):
    """Sentences of the oil's laws about this contact."""
    for law in scene.oil.laws:
        sentence = getattr(law, what)(scene.oil, scene.operation.temperature, Scales.of(scene).p_H)
        if sentence:
            yield sentence


def warnings(scene):
    """Warnings about the oil of a scene."""
    return [*_name(scene.oil), *_estimate(scene.oil), *_shear(scene), *_law_warnings(scene, "doubted"),
            *_without_temperature(scene), *_moes(scene)]


def _name(oil):
    """Warnings about a known name with other numbers, or a new name with the numbers of a known oil."""
    values = dataclasses.asdict(oil)
    if oil.name in OILS:
        known = dataclasses.asdict(OILS[oil.name])
        other = [key for key in values if key not in ("name", "source") and values[key] != known[key]]
        if other:
            yield (f"oil.name = {oil.name} has other numbers than that oil ({', '.join(other)}); give this oil a new name")
        return
    of_heat = [key for key in values if key not in (*NOT_HEAT, *["rho0"] * (oil.rho_15 > 0))]
    heat = [known for known in OILS.values() if all(values[key] == getattr(known, key) for key in of_heat)]
    whole = [known for known in heat if all(values[key] == getattr(known, key) for key in (*oil.law_numbers, "viscosity"))]
    if heat:
        yield f"oil.name = {oil.name}: {_same(oil, whole)} are those of {_known(whole or heat)}"


def _same(oil, whole):
    """Text about values that the oil shares with known oils."""
    dense = "density, " if not oil.rho_15 else "density's rise with pressure, "
    return "all its numbers" if whole else f"its {dense}conductivity and heat capacity"


def _known(oils):
    """Names of these oils; only the reference oil if it is among them, because the others take its value."""
    names = [oil.name for oil in oils]
    return Oil.name if Oil.name in names else ", ".join(names)


def _estimate(oil):
    """Warning about an estimated alpha."""
    if data_sheet.is_alpha_estimated(oil):
        alpha = data_sheet.alpha_40(oil.nu_40, oil.rho0, oil.Dz)
        yield (f"oil.alpha_40 is not given: alpha at 40 deg C is estimated as {alpha * 1e9:.3g} 1/GPa, which holds within "
               f"{mineral_alpha.WITHIN * 100:g} % for mineral oils of a handbook (8 % of the film); the alpha of a PAO may be "
               "a quarter lower")


def _shear(scene):
    """Warning about a user's oil with the shear law of the reference oil: neither data sheets nor viscosity laws include
    one.
    """
    oil, kept = scene.oil, scene.rheology
    if oil.name in OILS or kept != type(kept)() or not kept.thins or scene.operation.u_s == 0:
        return
    what = "its data sheet has no traction data" if data_sheet.has_sheet(vars(oil)) else "its numbers do not include traction"
    numbers = ", ".join(f"{key} = {getattr(kept, key):g} {number.metadata['kind'].unit}".strip(" -")
                        for key, number in rheology.LAWS[kept.law].numbers.items())
    yield (f"the shear law of the base scene is used for oil.name = {oil.name}, {what}: rheology.law = {kept.law}, {numbers}. "
           "Friction, heat and surface shear depend on it; set measured values in [rheology]")


def _without_temperature(scene):
    """Warning about laws that ignore temperature although the scene gives one."""
    oil, T = scene.oil, scene.operation
    numbers = viscosity.LAWS[oil.viscosity].thinned_by
    if numbers is None or any(getattr(oil, key) for key in numbers):
        return
    if not scene.isothermal or T.temperature != type(T).temperature:
        why = f"oil.viscosity = {oil.viscosity}" + "".join(f", {key} = 0" for key in numbers)
        yield f"{why}: this viscosity depends neither on the inlet temperature nor on the film temperature"


def _moes(scene):
    oil = scene.oil
    if scene.contact.moes_M > 0 and not {"eta0", "alpha"} <= set(oil.law_numbers):
        yield (f"contact.moes_L uses oil.eta0 and oil.alpha, which the law of this oil ({oil.viscosity}) does not use, so M "
               "and L do not describe its film; oil.name = moes-test-fluid uses them")
