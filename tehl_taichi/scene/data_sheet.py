"""Oil from a data sheet: kinematic viscosities at 40 and 100 deg C, optionally density at 15 and alpha at 40 deg C.

When an Oil is made, the sheet is converted to the numbers of the law roelands-temperature; laws know nothing of sheets. G0 and
S0 reproduce both viscosities at p = 0; Z follows from alpha and is independent of temperature (Cz = 0).
"""

import math

from tehl_taichi.errors import SceneError
from tehl_taichi.laws import density
from tehl_taichi.laws.densities import RHO0
from tehl_taichi.laws.viscosities.roelands_temperature import LN_SCALE, LOG_SCALE, P_ROELANDS, ROELANDS_TEMPERATURE
from tehl_taichi.scene import mineral_alpha
from tehl_taichi.values.coerce import plain
from tehl_taichi.values.quantity import quantity

NAME = "data-sheet"  # of an oil that is given no other
LAW = ROELANDS_TEMPERATURE.name
FROM = "data sheet: "  # begins the source of an oil that is given no other
KEYS = {"nu_40": quantity(0.0, "m2/s", "data sheet: kinematic viscosity at 40 deg C (220 mm2/s: 220e-6), with nu_100 instead "
                                       "of the numbers of the law; 0: not given", 0.0, 0.1, usual=1e-4, least=1e-6),
        "nu_100": quantity(0.0, "m2/s", "data sheet: kinematic viscosity at 100 deg C", 0.0, 0.1, usual=1e-5, least=1e-6),
        "alpha_40": quantity(0.0, "1/Pa", "data sheet: pressure-viscosity coefficient at 40 deg C; 0: estimated as for a "
                                          "mineral oil", 0.0, 1e-7, usual=2e-8, least=1e-9),
        "rho_15": quantity(0.0, "kg/m3", "data sheet: density at 15 deg C, instead of rho0; 0: not given",
                           0.0, 3000.0, usual=880.0, least=500.0)}
VISCOSITY = ("G0", "S0", "Dz", "Cz")


def has_sheet(values):
    """Whether any of these values of an oil belongs to a data sheet."""
    return any(_given(values, key) for key in KEYS)


def _given(values, key):
    """Whether a key is given: what is no number is refused later."""
    value = plain(values.get(key, 0))
    return not isinstance(value, (int, float)) or value != 0


def derived_keys(values):
    """Names of the numbers that the data sheet in these values determines, () without one."""
    return () if not has_sheet(values) else (*VISCOSITY, "rho0") if _given(values, "rho_15") else VISCOSITY


def derived_values(oil):
    """{key: value} that the data sheet of an oil determines, {} without one. Raises SceneError if it contradicts itself or
    other given numbers.
    """
    values = vars(oil)
    if not has_sheet(values):
        return {}
    _check(oil)
    found = {"rho0": oil.rho_15 / _expansion(oil, 15.0) if oil.rho_15 else oil.rho0}
    found |= _viscosity(oil, found["rho0"])
    fresh = {key: found[key] for key in derived_keys(values)}
    check_agreement({key: values[key] for key in fresh if values[key] != _declared(key).default}, fresh)
    return {**fresh, "source": words(oil, found)} if oil.source in ("", type(oil).source) else fresh


def check_agreement(given, fresh):
    """Refuse numbers {key: value} given beside a sheet that differ from those it determines. Raises SceneError."""
    for key, value in given.items():
        _declared(key).metadata["kind"].check(f"oil.{key}", value)
    wrong = [key for key in given if not math.isclose(given[key], fresh[key], rel_tol=1e-6)]
    if wrong:
        numbers = ", ".join(f"{key} = {fresh[key]:.6g}" for key in wrong)
        sheet = "oil.rho_15" if wrong == ["rho0"] else "oil.nu_40, nu_100"
        raise SceneError(f"oil.{wrong[0]} = {given[wrong[0]]:g} and the data sheet ({sheet}) contradict each other: the sheet "
                         f"gives {numbers}; omit {', '.join(wrong)}, or the keys of the sheet")


def is_alpha_estimated(oil):
    """Whether alpha of this oil is an estimate."""
    return oil.nu_40 > 0 and not oil.alpha_40


def alpha_40(nu_40, rho0, Z):
    """Pressure coefficient d ln(eta)/dp (1/Pa) of that law at p = 0 and 40 deg C."""
    return Z * P_ROELANDS * _ln_rise(nu_40 * rho0)


def words(oil, found):
    """Text about the source of the numbers of an oil with a data sheet; found: the derived values and rho0."""
    rho0 = found["rho0"]
    density_ = f", {oil.rho_15:g} kg/m3 at 15 deg C" if oil.rho_15 else f"; {rho0:g} kg/m3 at 40 deg C, not from there"
    alpha = f"alpha {alpha_40(oil.nu_40, rho0, found['Dz']) * 1e9:.3g} 1/GPa at 40 deg C"
    estimate = "" if oil.alpha_40 else f" estimated as for a mineral oil, within {mineral_alpha.WITHIN * 100:g} %"
    return (f"{FROM}{oil.nu_40 * 1e6:.4g} mm2/s at 40 deg C, {oil.nu_100 * 1e6:.4g} mm2/s at 100 deg C{density_}; "
            f"{alpha}{estimate}")


def _check(oil):
    """Check a data sheet: both viscosities, the first the larger, no other law, alpha given or possible to estimate."""
    if not (oil.nu_40 and oil.nu_100):
        known = next(key for key in KEYS if getattr(oil, key))
        missing = " and ".join(f"oil.{key}" for key in ("nu_40", "nu_100") if not getattr(oil, key))
        raise SceneError(f"oil.{known} = {getattr(oil, known):g} {KEYS[known].metadata['kind'].unit} belongs to a data sheet, "
                         f"which needs both viscosities; missing: {missing}")
    if not oil.nu_40 > oil.nu_100:
        raise SceneError(f"oil.nu_100 = {oil.nu_100:g} m2/s must be less than nu_40 = {oil.nu_40:g} m2/s: oil thins with heat")
    if oil.viscosity != LAW:
        raise SceneError(f"oil.viscosity = {oil.viscosity!r} does not accept a data sheet (oil.nu_40, nu_100); allowed with a "
                         f"data sheet: {LAW}")
    if is_alpha_estimated(oil) and not mineral_alpha.holds(oil.nu_40, oil.nu_100):
        m, (low, high) = mineral_alpha.slope(oil.nu_40, oil.nu_100), mineral_alpha.STEEPNESS
        raise SceneError(f"oil.alpha_40 is missing: with oil.nu_40 = {oil.nu_40:g} m2/s and nu_100 = {oil.nu_100:g} m2/s the "
                         f"oil is not like a mineral oil, for which alpha can be estimated (slope {m:.3g} of ASTM D341; "
                         f"mineral oils {low:g} to {high:g})")


def _viscosity(oil, rho0):
    """G0, S0, Dz, Cz for this density (kg/m3, 40 deg C): eta = nu rho, each at its own temperature."""
    eta_40, eta_100 = oil.nu_40 * rho0, oil.nu_100 * rho0 * _expansion(oil, 100.0)
    cold, hot = math.log10(eta_40) + LOG_SCALE, math.log10(eta_100) + LOG_SCALE
    S0 = math.log(cold / hot) / math.log(235 / 175)  # (1 + Gamma/135) at 100 over that at 40 deg C
    Z = oil.alpha_40 / (P_ROELANDS * _ln_rise(eta_40)) or mineral_alpha.exponent(oil.nu_40, oil.nu_100)
    return {"G0": cold * (175 / 135) ** S0, "S0": S0, "Dz": Z, "Cz": 0.0}


def _ln_rise(eta):
    return math.log(eta) + LN_SCALE


def _expansion(oil, Gamma):
    """Density at p = 0 and temperature Gamma, relative to 40 deg C."""
    return float(density.LAWS[oil.density].expansion(oil, 0.0, Gamma))


def _declared(key):
    return RHO0 if key == "rho0" else ROELANDS_TEMPERATURE.numbers[key]
