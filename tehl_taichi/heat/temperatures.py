"""Temperatures of the film and of both bodies: the energy equation, one step at a time.

A step: velocities from the generalised Reynolds solution, departure points of the oil, then one implicit system per column with
conduction, both heat sources and both walls (T_s = A + B q of the bodies).
"""

import functools
import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi.engine import field_pool, simd
from tehl_taichi.engine.records import Record
from tehl_taichi.engine.taichi_patches.prebound import bind
from tehl_taichi.heat import departure_points, energy, film, film_tables, relaxation, skip_tiles
from tehl_taichi.heat.bodies import ConductingBodies
from tehl_taichi.heat.chebyshev import ChebyshevNodes
from tehl_taichi.heat.heat_step import HeatStep
from tehl_taichi.heat.wall_shear import wall_shear
from tehl_taichi.laws.viscosity import parts
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.storage_term import bdf

COLUMN_TOLERANCE = 0.1  # of the tolerance of a round
FEW = 8  # columns without a solution that a passage continues with
RESTING = 0.4  # of the tolerance of a round: what the one before changed where the next rests
COLUMN_ITERATIONS = 40  # Newton steps of a column; 2 are usual, 6 to 8 the most seen where none is halved


@dataclass
class HeatReport:
    """change: largest difference from the last iterate (K), or the expected one of another round; failed: columns that did not
    converge; clamped: nodes limited to the allowed range.
    """

    change: float
    failed: int
    clamped: int


class FilmHeat:
    """Temperatures on the finest grid of `levels`: a film for :class:`tehl_taichi.pressure.newton.PressureSolver`, whose laws
    depend on them.

    dt_s: time step (s) for which the memory of the bodies is made; shorter steps are possible. given: columns with given
    pressure also have given temperatures. values(), slopes(): write density and viscosity of the film in the table, and their
    derivatives, to `rows` of the table.
    """

    rows = fields.THERMAL
    # of the state, (..., ny+1, nx+1)
    FIELDS = ("heat_T", "heat_T_before", "heat_below", "heat_below_before", "heat_p_before", "heat_memory")

    def __init__(self, levels, dt_s, given=False):
        self.levels, self.dt, self.nz = levels, dt_s, levels.scene.thermal.nodes
        self.across, self.columns = ChebyshevNodes(self.nz), film_tables.FilmTables(levels, self.nz)
        self.bodies = ConductingBodies(levels, self.columns, dt_s)
        self.holding = False  # columns without a solution at the temperatures of the oil that came in, see :meth:`hold`
        even = self.bodies.each[0].like(self.bodies.each[1])
        self.step, self.dt_now, self.dt_before = Record(HeatStep, given=float(given), even=float(even)), 0.0, 0.0
        self.moved = self.moved_before = 0  # cells that the grid moves in this step, and in the last
        self.report, self.relaxed = HeatReport(math.nan, 0, 0), False
        self._bind(levels.scene)

    def _bind(self, scene):
        v, conditions = self.levels, self.levels.conditions.values
        tiles, final = _tiles(v.nx, v.ny), _tiles(scene.grid.nx, scene.rows)
        self.X = field_pool.lease(self, 0, simd.W, max(tiles, final), self.nz * (self.nz + 2), clean=False)
        self.tile_report = np.zeros((tiles, film_tables.TOLD))
        film_state = v.S, self.columns.field
        state = *film_state, self.columns.singles.field
        known = v.G, self.across.table, scene.oil, scene.rheology, conditions
        self.values, self.slopes = (bind(film.laws, *film_state, *known[:3], conditions, slopes) for slopes in (0, 1))
        self._keep_parts = bind(film.keep, self.columns.field, v.G, self.nz, scene.oil) if parts(scene.oil) else lambda: None
        self._velocities, self._remembered = (bind(film.velocities, *state, *known, self.tile_report, flows)
                                              for flows in (1, 0))
        self._departures = bind(departure_points.departures, *state, v.G, self.nz, conditions, self.step.values,
                                self.tile_report)
        self._energy = bind(energy.energy, *state, self.X, *known, self.step.values, self.tile_report)
        self._choose_rest = bind(skip_tiles.choose_tiles, v.S, self.columns.singles.field, v.G, conditions,
                                 RESTING * scene.thermal.tolerance, self.tile_report)
        self._accept = bind(departure_points.accept, *state, v.G, self.nz, v.scales.p_H)

    def start(self, T=None):
        """Start at the inlet temperature everywhere, or with the film at T and cold bodies.

        Pressure and film in the table become those of the last step. Until :meth:`ConductingBodies.warm_resting`, surfaces at
        rest conduct as after a long time.
        """
        v, self.bodies.steady, self.dt_before = self.levels, True, 0.0
        inlet = v.scene.operation.temperature
        self.bodies.cool()
        self.set_temperature(np.full((self.nz, v.ny + 1, v.nx + 1), inlet) if T is None else T)
        self.values()
        self._keep()

    def continue_from(self, T, memory, offset):
        """Continue from a film at T (nz, ny+1, nx+1), with pressure and film in the table and no earlier step, and from the
        memory and offset of the bodies (:meth:`ConductingBodies.restore`).
        """
        self.start(T)
        self.bodies.steady = False
        self.bodies.restore(memory, offset)

    def begin(self, dt, moved=0):
        """Prepare a step of dt s in which the grid moves by `moved` cells: memory of the bodies, A and B of both surfaces."""
        v, a, self.dt_now, self.relaxed = self.levels, self.levels.scales.a, dt, False
        self.moved, (B_a, B_b) = moved, self.bodies.begin(dt, moved)
        rate, (near, *far) = bdf(*([dt, self.dt_before] if self.dt_before else [dt]))
        self.step.set(rate=rate, near=near, far=sum(far), back=dt, back_2=dt + self.dt_before, inv_x=1 / (v.dx * a),
                      inv_y=1 / (v.dy * a), B_a=B_a, B_b=B_b, tolerance=COLUMN_TOLERANCE * v.scene.thermal.tolerance,
                      iterations=COLUMN_ITERATIONS, hold=float(self.holding), moved=moved,
                      moved_2=moved + self.moved_before)

    def solve(self, again=False):
        """Solve the temperatures of this step for the pressure and film in the table. Returns a HeatReport.

        again: the step already has temperatures; tiles that would hardly change are skipped
        (:mod:`tehl_taichi.heat.skip_tiles`).
        """
        if again:
            self._choose_rest()
        else:
            self.tile_report[:, film_tables.RESTS] = 0.0
        self._velocities()
        self._departures()
        self._energy()
        change, failed, held = (self.tile_report[:, column]
                                for column in (film_tables.CHANGE, film_tables.FAILED, film_tables.HELD))
        self.report = HeatReport(float(change.max()), int(failed.sum()), int(held.sum()))
        return self.report

    @property
    def held(self):
        """Number of loaded nodes at a limit of the allowed temperature range (where the solver stopped) in the newest state."""
        coldest, loaded = self.levels.scene.operation.temperature - energy.WARM, self.levels.get(fields.P) > energy.LIGHT
        return int((((self.T >= energy.HOT) | (self.T <= coldest)) & loaded).sum())

    @property
    def sound(self):
        """Whether every loaded column of the last step converged inside the allowed range."""
        return not (self.report.failed or self.held)

    def hold(self):
        """Let columns without a solution keep the temperatures of their departure points until the step is accepted. Returns
        whether that is worth a try.

        A few such columns are beside solid contact or an unresolved front; columns that carry no load may change with the
        rounds.
        """
        worth, self.holding = not self.holding and self.report.failed <= FEW, True
        return worth

    def relax(self):
        """Relax the change of the last round (:mod:`tehl_taichi.heat.relaxation`); tiles that this moves are not skipped."""
        self._relax[self.relaxed]()
        self.relaxed = True

    @functools.cached_property
    def _relax(self):
        """Relaxation of the first round of a step, which only stores it, and of later ones."""
        v, quiet = self.levels, RESTING * self.levels.scene.thermal.tolerance
        return [bind(relaxation.relax, self.columns.field, self.columns.singles.field, v.G, self.nz, v.scene.oil, known, quiet,
                     v.scene.operation.temperature - energy.WARM, self.tile_report) for known in (0.0, 1.0)]

    def accept(self):
        """Store this step as the last one."""
        self.bodies.accept()
        self.holding = False
        self.dt_before, self.moved_before = self.dt_now, self.moved
        self._keep()

    def _keep(self):
        """Store the present state of the film as that of the last step."""
        self.tile_report[:, film_tables.RESTS] = 0.0
        self._remembered()
        self._accept()
        self.T = self.temperature()

    def carried(self):
        """The part of :meth:`state` that a window takes over: temperatures, and the memory of the bodies."""
        return {"heat_T": self.T, "heat_memory": self.bodies.memory(), "heat_offset": self.bodies.offset}

    def state(self):
        """Arrays needed to continue."""
        return {**self.carried(), "heat_T_before": self.columns.nodes(film_tables.TNN),
                "heat_below": self.columns.nodes(film_tables.MSN), "heat_below_before": self.columns.nodes(film_tables.MSNN),
                "heat_p_before": self.columns.single(film_tables.PNN)[None], "heat_dt_before": self.dt_before}

    def restore(self, state):
        """Continue from a state; the pressure of the last step must be in the table."""
        v = self.levels
        for kind, name in ((film_tables.T, "heat_T"), (film_tables.TN, "heat_T"), (film_tables.TNN, "heat_T_before"),
                           (film_tables.MSN, "heat_below"), (film_tables.MSNN, "heat_below_before")):
            self.columns.put_nodes(kind, state[name])
        self._keep_parts()
        self.columns.put_single(film_tables.PN, v.get(fields.P) * v.scales.p_H)
        self.columns.put_single(film_tables.PNN, state["heat_p_before"][0])
        self.bodies.restore(state["heat_memory"], state["heat_offset"])
        self.T, self.dt_before = np.array(state["heat_T"]), float(state["heat_dt_before"])

    def temperature(self):
        """Temperatures (nz, ny+1, nx+1) in deg C, from body a to body b."""
        return self.columns.nodes(film_tables.T)

    def set_temperature(self, values):
        """Set the initial temperatures (nz, ny+1, nx+1) of the next solve."""
        self.columns.put_nodes(film_tables.T, values)
        self._keep_parts()

    def tractions(self):
        """Shear (4, ny+1, nx+1) in Pa on body a along x, y and on body b along x, y, of the accepted state."""
        v, singles = self.levels, self.columns.singles.field
        return v.fill(wall_shear, 4, singles, v.scene.rheology, v.conditions.values)


def _tiles(nx, ny):
    """Number of tiles of a grid, as in kernels (:func:`tehl_taichi.engine.simd.tiles`)."""
    return (ny // simd.W + 1) * (nx // simd.TILE + 1)
