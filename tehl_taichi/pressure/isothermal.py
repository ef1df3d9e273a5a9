"""A film of one temperature, that of the inlet."""

from tehl_taichi.pressure import fields, isothermal_laws, tractions
from tehl_taichi.pressure.levels import HEAVY


class OneTemperature:
    """The film of an isothermal problem on `levels`, see :class:`tehl_taichi.pressure.equations.Equations`.

    values(), slopes(): density and viscosity of the film in the table, and their derivatives, into the table; rows: which.
    Where temperatures follow, the rows are theirs: equations of either film are then the same kernels, traced and loaded once.
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
