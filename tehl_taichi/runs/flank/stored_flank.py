"""Stored flank: a folder with the positions and their summaries, table, figure."""

from tehl_taichi.runs.contact_set import PositionSet
from tehl_taichi.runs.flank import flank_columns
from tehl_taichi.runs.flank.positions import Position
from tehl_taichi.values.digits import part_of

# of a position in flank.json; what else stands there came with a table of positions
KEYS = {"point", "x_pl_m", "arc_m", "rho_a_m", "rho_b_m", "R_m", "u_a_m_s", "u_b_m_s", "srr", "load_N_m", "p_Hertz_Pa",
        "bulk_C", "film_ratios", "store", "converged", "reason", "summary"}


class Flank(PositionSet):
    """Results along a gear flank: :func:`tehl_taichi.flank` and :func:`tehl_taichi.open` give one.

    Attributes
    ----------
    folder : pathlib.Path
        Its folder.
    record : dict
        The JSON object of `tehl flank --json`.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Flank("f", {"name": "mine", "geometry": {}, "positions": []})
    <tehl.Flank mine: 0 of 0 positions, f>
    """

    KIND = "flank"
    CONTACT = ("point", "x_pl_m", "R_m", "u_a_m_s", "u_b_m_s", "load_N_m")
    TABLES = ("geometry",)

    @property
    def positions(self) -> list:
        """The :class:`tehl_taichi.runs.flank.positions.Position` of every contact."""
        return [self._position(one) for one in self.record["positions"]]

    @property
    def points(self) -> dict:
        """{letter A to E: x_pl in m} on this flank; {} for a table."""
        return self.record["geometry"].get("points_x_pl_m", {})

    @property
    def title(self) -> str:
        """One-line description of the flank."""
        pair = self.record["geometry"]
        if "torque" not in pair:
            return f"{self.name}: flank of body a"
        return f"{self.name}: flank of the {pair['on']}, {pair['torque']:g} N m and {pair['n1']:g} 1/min at the pinion"

    def _csv(self):
        return flank_columns.csv_text(self.rows)

    def _drawn(self, page):
        from tehl_taichi.runs.flank import flank_figure

        return flank_figure.drawn(page, self)

    @staticmethod
    def _position(one):
        u_m = 0.5 * (one["u_a_m_s"] + one["u_b_m_s"])
        more = {key: value for key, value in one.items() if key not in KEYS}
        return Position(one["x_pl_m"], one["rho_a_m"], one["rho_b_m"], one["u_a_m_s"], one["u_b_m_s"], one["load_N_m"],
                        one["srr"] * u_m, one["arc_m"], one["point"], more, one.get("bulk_C"), one.get("film_ratios", {}))

    def __repr__(self):
        done = len(self.record["positions"]) - len(self.failed)
        return f"<tehl.Flank {self.name}: {part_of(done, len(self.record['positions']), 'position')}, {self.folder}>"
