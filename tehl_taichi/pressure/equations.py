"""The discrete equations of a film: its laws, the residual of the Reynolds equation and the Jacobian, on all levels."""

import numpy as np

from tehl_taichi.engine.simd import W
from tehl_taichi.pressure import active_sets, fields, reynolds
from tehl_taichi.pressure.levels import HEAVY
from tehl_taichi.pressure.linear import transfer


class Equations:
    """The equations of `film` on `levels`.

    film: supplies density and viscosity. Its values() follow from pressure and film in the table, its slopes() from the values;
    rows: a LawRows with their rows. It is a :class:`tehl_taichi.pressure.isothermal.OneTemperature`, or a film with
    temperatures.
    """

    def __init__(self, levels, film):
        v, rows, rheology = levels, film.rows, levels.scene.rheology
        self.levels, self.film, self.known = levels, film, np.zeros(1)
        self.evaluate = v.launch(reynolds.residual, v.S, v.G, rows.couette, rows.skew, rheology)
        blocks, injected = v.sizes[1][1] // W + 1 if len(v.sizes) > 1 else 0, np.array(fields.STATE + rows.follow, np.int32)
        self.inject = v.launch(transfer.inject, v.S, v.J, v.G, len(v.sizes), blocks, injected, work=HEAVY)
        self._rows, self._rows_coarse = (
            v.launch(reynolds.linearise, v.S, v.J, v.G, v.blocks, *cut, self.known, rows.couette, rows.slope, rows.skew,
                     rheology, work=HEAVY)
            for cut in ((0, v.fine), (v.fine, len(v.blocks))))
        self._replace = [v.launch(active_sets.replace_rows, v.S, v.J, v.G, v.blocks, touching) for touching in (0, 1)]

    def residual(self, H0):
        """Compute H, laws and R for the pressure in the table and the rigid approach H0."""
        self.levels.set_film(H0)
        self.film.values()
        self.evaluate()

    def linearise(self, kept=False, again=False):
        """Compute slopes of the laws, Jacobian rows and the diagonal of the finest level; needs :meth:`residual`.

        kept: reuse existing slopes; again: after a Newton step of the same solve.
        """
        self.known[0] = again
        if not kept:
            self.film.slopes()
        self._rows()

    def linearise_coarse(self):
        """Linearise on the coarser levels of the line solver, about the injected state and with its laws."""
        self.inject()
        self._rows_coarse()

    def replace_rows(self, touching):
        """Replace the rows of dry nodes and (touching) of nodes in solid contact on all levels."""
        self._replace[touching]()
