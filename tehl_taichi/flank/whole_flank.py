"""A whole flank: its positions, their runs, and what is told of them."""

import dataclasses
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from tehl_taichi.flank import columns
from tehl_taichi.flank.contacts import scene_at
from tehl_taichi.flank.described import described
from tehl_taichi.flank.mesh import Mesh
from tehl_taichi.flank.outcomes import summaries
from tehl_taichi.scene import Scene
from tehl_taichi.scene.gear_pair import GearPair
from tehl_taichi.scene.scales import Scales
from tehl_taichi.study.progress import Progress

ASSUMPTION = ("each position is a contact of its own with constant load and speeds while the feature passes: a passage takes "
              "some 0.1 ms, a mesh some ms")
SHARING = {"table": "of the table", "given": "gear.load_share",
           "spur": "trapezoid: 1/3 to 2/3 from A to B, 1 from B to D, 2/3 to 1/3 from D to E",
           "helical": "normal force over the mean length of the contact lines, b eps_alpha/cos beta_b"}


@dataclass(frozen=True)
class Flank:
    """Positions along a flank with their scenes and, in the same order, the outcomes of their runs.

    on: the wheel whose flank it is, "" for a table (body a of its rows).
    """

    name: str
    folder: Path
    on: str
    description: object
    positions: list
    scenes: list
    outcomes: list

    @property
    def rows(self):
        """(position, Hertz pressure in Pa, summary or None) of every position."""
        return [(at, Scales.of(scene).p_H, outcome.summary)
                for at, scene, outcome in zip(self.positions, self.scenes, self.outcomes)]

    @property
    def failed(self):
        """(position, reason) of those that did not converge."""
        return [(at, outcome.reason) for at, outcome in zip(self.positions, self.outcomes) if outcome.summary is None]

    @property
    def points(self):
        """{letter A to E: x_pl in m} on this flank; {} of a table."""
        if not self.description.pair:
            return {}
        sign = -1 if self.on == "gear" else 1
        return {name: sign * x + 0.0 for name, x in Mesh(self.description.pair).points.items()}

    @property
    def title(self):
        """The flank in a line."""
        pair = self.description.pair
        if not pair:
            return f"{self.name}: flank of body a"
        return f"{self.name}: flank of the {self.on}, {pair.torque:g} N m and {pair.n1:g} 1/min at the pinion"

    @property
    def sharing(self):
        """How the load is shared, in words."""
        pair = self.description.pair
        return SHARING["table" if not pair else "given" if pair.load_share else "helical" if pair.beta else "spur"]

    def to_dict(self):
        """The JSON object of `tehl flank --json`, in SI units."""
        return {"name": self.name, "folder": str(self.folder), "assumption": ASSUMPTION, "load_sharing": self.sharing,
                "geometry": self._geometry(),
                "positions": [self._position(*row, outcome) for row, outcome in zip(self.rows, self.outcomes)]}

    def _geometry(self):
        pair = self.description.pair
        if not pair:
            return {"table": self.description.source}
        mesh = Mesh(pair)
        return {**dataclasses.asdict(pair), "on": self.on, "alpha_w_deg": math.degrees(mesh.alpha_w), "d_a1": mesh.d_a(1),
                "d_a2": mesh.d_a(2), "eps_alpha": mesh.eps_alpha, "p_bt_m": mesh.p_bt, "s_C_m": mesh.rho_C(1),
                "rho_C1_m": mesh.rho_C(1), "rho_C2_m": mesh.rho_C(2), "u_C_m_s": mesh.speeds(0.0)[0],
                "F_bt_N": mesh.F_bt, "points_x_pl_m": self.points}

    def _position(self, at, p_H, summary, outcome):
        return {"point": at.point, "x_pl_m": at.x_pl, "arc_m": at.arc, "rho_a_m": at.rho_a, "rho_b_m": at.rho_b, "R_m": at.R,
                "u_a_m_s": at.u_a, "u_b_m_s": at.u_b, "srr": at.srr, "load_N_m": at.load, "p_Hertz_Pa": p_H, **at.more,
                "store": str(outcome.store), "converged": summary is not None, "reason": outcome.reason, "summary": summary}

    def write(self):
        """flank.json and flank.csv into the folder; returns their paths."""
        from tehl_taichi.io.json_values import plain

        self.folder.mkdir(parents=True, exist_ok=True)  # where no position converged there are no stores
        paths = self.folder / "flank.json", self.folder / "flank.csv"
        paths[0].write_text(json.dumps(plain(self.to_dict()), indent=1, allow_nan=False))
        columns.write_csv(paths[1], self.rows)
        return list(paths)

    def plot(self, path: str | PathLike | None = None, dpi: int = 160, format: str = "png", width: float = 17.0) -> Path:
        """The figure (default: flank.png in the folder, or flank.pdf, flank.svg); returns its path.

        dpi, format (where the path has no suffix that tells it), width: as :meth:`Run.plot`. Raises SceneError, or StoreError
        without matplotlib.
        """
        from tehl_taichi.figures.page import Page
        from tehl_taichi.flank import flank_figure

        return flank_figure.write(self, path or self.folder / "flank", Page(format, dpi, width))

    def __repr__(self):
        done = len(self.positions) - len(self.failed)
        return f"<tehl.Flank {self.name}: {done} of {len(self.positions)} positions, {self.folder}>"


def flank(gear: str | PathLike | GearPair = "fzg-c", *, torque: float | None = None, speed: float | None = None,
          on: str | None = None, positions: int | None = None, at: Sequence[str | float] = (), scene: Scene | None = None,
          changes: dict | None = None, steady: bool = False, folder: str | PathLike | None = None, threads: int | None = None,
          progress: Progress | None = None) -> Flank:
    """Film, pressure, temperatures and fatigue along a gear flank, a run per position: a :class:`Flank`.

    gear: "fzg-c", "fzg-a", a TOML or CSV file, or a GearPair; torque (N m) and speed (1/min) of the pinion, instead of its
    own; on: "pinion" or "gear", whose flank carries the feature; positions: how many; at: points ("C", "B-") or x_pl in m in
    their place; scene: everything but contact and speeds (default: what the file names, or "gear"); changes: of that scene, as
    Scene.replace takes them; steady: no feature passes; folder: of the stores and results (default: runs/NAME-N; one that is
    there is gone on with); threads, progress: as :func:`tehl_taichi.run`. Raises SceneError and StoreError before anything
    runs; a position that does not converge is in :attr:`Flank.failed`.

    >>> import tehl_taichi as tehl
    >>> pitch = tehl.flank("fzg-c", at=["C"], steady=True, changes={"grid.nx": 64, "thermal.on": False}, folder="pitch")
    >>> pitch
    <tehl.Flank fzg-c: 1 of 1 positions, pitch>
    >>> pitch.positions[0].srr, round(pitch.positions[0].R * 1e3, 2)
    (0.0, 8.38)
    >>> tehl.flank("fzg-c", torque=0)
    Traceback (most recent call last):
    ...
    tehl_taichi.errors.SceneError: gear.torque = 0 N m is out of range; allowed: more than 0 N m and at most 1e+08 N m
    """
    found = described(gear).changed(torque, speed)
    changes = {**(changes or {}), **({"time.steady_only": True} if steady else {})}
    places = found.positions(on, positions, at)
    scenes = [scene_at(scene or found.scene, changes, found.name, n, place) for n, place in enumerate(places, 1)]
    folder = Path(folder) if folder else fresh(found.name)
    outcomes = summaries(scenes, folder, threads, progress)
    whole = Flank(found.name, folder, (on or "pinion") if found.pair else "", found, places, scenes, outcomes)
    whole.write()
    return whole


def fresh(name):
    """The first of runs/NAME-1, runs/NAME-2 ... that does not exist."""
    n = 1
    while (folder := Path("runs") / f"{name}-{n}").exists():
        n += 1
    return folder
