"""Lubricants: laws and their numbers."""

from typing import TYPE_CHECKING, Any

from tehl_taichi.errors import SceneError
from tehl_taichi.laws import conduction, density, viscosity
from tehl_taichi.laws.law import declared, section
from tehl_taichi.scene import data_sheet
from tehl_taichi.values.quantity import check, choice, documented, kinds, text

NO_SOURCE = "not given"
_OIL: Any = section(
    "_OIL", name=text("reference-pao", "name (`tehl oils` lists the named oils)"),
    source=text("PAO of Everitt, licentiate thesis 2018; density after Larsson et al. 2000", "source of the numbers",
                one_line=False),
    **data_sheet.KEYS,
    viscosity=choice("roelands-temperature", "law of the viscosity (`tehl laws`)", tuple(viscosity.LAWS)),
    **declared(viscosity.LAWS),
    density=choice("dowson-higginson", "law of the density (`tehl laws`)", tuple(density.LAWS)),
    expansion=choice("thermal", "when the density depends on temperature; thermal: unless the film is isothermal by option",
                     ("thermal", "always", "never")),
    **declared({**density.LAWS, **conduction.LAWS}))


def in_one_temperature(expansion, keeps):
    """`oil.expansion` of an isothermal film; keeps: see `Scene.keeps_expansion`."""
    return "always" if keeps and expansion == "thermal" else expansion


def with_named_numbers(values):
    """Values of an oil, completed with the numbers of the oil that they name. A new name, or a known one with another data
    sheet, has a source of its own. Raises SceneError for an unknown name without numbers.
    """
    if "name" not in values:
        return {"name": data_sheet.NAME, **values} if data_sheet.has_sheet(values) else values
    from tehl_taichi.scene import named_oils  # it makes Oils

    name, own = values["name"], data_sheet.has_sheet(values)
    if isinstance(name, str) and (known := named_oils.NAMED.get(name)):
        return {"source": "" if own else known.source, **_beside(values, known), **values}
    if values.keys() <= {"name", "source"}:
        named_oils.check_new(name, values)
    return values if own else {"source": NO_SOURCE, **values}


def _beside(values, known):
    """Numbers of a known oil beside the given values. Raises SceneError for a data sheet if the known oil has none."""
    if data_sheet.has_sheet(values) and not data_sheet.has_sheet(known.numbers):
        raise SceneError(f"oil.name = {known.name!r} has its own viscosity and accepts no data sheet (oil.nu_40, nu_100); omit "
                         "the name, or choose a new one")
    return known.numbers


@documented
class Oil(_OIL):
    """Lubricant; each law has its own numbers, and numbers of other laws have no effect.

    `tehl laws` lists the laws and their numbers. The `name` of a known oil (`tehl oils`) gives all numbers that are not given.
    `nu_40` and `nu_100` of a data sheet determine the numbers of the viscosity law.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Oil(eta0=0.02).eta0, tehl.Oil(name="mineral-vg220").source[:20]
    (0.02, 'mineral, made of ISO')
    """

    _completed = staticmethod(with_named_numbers)

    if TYPE_CHECKING:  # keys come from the registries
        expansion: str

    def __post_init__(self):
        check(self, "oil")
        for key in self.law_numbers:
            if getattr(self, key) == ():
                raise kinds(Oil)[key].refusal(f"oil.{key}", ())
        for key, value in data_sheet.derived_values(self).items():
            object.__setattr__(self, key, value)

    @property
    def law_numbers(self):
        """Names of the numbers of its viscosity law."""
        return tuple(viscosity.LAWS[self.viscosity].numbers)

    @property
    def laws(self):
        """All laws of the oil."""
        return viscosity.LAWS[self.viscosity], density.LAWS[self.density], *conduction.LAWS.values()

    @property
    def expands(self):
        """Whether its density falls with temperature (if `expansion` allows it)."""
        return density.LAWS[self.density].expansivity(self, 0.0, 40.0) > 0

    def density_ratio(self, p, Gamma, inlet):
        """Density at p (Pa) and Gamma (deg C), numbers or arrays, relative to p = 0 at the temperature `inlet`."""
        return density.rho_film(self, p, Gamma) / density.rho_film(self, 0.0, inlet)

    @property
    def unused(self):
        """Names of numbers that belong only to laws which it did not choose."""
        return set(declared({**viscosity.LAWS, **density.LAWS})) - {key for law in self.laws for key in law.numbers}
