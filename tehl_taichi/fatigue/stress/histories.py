"""Stress histories of material points of a body around a feature, from the snapshots of its passage.

Material points keep their place x' = x - x_i(t) on their surface. The frame x_i of a surface moves by its pace times the
distance that the centre of the first feature has moved. On the surface that carries this feature, x' is the distance from it;
on the other surface, x' is the distance from the point that the feature meets at X = 0. Before the first and after the last
snapshot (feature outside the contact) the points move through the steady field, so every history begins and ends unloaded.
"""

import functools

import numpy as np

from tehl_taichi.engine.fftw import SINGLE
from tehl_taichi.fatigue.sought import Sought
from tehl_taichi.fatigue.stress.averaging import has_window
from tehl_taichi.fatigue.stress.half_space import COMPONENTS, HalfSpaceStress
from tehl_taichi.fatigue.stress.thermal_depth import ThermalBelow
from tehl_taichi.fatigue.stress.workers import pool
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.strength.strength import Strength
from tehl_taichi.values.interpolation import lagrange

AROUND = 0.6       # half width (in a) of the part searched around a small feature: its stress does not reach farther
MARGIN = 0.3       # distance (in a) searched beyond the rim of a larger feature
LOADED = 1.5       # material points are followed within this distance (in a) of the centre of the contact
BLOCK_BYTES = 1e9  # memory of the histories held at once; more points are searched in blocks of y rows
WHOLE = 1e-6  # cells: smaller distances from a node count as zero
NODES = range(-2, 4)  # nodes of the interpolation between cells, counted from the node before the point


class StressHistories:
    """Material points around a feature, and their places at every moment that counts (fatigue.from_x to to_x).

    A moment is one position of the feature; an entry is one stored state of the reader. Attributes: `x`, `y`: x' and y of the
    points, m; `rows`: slice of the reader's rows; for every moment `positions` of the first feature and `centres` of the frame
    of the surface, m, and `entries`, the number of its entry.

    reader: has x, y (m), time (s), len, feature_x(n) (m) and fields(n, names) (SI); entry 0 is the steady start. positions:
    (entries,) m, of the first feature. around: half width (in a) of the part around a small feature. surface: the
    :class:`tehl_taichi.scene.moving_surfaces.MovingSurface` whose points these are, by default that of the first feature. box:
    :class:`tehl_taichi.fatigue.sought.Box` of the points to search, or None for all. sought: which of them are searched in full
    (:class:`tehl_taichi.fatigue.sought.Sought`).
    """

    block = 16  # entries whose stresses are computed together
    deepest = np.inf  # depth down to which points are searched, m
    sought = Sought.ALL
    steel = True  # whether von Mises stresses are searched
    chosen_y = None  # positions y (m) of the rows that are searched below the surface, if these are chosen
    left = None  # residual stress by plastic flow: a :class:`tehl_taichi.fatigue.stress.residual_field.ResidualField`

    def __init__(self, scene, reader, positions, around=AROUND, surface=None, box=None, sought=Sought.ALL):
        self.scene, self.reader, self.around, self.last_below, self.sought = scene, reader, around, {}, sought
        self.surface, self.a = surface or scene.reference, Scales.of(scene).a
        self.strength = Strength(scene.fatigue, self.surface)
        self.loads_of = self._names()
        self.left = getattr(reader, "residual_fields", {}).get(self.surface.name)
        self.path, centres = (float(positions[0]), float(positions[-1])), self.surface.pace * positions
        self.dx = float(reader.x[-1] - reader.x[0]) / (reader.x.size - 1)
        low, high = (max(1, int(side / self.dx + 1e-9)) for side in self._sides("x"))
        # material points on nodes of the grid at entry 0: steps of whole cells then need no interpolation
        offset = (reader.x[0] - centres[0]) / self.dx
        self.x = (np.arange(-low, high + 1) + offset - round(offset)) * self.dx
        low, high = self._sides("y")
        rows = np.flatnonzero((reader.y >= -low * (1 + 1e-9)) & (reader.y <= high * (1 + 1e-9)))
        self.rows = slice(rows[0], rows[-1] + 1)
        self.y = reader.y[self.rows]
        # as long as all points need: the history of a point does not depend on the choice of searched points
        before, after = self._lead_in(centres[0]), self._lead_out(centres[-1])
        ends, self.boxed = (self.x[0], self.x[-1]), box is not None
        if self.boxed:
            self._keep(box)
        self.centres = np.concatenate([before, centres, after])
        pace = self.surface.pace
        self.positions = np.concatenate([positions[0] + (before - centres[0]) / pace, positions,
                                         positions[-1] + (after - centres[-1]) / pace])
        self.entries = np.concatenate([0 * before, np.arange(len(centres)), 0 * after]).astype(int)
        self._widen(*ends)
        self._choose_moments()

    @property
    def follows(self):
        """Whether the reader has moments between those of the run, in which the worst points are followed."""
        return getattr(self.reader, "every", None) is not None

    def _keep(self, box):
        """Keep the points in a Box."""
        (left, right), (low, high), (_, self.deepest), self.chosen_y = box
        self.x = self.x[(self.x >= left) & (self.x <= right)]
        rows = np.flatnonzero((self.y >= low) & (self.y <= high)) + self.rows.start
        self.rows = slice(rows[0], rows[-1] + 1)
        self.y = self.reader.y[self.rows]

    def _names(self):
        """Names of the fields p, q_x and q_y of the surface."""
        return "pressure", *(f"traction_{axis}_{self.surface.name}" for axis in "xy")

    def _sides(self, axis):
        """Distances (m) searched on the negative and the positive side of the frame's origin, along `axis` ("x" or "y")."""
        far = [(at, max((f.reach if axis == "x" else f.reach_y) + MARGIN * self.a, self.around * self.a))
               for f in self.scene.features for at in (self.passed(f) if axis == "x" else (f.centre_y,))]
        return [max(sign * at + r for at, r in far) for sign in (-1, 1)]

    def passed(self, feature):
        """Places x' (m) of this surface under the centre of a feature when it enters and when it leaves the contact.

        One place for a feature of this surface; none if the feature's surface is at rest.
        """
        carrier = next(s for s in self.scene.surfaces if s.name == feature.surface)
        if carrier.name == self.surface.name:
            return (feature.x,)
        if carrier.stands:  # every point passes the feature in the same way
            return ()
        ends = ((side * self.a - feature.x) / carrier.pace for side in (-1, 1))
        return tuple(feature.x + (carrier.pace - self.surface.pace) * np.clip(at, *self.path) for at in ends)

    def _lead_in(self, first):
        """Centres (m), one cell of the run apart, before the first stored one, beginning where every point is unloaded; none if
        the first stored one is inside the contact."""
        if self.path[0] > -self.a:
            return np.zeros(0)
        steps = int(np.ceil((first + self.x[-1] + LOADED * self.a) / self.run_dx))
        return first - np.arange(max(steps, 0), 0, -1) * self.run_dx

    def _lead_out(self, last):
        """As :meth:`_lead_in`, after the last stored centre."""
        if self.path[1] < self.a:
            return np.zeros(0)
        steps = int(np.ceil((LOADED * self.a - last - self.x[0]) / self.run_dx))
        return last + np.arange(1, max(steps, 0) + 1) * self.run_dx

    @property
    def run_dx(self):
        """Cell of the run along x, m; the cell `dx` of a reader with a fine window is smaller."""
        return self.dx * (self.reader.factor if has_window(self.reader) else 1)

    def _widen(self, first, last):
        """Set `grid_x`, the grid with unloaded columns (`pad`) on both sides, which no material point leaves; first, last: of
        all points, x' m."""
        x0, x1 = self.reader.x[0], self.reader.x[-1]
        low, high = self.centres.min() + first, self.centres.max() + last
        self.pad = tuple(max(0, int(np.ceil(gap / self.dx)) + 2) for gap in (x0 - low, high - x1))
        self.grid_x = x0 + (np.arange(self.reader.x.size + sum(self.pad)) - self.pad[0]) * self.dx
        self.line, self.mirrored = self.scene.contact.kind == "line", self.reader.y[0] == 0

    def _choose_moments(self):
        """Keep the moments with the feature between fatigue.from_x and to_x (a)."""
        fatigue = self.scene.fatigue
        counts = (self.positions >= fatigue.from_x * self.a) & (self.positions <= fatigue.to_x * self.a)
        self.centres, self.positions, self.entries = self.centres[counts], self.positions[counts], self.entries[counts]

    def places(self, depth, rows):
        """Function of the number of a point in these rows (a slice), that returns its (depth, x, y) in m."""
        def place(n):
            i, j = divmod(int(n), rows.stop - rows.start)
            return depth, self.x[i], self.y[j + rows.start]

        return place

    def operator(self, depth):
        """The HalfSpaceStress at a depth (m), on the rows of the points."""
        y = self.reader.y
        return HalfSpaceStress(self.grid_x, y - y[0], self.surface.body.nu, self.line, self.mirrored, depth, self.rows, SINGLE)

    def stresses(self, depth):
        """(HalfSpaceStress, function of the thermal stress or None) at a depth (m) below the surface."""
        return self.operator(depth), self.below(depth).at(depth) if self.scene.has_thermal_stress else None

    def below(self, depth, make=None):
        """The ThermalBelow for depths from `depth` (m) on, or what make(passage, depth) returns. The last one of each kind is
        used again if it reaches up to there, since a new one transforms every temperature field.
        """
        last = self.last_below.get(make)
        if last is None or last.shallowest > depth:
            self.last_below[make] = last = make(self, depth) if make else self.heat(ThermalBelow, depth)
        return last

    def heat(self, kind, *more):
        """The thermal stress of this passage; kind: ThermalStress, or ThermalBelow with its shallowest depth (m)."""
        r = self.reader
        grid = r.x, r.y, self.pad[0], self.grid_x.size
        return self.heat_of(kind, self.rises(r), grid, self.reflects, self.a, self.surface.speed, *more)

    @property
    def reflects(self):
        """Whether temperatures continue as a mirror image before the first row: at the plane of symmetry, and beside a line."""
        return self.line or self.mirrored

    def rises(self, reader):
        """Generator of the surface temperatures above ambient (nx+1, ny+1) K of a reader, at equal steps in time."""
        name, ambient = f"temperature_{self.surface.name}", self.scene.operation.temperature
        found = (np.asarray(reader.fields(n, (name,))[name], float) - ambient for n in range(len(reader)))
        return between(found, self.ticks)

    def heat_of(self, kind, rises, grid, mirrored, a, speed, *more):
        """The ThermalStress or ThermalBelow (`kind`) of temperature rises (K).

        grid: x, y (m) of the rises, the number of columns before them, and the number of all columns of the stresses. a: length
        (m) over which the rises fade behind the grid. speed: of the body in this frame, m/s.
        """
        return kind(self.surface.body, speed, rises, self.tick, *grid, a, mirrored, *more)

    @property
    def ticks(self):
        """Number of each entry on a series of equal steps in time, (entries,)."""
        return self._steps[0]

    @property
    def tick(self):
        """Length of the equal steps, s."""
        return self._steps[1]

    @functools.cached_property
    def _steps(self):
        return equal_steps(np.asarray(self.reader.time))

    @property
    def nodes(self):
        """Number of nodes with loads."""
        return self.grid_x.size * len(self.reader.y)

    def row_blocks(self):
        """List of slices of rows whose histories fit into BLOCK_BYTES."""
        row_bytes = 8.0 * self.x.size * (self.centres.size + 1) * (len(COMPONENTS) + 2)
        rows = max(1, int(BLOCK_BYTES / row_bytes))
        return [slice(j, min(j + rows, self.y.size)) for j in range(0, self.y.size, rows)]

    def history(self, rows, operators, notify=lambda done, total: None, meanwhile=lambda: None, depth=0.0):
        """Stress histories (points, moments + 1, 6) Pa at a depth (m) below the surface; the last moment is unloaded.

        rows: slice of the rows of the points; the points of one x' are neighbours. operators: result of :meth:`stresses` at
        this depth. notify, meanwhile: as for :meth:`gathered`.
        """
        def stresses(block):
            return (self.stress_field(int(entry), rows, *operators) for entry in block)

        out = self.gathered((rows.stop - rows.start,), stresses, notify, meanwhile)
        first = self.rows.start
        self.resting(out[:, :, None], np.array([depth])[:, None], range(first + rows.start, first + rows.stop))
        return out.reshape(-1, *out.shape[2:])

    @property
    def blocks(self):
        """Arrays of the numbers of the entries that count, in blocks.

        An entry has the same place in its block, and so the same bits, whatever moments are searched.
        """
        entries = np.unique(self.entries)
        return np.split(entries, np.flatnonzero(np.diff(entries // self.block)) + 1)

    def gathered(self, shape, stresses, notify, meanwhile):
        """Histories (x', *shape, moments + 1, 6) Pa of the points, all zero at the last moment.

        stresses(block) returns the fields (columns, *shape, 6) Pa of each entry of a block. notify: called with (done, total)
        blocks. meanwhile: function that this thread runs while other threads compute the stresses.
        """
        out, blocks = np.zeros((self.x.size, *shape, self.centres.size + 1, len(COMPONENTS))), self.blocks

        def fill(block):
            self.follow(out, dict(zip(block.tolist(), stresses(block))))

        with pool(self.nodes) as workers:
            tasks = [workers.submit(fill, block) for block in blocks]
            meanwhile()
            for done, task in enumerate(tasks, 1):
                task.result()
                notify(done, len(blocks))
        return out

    def resting(self, stress, depths, rows):
        """Add the residual stress to `stress` (x', rows, depths, moments, 6) Pa, in place, and return it.

        depths: (depths, 1) m; rows: numbers of rows of the reader.
        """
        along, across = self.strength.residual(depths)
        stress[..., 0] += along
        stress[..., 1] += across
        if self.left is not None:
            stress += self.left.at(self.x, np.asarray(self.reader.y)[list(rows)], depths[:, 0])[..., None, :]
        return stress

    def follow(self, out, fields):
        """Write stress fields {entry: (columns, ..., 6)} into the histories `out` (x', ..., moments, 6) at all moments of these
        entries. Several moments are written together, since those of a point are neighbours in memory."""
        for some in self._neighbours(list(fields)):
            out[..., some[0] : some[-1] + 1, :] = np.stack([self._at(fields[self.entries[t]], t) for t in some], axis=-2)

    def followed(self, fields):
        """Histories (x', moments, 6) of fields (steps, columns, 6) at equal steps in time; all moments at once, for small
        fields."""
        start = self._start(np.arange(self.centres.size))
        whole = np.where(np.abs(start - np.rint(start)) < WHOLE, np.rint(start), np.floor(start)).astype(int)
        part = np.where(np.abs(start - whole) < WHOLE, 0.0, start - whole)
        found = _windows(fields.transpose(2, 0, 1), self.ticks[self.entries], whole, self.x.size)
        weighted = [(weight, node) for weight, node in zip(lagrange(NODES, part), NODES) if weight.any()]
        out = sum(weight[:, None] * found[..., node - NODES[0] :][..., : self.x.size] for weight, node in weighted)
        return out.transpose(2, 1, 0)

    def _neighbours(self, entries):
        """The moments of some entries, as arrays of consecutive moments with at most `block` each."""
        moments = np.flatnonzero(np.isin(self.entries, entries))
        ends = np.flatnonzero((np.diff(moments) > 1) | (moments[1:] % self.block == 0)) + 1
        return [some for some in np.split(moments, ends) if some.size]

    def under(self, fields, t):
        """Values (parts, x', rows) of fields (columns, rows, parts) at the material points at moment t."""
        return np.moveaxis(self._at(fields, t), -1, 0)

    def band(self, entry):
        """Slice of the columns of an entry's stresses that the histories use."""
        starts = self._start(np.flatnonzero(self.entries == entry))
        if not starts.size:
            return slice(0, 0)
        return slice(max(int(starts.min()) + NODES[0], 0),
                     min(int(np.ceil(starts.max())) + self.x.size + NODES[-1], self.grid_x.size))

    def _start(self, t):
        """Column (with fraction) of the first material point at moments t."""
        return (self.centres[t] + self.x[0] - self.grid_x[0]) / self.dx

    def _at(self, fields, t):
        """Values (x', ...) of fields (columns, ...) at the material points at moment t."""
        return shifted(fields, self._start(t), self.x.size)

    def loads(self, entry):
        """Loads p, q_x, q_y (3, columns, ny+1) Pa of an entry; the shear is zero without `fatigue.shear`."""
        out, front = np.zeros((3, self.grid_x.size, self.reader.y.size)), self.pad[0]
        out[:, front : front + self.reader.x.size] = self.loads_from(self.reader.fields(entry, self.loads_of))
        return out

    def loads_from(self, fields):
        """Loads p, q_x, q_y (3, ...) Pa of fields {name: array}; the shear is zero without `fatigue.shear`."""
        out = np.zeros((3, *np.shape(fields[self.loads_of[0]])))
        for load, name in zip(out, self.loads_of if self.scene.fatigue.shear else self.loads_of[:1]):
            load[...] = fields[name]
        return out

    def stress_field(self, entry, rows, stress, thermal):
        """Stresses (columns, rows, 6) Pa of an entry."""
        found = stress(*self.loads(entry))
        if thermal:
            for name, values in zip(COMPONENTS, thermal(self.ticks[entry], self.rows)):
                found[name] += values
        return np.stack([found[name][:, rows] for name in COMPONENTS], axis=-1)


def equal_steps(times):
    """(numbers (n,), step (s)) of `times` (n,) s on the coarsest series of equal steps that contains all of them."""
    gaps = np.diff(times)
    step, rest = gaps[0], gaps[1:]
    for gap in rest:  # Euclid's algorithm
        while gap > 1e-6 * gaps[0]:
            step, gap = gap, step % gap
            gap = 0.0 if step - gap < 1e-6 * gaps[0] else gap
    ticks = np.rint((times - times[0]) / step).astype(int)
    return ticks, float(times[-1] - times[0]) / int(ticks[-1])


def between(fields, ticks):
    """Generator of the fields at every tick from the first to the last; linear in time between the given ones."""
    before = None
    for at, field in zip(ticks, fields):
        for n in range(before[0] + 1 if before else at, at):
            part = (n - before[0]) / (at - before[0])
            yield (1 - part) * before[1] + part * field
        yield field
        before = at, field


def _windows(fields, entries, whole, count):
    """Columns from the first of NODES before `whole` to the last one behind `count` of them, (parts, moments, columns), of
    fields (parts, steps, columns) at `entries`; columns beyond the ends repeat them.
    """
    first, size = whole + NODES[0], count + len(NODES) - 1
    before, behind = max(0, -first.min()), max(0, first.max() + size - fields.shape[2])
    padded = np.pad(fields, ((0, 0), (0, 0), (before, behind)), "edge") if before or behind else fields
    return np.lib.stride_tricks.sliding_window_view(padded, size, axis=2)[:, entries, first + before]


def shifted(fields, start, count):
    """`count` columns of fields (columns, ...) from column `start`: exact for a whole number, else by the polynomial through
    six nodes."""
    whole = int(np.round(start))
    if abs(start - whole) < WHOLE:
        return fields[whole: whole + count]
    whole = int(np.floor(start))
    weights = lagrange(NODES, start - whole)
    return sum(w * fields[whole + n : whole + n + count] for n, w in zip(NODES, weights))
