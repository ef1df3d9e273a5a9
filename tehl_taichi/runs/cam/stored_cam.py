"""Stored cam: a folder with the angles and their summaries, table, figure."""

from tehl_taichi.runs.cam import cam_columns
from tehl_taichi.runs.cam.cam_table import CamPosition
from tehl_taichi.runs.contact_set import PositionSet
from tehl_taichi.values.digits import number_of, part_of

# of an angle in cam.json; other keys came with the table
KEYS = {"angle_deg", "R_m", "load_N_m", "u_a_m_s", "u_b_m_s", "u_m_m_s", "srr", "p_Hertz_Pa", "store", "converged", "reason",
        "summary"}


class Cam(PositionSet):
    """Results over the cycle of a cam: :func:`tehl_taichi.cam` and :func:`tehl_taichi.open` give one.

    Attributes
    ----------
    folder : pathlib.Path
        Its folder.
    record : dict
        The JSON object of `tehl cam --json`.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Cam("c", {"name": "mine", "positions": []})
    <tehl.Cam mine: 0 of 0 angles, c>
    """

    KIND = "cam"
    CONTACT = ("angle_deg", "R_m", "u_a_m_s", "u_b_m_s", "load_N_m")

    @property
    def not_converged(self) -> list:
        """Entries of :attr:`failed` whose run did not converge."""
        return [(at, reason) for at, reason in self.failed if not at.without_film]

    @property
    def title(self) -> str:
        """One-line description of the cam."""
        angles = number_of(len(self.rows), "angle")
        return f"{self.name}: {angles}, {self.record['oil']} at {self.record['temperature_C']:g} deg C"

    def with_position(self, number, outcome):
        """Copy with the outcome of one angle."""
        positions = list(self.record["positions"])
        positions[number] = {**positions[number], "converged": outcome.summary is not None, "reason": outcome.reason,
                             "summary": outcome.summary}
        return Cam(self.folder, {**self.record, "positions": positions})

    def _csv(self):
        return cam_columns.csv_text(self.rows)

    def _drawn(self, page):
        from tehl_taichi.runs.cam import cam_figure

        return cam_figure.drawn(page, self)

    @staticmethod
    def _position(one):
        more = {key: value for key, value in one.items() if key not in KEYS}
        return CamPosition(one["angle_deg"], one["R_m"], one["load_N_m"], one["u_a_m_s"], one["u_b_m_s"], more)

    def __repr__(self):
        count = len(self.record["positions"])
        return f"<tehl.Cam {self.name}: {part_of(count - len(self.failed), count, 'angle')}, {self.folder}>"
