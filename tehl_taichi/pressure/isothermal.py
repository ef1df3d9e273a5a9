"""An isothermal film at the inlet temperature."""

from tehl_taichi.pressure import fields, isothermal_laws, tractions
from tehl_taichi.pressure.levels import HEAVY


class OneTemperature:
    """Film of an isothermal problem on `levels`, see :class:`tehl_taichi.pressure.equations.Equations`.

    values(), slopes(): write density and viscosity of the film in the table, and their derivatives, to `rows` of the table. In
    thermal scenes the rows are those of the thermal film, so that both films share their kernels.
    """

    def __init__(self, levels):
        self.levels, scene = levels, levels.scene
        self.rows = fields.ISOTHERMAL if scene.isothermal else fields.THERMAL
        known = levels.S, levels.G, scene.film_oil, levels.conditions.values, self.rows
        self.values, self.slopes = (levels.launch(isothermal_laws.laws, *known, slopes, work=HEAVY) for slopes in (0, 1))

    def tractions(self):
        """Shear (4, ny+1, nx+1) in Pa on body a along x, y and on body b along x, y."""
        v = self.levels
        return v.fill(tractions.tractions, 4, v.scene.rheology, v.conditions.values)
